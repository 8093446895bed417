// KHR_draco_mesh_compression: a primitive whose arrays are compressed with Draco.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace patina::codec {

class DracoMesh {
  public:
    // Throws Refusal when the data is damaged or larger than Patina's limits.
    explicit DracoMesh(std::span<const std::byte> data);
    ~DracoMesh();
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    [[nodiscard]] std::size_t vertexCount() const;
    [[nodiscard]] std::vector<std::uint32_t> indices() const;
    // `components` floats per vertex of the attribute that the extension names by this number.
    [[nodiscard]] std::vector<float> floats(std::uint32_t attribute, int components) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace patina::codec
