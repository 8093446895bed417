// The binary half of a glTF file: buffer, buffer views and accessors, filled mesh by mesh.
// Private to core/export (it shows the JSON library).
#pragma once

#include "core/base/AtomicFile.h"
#include "core/mesh/Mesh.h"

#include <map>
#include <nlohmann/json.hpp>
#include <vector>

namespace patina {

class GltfGeometry {
  public:
    // A primitive object (without material). The numbers of a mesh are written once, however
    // often it is asked for; ask with the same `tangents` each time.
    nlohmann::ordered_json primitive(const Mesh& mesh, bool tangents);
    int addAttribute(const std::vector<glm::vec4>& values); // index of its accessor
    int addAttribute(const std::vector<glm::vec3>& values);
    int addAttribute(const std::vector<glm::vec2>& values);
    int addImage(const Bytes& file); // index of its buffer view

    [[nodiscard]] const std::vector<nlohmann::ordered_json>& accessors() const {
        return m_accessors;
    }
    [[nodiscard]] const std::vector<nlohmann::ordered_json>& bufferViews() const { return m_views; }
    [[nodiscard]] std::size_t byteLength() const { return m_buffer.size(); }
    [[nodiscard]] Bytes takeBuffer() { return std::move(m_buffer); }

  private:
    int addView(std::span<const std::byte> data, int target);
    template <class T>
    int addAccessor(const std::vector<T>& values, const char* type, int componentType, int target);

    Bytes m_buffer;
    std::vector<nlohmann::ordered_json> m_views, m_accessors;
    std::map<const Mesh*, nlohmann::ordered_json> m_known;
};

} // namespace patina
