#include "core/export/GltfGeometry.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

// Values of the glTF specification.
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
// The largest index of a type restarts primitives and must not be used.
constexpr std::size_t kMaxShortVertices = 65535;

glm::vec3 unitOr(const glm::vec3& vector, const glm::vec3& fallback) {
    const glm::dvec3 v(vector);
    const double length = glm::length(v);
    return length > 1e-12 && std::isfinite(length) ? glm::vec3(v / length) : fallback;
}

// Any unit vector at a right angle to `normal` (Duff et al. 2017, listing 3).
glm::vec3 perpendicular(const glm::vec3& normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    return {1.0f + sign * normal.x * normal.x * a, sign * normal.x * normal.y * a,
            -sign * normal.x};
}

std::vector<glm::vec3> unitNormals(const Mesh& mesh) {
    std::vector<glm::vec3> result;
    result.reserve(mesh.normals.size());
    for (const glm::vec3& normal : mesh.normals)
        result.push_back(unitOr(normal, {0.0f, 1.0f, 0.0f}));
    return result;
}

std::vector<glm::vec4> unitTangents(const Mesh& mesh, const std::vector<glm::vec3>& normals) {
    std::vector<glm::vec4> result;
    result.reserve(mesh.tangents.size());
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        const glm::vec4& tangent = mesh.tangents[i];
        result.emplace_back(unitOr(glm::vec3(tangent), perpendicular(normals[i])),
                            tangent.w < 0.0f ? -1.0f : 1.0f);
    }
    return result;
}

} // namespace

int GltfGeometry::addView(std::span<const std::byte> data, int target) {
    m_buffer.resize((m_buffer.size() + 3) / 4 * 4);
    Json view = {{"buffer", 0}, {"byteOffset", m_buffer.size()}, {"byteLength", data.size()}};
    if (target != 0)
        view["target"] = target;
    m_buffer.insert(m_buffer.end(), data.begin(), data.end());
    m_views.push_back(std::move(view));
    return static_cast<int>(m_views.size()) - 1;
}

int GltfGeometry::addImage(const Bytes& file) {
    return addView(file, 0);
}

template <class T>
int GltfGeometry::addAccessor(const std::vector<T>& values, const char* type, int componentType,
                              int target) {
    m_accessors.push_back({{"bufferView", addView(std::as_bytes(std::span(values)), target)},
                           {"componentType", componentType},
                           {"count", values.size()},
                           {"type", type}});
    return static_cast<int>(m_accessors.size()) - 1;
}

int GltfGeometry::addAttribute(const std::vector<glm::vec4>& values) {
    return addAccessor(values, "VEC4", kFloat, kArrayBuffer);
}

int GltfGeometry::addAttribute(const std::vector<glm::vec3>& values) {
    return addAccessor(values, "VEC3", kFloat, kArrayBuffer);
}

int GltfGeometry::addAttribute(const std::vector<glm::vec2>& values) {
    return addAccessor(values, "VEC2", kFloat, kArrayBuffer);
}

Json GltfGeometry::primitive(const Mesh& mesh, bool tangents) {
    if (const auto known = m_known.find(&mesh); known != m_known.end())
        return known->second;

    const std::size_t count = mesh.vertexCount();
    Json attributes;
    attributes["POSITION"] = addAccessor(mesh.positions, "VEC3", kFloat, kArrayBuffer);
    Bounds bounds; // exactly of the accessor's values, used by a triangle or not
    for (const glm::vec3& position : mesh.positions)
        bounds.add(position);
    m_accessors.back()["min"] = {bounds.min.x, bounds.min.y, bounds.min.z};
    m_accessors.back()["max"] = {bounds.max.x, bounds.max.y, bounds.max.z};
    const std::vector<glm::vec3> normals = unitNormals(mesh);
    if (normals.size() == count)
        attributes["NORMAL"] = addAccessor(normals, "VEC3", kFloat, kArrayBuffer);
    // Only normal maps need tangents; without one they would be dead weight.
    if (tangents && normals.size() == count && mesh.tangents.size() == count)
        attributes["TANGENT"] =
            addAccessor(unitTangents(mesh, normals), "VEC4", kFloat, kArrayBuffer);
    if (mesh.uvs.size() == count)
        attributes["TEXCOORD_0"] = addAccessor(mesh.uvs, "VEC2", kFloat, kArrayBuffer);

    Json result = {{"attributes", std::move(attributes)}};
    if (count <= kMaxShortVertices) {
        const std::vector<std::uint16_t> narrow(mesh.indices.begin(), mesh.indices.end());
        result["indices"] = addAccessor(narrow, "SCALAR", kUnsignedShort, kElementArrayBuffer);
    } else {
        result["indices"] = addAccessor(mesh.indices, "SCALAR", kUnsignedInt, kElementArrayBuffer);
    }
    m_known.emplace(&mesh, result);
    return result;
}

} // namespace patina
