#include "core/export/collada/ColladaGeometry.h"

#include "core/base/Limits.h"
#include "core/export/Names.h"
#include "core/export/collada/Polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace patina::collada {
namespace {

// The numbers of a <source>, through its accessor.
class Source {
  public:
    Source(const Tree& tree, xml_node source, std::size_t components) {
        const xml_node accessor = source.child("technique_common").child("accessor");
        if (!accessor)
            throw Fault(
                fmt::format("{} has no <accessor>; export the scene again", describe(source)));
        const xml_node array =
            tree.resolve(accessor.attribute("source").value(), {"float_array"}, accessor);
        m_values = floatsOf(array);
        if (const std::uint64_t said = countOf(array, "count"); said != m_values.size())
            throw Fault(fmt::format("{} says that it has {} numbers, and has {}; export the scene "
                                    "again",
                                    describe(array), said, m_values.size()));
        // Parameters without a name are skipped.
        std::size_t position = 0;
        for (const xml_node& param : accessor.children("param")) {
            if (param.attribute("name") && m_components.size() < components)
                m_components.push_back(position);
            ++position;
        }
        for (std::size_t i = 0; position == 0 && i < components; ++i)
            m_components.push_back(i);
        if (m_components.size() < components)
            throw Fault(fmt::format("{} has {} numbers for each vertex instead of {}; export the "
                                    "scene again",
                                    describe(source), m_components.size(), components));
        const std::uint64_t count = countOf(accessor, "count");
        const std::uint64_t stride = countOf(accessor, "stride", 1);
        const std::uint64_t first = countOf(accessor, "offset", 0);
        const std::uint64_t size = m_values.size();
        if (stride <= m_components.back() || count > size || stride > size + 1 || first > size ||
            (count > 0 && first + (count - 1) * stride + m_components.back() >= size))
            throw Fault(fmt::format("the <accessor> of {} reaches beyond its {} numbers; export "
                                    "the scene again",
                                    describe(source), size));
        m_count = count;
        m_stride = stride;
        m_first = first;
    }

    [[nodiscard]] std::size_t count() const { return m_count; }
    [[nodiscard]] double at(std::size_t row, std::size_t component) const {
        return static_cast<double>(m_values[m_first + row * m_stride + m_components[component]]);
    }
    [[nodiscard]] glm::dvec3 vector(std::size_t row) const {
        return {at(row, 0), at(row, 1), at(row, 2)};
    }

  private:
    std::vector<float> m_values;
    std::vector<std::size_t> m_components;
    std::size_t m_count = 0, m_stride = 1, m_first = 0;
};

// The corners of a primitive element, face after face: `stride` indices each.
struct Faces {
    std::vector<std::uint32_t> indices;
    std::vector<std::size_t> sizes; // corners of each face
    std::size_t stride = 1;
};

[[noreturn]] void wrongCount(xml_node element, std::uint64_t said, std::size_t has,
                             const char* what) {
    throw Fault(fmt::format("{} says that it has {} {}, and has {}; export the scene again",
                            describe(element), said, what, has));
}

Faces facesOf(xml_node primitive, std::size_t stride) {
    const std::string_view name = primitive.name();
    Faces faces;
    faces.stride = stride;
    const std::uint64_t count = countOf(primitive, "count");
    const auto fullCorners = [&](std::size_t indices) {
        if (indices % stride != 0)
            throw Fault(fmt::format("the indices of {} end within a corner; export the scene again",
                                    describe(primitive)));
        return indices / stride;
    };
    if (name == "triangles" || name == "polylist") {
        for (const xml_node& p : primitive.children("p")) {
            const std::vector<std::uint32_t> more = indicesOf(p);
            faces.indices.insert(faces.indices.end(), more.begin(), more.end());
        }
        const std::size_t corners = fullCorners(faces.indices.size());
        if (name == "triangles") {
            if (corners % 3 != 0 || corners / 3 != count)
                wrongCount(primitive, count, corners / 3, "triangles");
            faces.sizes.assign(corners / 3, 3);
            return faces;
        }
        std::uint64_t sum = 0;
        for (const std::uint32_t size : indicesOf(primitive.child("vcount"))) {
            faces.sizes.push_back(size);
            sum += size;
        }
        if (faces.sizes.size() != count)
            wrongCount(primitive, count, faces.sizes.size(), "polygons");
        if (sum != corners)
            wrongCount(primitive.child("vcount"), sum, corners, "corners");
        return faces;
    }
    if (primitive.child("ph"))
        throw Fault(fmt::format("{} has polygons with holes, which are not read; triangulate the "
                                "mesh before you export it",
                                describe(primitive)));
    for (const xml_node& p : primitive.children("p")) {
        const std::vector<std::uint32_t> more = indicesOf(p);
        faces.indices.insert(faces.indices.end(), more.begin(), more.end());
        faces.sizes.push_back(fullCorners(more.size()));
    }
    if (faces.sizes.size() != count)
        wrongCount(primitive, count, faces.sizes.size(), "<p> elements");
    return faces;
}

// Corners (numbers of them, in the element) of triangles; the face of each.
struct Corners {
    std::vector<std::size_t> corners;
    std::vector<std::uint32_t> faces;
    std::size_t skipped = 0;

