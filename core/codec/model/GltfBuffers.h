// The binary side of glTF: buffers, their views, and accessors turned into floats and indices.
// Every offset and length is checked before it is used.
#pragma once

#include "core/codec/model/ModelFolder.h"

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace patina::codec {

class GltfBuffers {
  public:
    // `binary` is the BIN chunk of a GLB, empty otherwise; it must outlive this.
    GltfBuffers(const nlohmann::json& root, std::span<const std::byte> binary,
                const ModelFolder& folder);

    // Uncompressed, where the view is compressed (EXT_meshopt_compression).
    [[nodiscard]] std::span<const std::byte> view(std::size_t index) const;
    // `components` floats per element; normalised integers become 0…1 or -1…1.
    [[nodiscard]] std::vector<float> floats(std::size_t accessor, int components) const;
    // Three floats per element, of which any number may be zeros without bytes in the file: the
    // caller has made sure that there are as many vertices. (Morph targets move few of them.)
    [[nodiscard]] std::vector<float> displacements(std::size_t accessor) const;
    // 16 floats per element, column by column.
    [[nodiscard]] std::vector<float> matrices(std::size_t accessor) const;
    // As floats() where they lie in the file one after another as they are wanted; else empty.
    [[nodiscard]] std::span<const float> floatsInPlace(std::size_t accessor, int components) const;
    [[nodiscard]] std::vector<std::uint32_t> indices(std::size_t accessor) const;
    [[nodiscard]] std::size_t count(std::size_t accessor) const;

  private:
    // Those that `place` names: a view or its compressed counterpart.
    [[nodiscard]] std::span<const std::byte> bytesOf(const nlohmann::json& place) const;
    [[nodiscard]] std::vector<float> read(std::size_t accessor, int components,
                                          bool countZeros) const;
    void takeZeros(std::size_t count) const;

    const nlohmann::json& m_root;
    std::vector<MemoryFile> m_files;
    std::vector<std::vector<std::byte>> m_inline;
    std::vector<std::span<const std::byte>> m_buffers;
    mutable std::map<std::size_t, std::vector<std::byte>> m_uncompressed; // views, by index
    mutable std::size_t m_zeros = 0; // elements so far that no bytes of the file stand for
};

// "data:image/png;base64,…" → its bytes; false when it is no such URI.
bool decodeDataUri(const std::string& uri, std::vector<std::byte>& bytes);

// An element of an array member; Refusal when it is not there.
const nlohmann::json& element(const nlohmann::json& root, const char* array, std::size_t index);

} // namespace patina::codec