    void add(std::size_t a, std::size_t b, std::size_t c, std::size_t face) {
        if (faces.size() >= limits::kMaxTriangles)
            throw Fault("it has more than the supported 50 million triangles in one mesh; divide "
                        "the mesh");
        corners.insert(corners.end(), {a, b, c});
        faces.push_back(static_cast<std::uint32_t>(face));
    }
};

template <class PositionOf>
Corners triangulated(xml_node primitive, const Faces& faces, const PositionOf& positionOf) {
    const std::string_view name = primitive.name();
    Corners result;
    std::vector<glm::dvec3> polygon;
    std::size_t first = 0;
    for (std::size_t face = 0; face < faces.sizes.size(); first += faces.sizes[face], ++face) {
        const std::size_t size = faces.sizes[face];
        if (size < 3) {
            ++result.skipped;
        } else if (name == "trifans") {
            for (std::size_t i = 1; i + 1 < size; ++i)
                result.add(first, first + i, first + i + 1, face);
        } else if (name == "tristrips") { // every second one is turned over
            for (std::size_t i = 0; i + 2 < size; ++i)
                result.add(first + i + i % 2, first + i + 1 - i % 2, first + i + 2, face);
        } else {
            polygon.clear();
            for (std::size_t i = 0; i < size; ++i)
                polygon.push_back(positionOf(first + i));
            const auto triangles = trianglesOf(polygon);
            if (!triangles)
                throw Fault(fmt::format("{} has a concave polygon of {} corners, more than {}; "
                                        "triangulate the mesh before you export it",
                                        describe(primitive), size, kMaxConcaveCorners));
            for (const auto& [a, b, c] : *triangles)
                result.add(first + a, first + b, first + c, face);
        }
    }
    return result;
}

struct CornerKey {
    std::array<std::uint32_t, 3> indices;
    friend bool operator==(const CornerKey&, const CornerKey&) = default;
};
struct CornerHash {
    std::size_t operator()(const CornerKey& key) const {
        std::uint64_t h = 0x9e3779b97f4a7c15ull;
        for (const std::uint32_t index : key.indices) {
            h = (h ^ index) * 0xff51afd7ed558ccdull;
            h ^= h >> 32;
        }
        return static_cast<std::size_t>(h);
    }
};

// Of each position, smooth, in world space: as Patina's importers do where a file has none.
std::vector<glm::vec3> smoothNormals(const std::vector<glm::vec3>& positions,
                                     std::vector<std::uint32_t> indices) {
    Mesh mesh;
    mesh.positions = positions;
    mesh.indices = std::move(indices);
    computeNormals(mesh);
    return std::move(mesh.normals);
}

class MeshReader {
  public:
    MeshReader(const Tree& tree, xml_node primitive, int set, const glm::dmat4& toWorld)
        : m_primitive(primitive)
        , m_toWorld(toWorld)
        , m_inputs(inputsOf(tree, primitive)) {
        for (const Input& input : m_inputs) {
            m_faces.stride = std::max(m_faces.stride, input.offset + 1);
            if (input.semantic == "POSITION" && m_position == nullptr)
                m_position = &input;
            if (input.semantic == "NORMAL" && m_normal == nullptr)
                m_normal = &input;
        }
        m_uv = textureInput(m_inputs, set);
        if (m_position == nullptr)
            throw Fault(
                fmt::format("{} has no positions; export the scene again", describe(primitive)));
        m_positions.emplace(tree, m_position->source, 3);
        if (m_normal != nullptr)
            m_normals.emplace(tree, m_normal->source, 3);
        if (m_uv != nullptr)
            m_uvs.emplace(tree, m_uv->source, 2);
    }

    ColladaMesh read() {
        m_faces = facesOf(m_primitive, m_faces.stride);
        checkIndices(*m_position, m_positions->count());
        if (m_normal != nullptr)
            checkIndices(*m_normal, m_normals->count());
        if (m_uv != nullptr)
            checkIndices(*m_uv, m_uvs->count());
        Corners corners = triangulated(m_primitive, m_faces, [&](std::size_t corner) {
            return m_positions->vector(index(corner, *m_position));
        });
        ColladaMesh result;
        join(corners, result.mesh);
        turnOver(result.mesh.indices);
        result.faces = std::move(corners.faces);
        result.skippedFaces = corners.skipped;
        result.computedNormals = m_normal == nullptr;
        return result;
    }

  private:
    [[nodiscard]] std::uint32_t index(std::size_t corner, const Input& input) const {
        return m_faces.indices[corner * m_faces.stride + input.offset];
    }

    void checkIndices(const Input& input, std::size_t count) const {
        for (std::size_t i = input.offset; i < m_faces.indices.size(); i += m_faces.stride)
            if (m_faces.indices[i] >= count)
                throw Fault(fmt::format(
                    "{} has the index {} of {}, whose last is {}; export the scene again",
                    describe(m_primitive), m_faces.indices[i], describe(input.source),
                    static_cast<long long>(count) - 1));
    }

    // The fronts of a mirrored instance would turn clockwise.
    void turnOver(std::vector<std::uint32_t>& indices) const {
        if (glm::determinant(glm::dmat3(m_toWorld)) < 0.0)
            for (std::size_t i = 0; i < indices.size(); i += 3)
                std::swap(indices[i + 1], indices[i + 2]);
    }

    // Corners of equal indices become one vertex.
    void join(const Corners& corners, Mesh& mesh) const {
        std::vector<glm::vec3> computed;
        if (m_normal == nullptr) {
            std::vector<glm::vec3> all;
            for (std::size_t i = 0; i < m_positions->count(); ++i)
                all.push_back(position(static_cast<std::uint32_t>(i)));
            std::vector<std::uint32_t> indices;
            for (const std::size_t corner : corners.corners)
                indices.push_back(index(corner, *m_position));
            turnOver(indices);
            computed = smoothNormals(all, std::move(indices));
        }
        const glm::dmat3 toWorldNormal = glm::transpose(adjugate(glm::dmat3(m_toWorld)));
        std::unordered_map<CornerKey, std::uint32_t, CornerHash> known;
        for (const std::size_t corner : corners.corners) {
            const CornerKey key{{index(corner, *m_position),
                                 m_normal != nullptr ? index(corner, *m_normal) : 0u,
                                 m_uv != nullptr ? index(corner, *m_uv) : 0u}};
            const auto [entry, isNew] =
                known.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.indices.push_back(entry->second);
            if (!isNew)
                continue;
            mesh.positions.push_back(position(key.indices[0]));
            mesh.normals.push_back(m_normal == nullptr
                                       ? computed[key.indices[0]]
                                       : unit(toWorldNormal * m_normals->vector(key.indices[1])));
            if (m_uv != nullptr)
                mesh.uvs.emplace_back(m_uvs->at(key.indices[2], 0),
                                      1.0 - m_uvs->at(key.indices[2], 1));
        }
    }

    [[nodiscard]] glm::vec3 position(std::uint32_t row) const {
        const glm::vec3 p(m_toWorld * glm::dvec4(m_positions->vector(row), 1.0));
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw Fault(fmt::format("{} lies too far away for its numbers; export the scene again",
                                    describe(m_primitive)));
        return p;
    }

    // The inverse times the determinant's size: also of what is flat.
    static glm::dmat3 adjugate(const glm::dmat3& m) {
        const glm::dvec3 a = glm::cross(m[1], m[2]), b = glm::cross(m[2], m[0]),
                         c = glm::cross(m[0], m[1]);
        const double sign = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
        return glm::transpose(glm::dmat3(a, b, c)) * sign;
    }

    static glm::vec3 unit(const glm::dvec3& v) {
        const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
        return largest > 0.0 && std::isfinite(largest) ? glm::vec3(glm::normalize(v / largest))
                                                       : glm::vec3(0.0f, 1.0f, 0.0f);
    }

    xml_node m_primitive;
    glm::dmat4 m_toWorld;
    std::vector<Input> m_inputs;
    const Input* m_position = nullptr;
    const Input* m_normal = nullptr;
    const Input* m_uv = nullptr;
    std::optional<Source> m_positions, m_normals, m_uvs;
    Faces m_faces;
};

} // namespace

std::vector<Input> inputsOf(const Tree& tree, xml_node primitive) {
    std::vector<Input> inputs;
    for (const xml_node& element : primitive.children("input")) {
        const std::uint64_t offset = countOf(element, "offset");
        const std::uint64_t set = countOf(element, "set", 0);
        if (offset > 255 || set > 1u << 20)
            throw Fault(fmt::format("an <input> of {} has the offset {} and the set {}; export the "
                                    "scene again",
                                    describe(primitive), offset, set));
        Input input{element.attribute("semantic").value(),
                    element,
                    {},
                    static_cast<std::size_t>(offset),
                    static_cast<int>(set)};
        const char* const reference = element.attribute("source").value();
        if (input.semantic != "VERTEX") {
            input.source = tree.resolve(reference, {"source"}, element);
            inputs.push_back(std::move(input));
            continue;
        }
        const xml_node vertices = tree.resolve(reference, {"vertices"}, element);
        for (const xml_node& inner : vertices.children("input"))
            inputs.push_back(
                {inner.attribute("semantic").value(), inner,
                 tree.resolve(inner.attribute("source").value(), {"source"}, inner), input.offset,
                 static_cast<int>(std::min<std::uint64_t>(countOf(inner, "set", 0), 1u << 20))});
    }
    return inputs;
}

const Input* textureInput(const std::vector<Input>& inputs, int set) {
    const Input* result = nullptr;
    for (const Input& input : inputs) {
        if (input.semantic != "TEXCOORD")
            continue;
        if (input.set == set)
            return &input;
        if (result == nullptr || input.set < result->set)
            result = &input;
    }
    return result;
}

ColladaMesh readMesh(const Tree& tree, xml_node primitive, int set, const glm::dmat4& toWorld) {
    return MeshReader(tree, primitive, set, toWorld).read();
}

} // namespace patina::collada
