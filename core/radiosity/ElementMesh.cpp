#include "core/radiosity/ElementMesh.h"

#include "core/job/Parallel.h"
#include "core/math/Sampling.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace patina::radiosity {
namespace {

constexpr double kFlat = 1e-5; // of the longest edge: how far a quad's corner may be off its plane

struct Corner {
    glm::dvec3 position;
    glm::dvec2 uv;
    glm::vec3 normal;
    // Its place in the scene and on a texture is the same.
    friend bool operator==(const Corner& a, const Corner& b) {
        return a.position == b.position && a.uv == b.uv;
    }
};

void setCorner(Face& face, std::size_t k, const Corner& corner) {
    face.corners[k] = corner.position;
    face.uvs[k] = corner.uv;
    face.normals[k] = corner.normal;
}

std::array<Corner, 3> cornersOf(const BakeGeometryMesh& mesh, std::uint32_t triangle) {
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh.mesh->indices[3 * triangle + k];
        corners[k] = {mesh.positions[vertex], mesh.mesh->uvs[vertex], mesh.normals[vertex]};
    }
    return corners;
}

glm::dvec3 areaVectorOf(const Face& face) {
    return areaVector({face.corners.data(), face.cornerCount});
}

// Every corner turns left about the normal.
bool isConvex(const Face& face, const glm::dvec3& normal) {
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec3 in = face.corners[(k + 1) % 4] - face.corners[k],
                         out = face.corners[(k + 2) % 4] - face.corners[(k + 1) % 4];
        if (!(glm::dot(glm::cross(in, out), normal) > 1e-6 * glm::length(in) * glm::length(out)))
            return false;
    }
    return true;
}

// The quad of two triangles that follow one another and share an edge, its place on a texture too.
// False: they make none.
bool makeQuad(const std::array<Corner, 3>& first, const std::array<Corner, 3>& second, Face& face) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            // The edge from first[i] to first[i + 1] runs the other way in the second.
            if (first[i] != second[(k + 1) % 3] || first[(i + 1) % 3] != second[k])
                continue;
            const std::array<Corner, 4> corners{first[i], second[(k + 2) % 3], first[(i + 1) % 3],
                                                first[(i + 2) % 3]};
            for (std::size_t c = 0; c < 4; ++c)
                setCorner(face, c, corners[c]);
            face.cornerCount = 4;
            const glm::dvec3 area = areaVectorOf(face);
            const double length = glm::length(area);
            if (!(length > 0.0))
                return false;
            const glm::dvec3 normal = area / length;
            double longest = 0.0, off = 0.0;
            for (std::size_t c = 0; c < 4; ++c) {
                const glm::dvec3 edge = face.corners[(c + 1) % 4] - face.corners[c];
                longest = std::max(longest, glm::length(edge));
                off = std::max(off, std::abs(glm::dot(normal, face.corners[c] - face.corners[0])));
            }
            // A map stretched otherwise over each triangle would not be bilinear.
            const glm::dvec2 skew = face.uvs[0] - face.uvs[1] + face.uvs[2] - face.uvs[3];
            const bool mapped = glm::length(skew) < 1e-4;
            return mapped && off <= kFlat * longest && isConvex(face, normal);
        }
    return false;
}

void reverse(Face& face) {
    std::reverse(face.corners.begin() + 1, face.corners.begin() + face.cornerCount);
    std::reverse(face.uvs.begin() + 1, face.uvs.begin() + face.cornerCount);
    std::reverse(face.normals.begin() + 1, face.normals.begin() + face.cornerCount);
    face.normal = -face.normal;
}

// Columns and rows of a face, so that no element is longer or larger than the limits say.
void divideFace(Face& face, const ElementLimits& limits, double metresPerUnit) {
    const auto edge = [&](std::size_t a, std::size_t b) {
        return metresPerUnit * glm::length(face.corners[a] - face.corners[b]);
    };
    const auto parts = [&](double length, double limit) {
        const double count = limit > 0.0 ? std::ceil(length / limit * (1.0 - 1e-9)) : 1.0;
        return static_cast<std::uint32_t>(std::clamp(count, 1.0, 65536.0));
    };
    const double area = metresPerUnit * metresPerUnit * glm::length(areaVectorOf(face));
    if (face.cornerCount == 3) {
        const double longest = std::max({edge(0, 1), edge(1, 2), edge(2, 0)});
        face.columns = parts(longest, limits.maxEdge);
        if (limits.maxArea > 0.0)
            face.columns =
                std::max(face.columns, parts(std::sqrt(area), std::sqrt(limits.maxArea)));
        face.rows = face.columns;
        return;
    }
    const double across = std::max(edge(0, 1), edge(3, 2)), up = std::max(edge(1, 2), edge(0, 3));
    face.columns = parts(across, limits.maxEdge);
    face.rows = parts(up, limits.maxEdge);
    if (limits.maxArea > 0.0) {
        // About square.
        face.columns = std::max(face.columns, parts(across, std::sqrt(limits.maxArea)));
        // A quad's cells differ in size: the largest is at a corner.
        double largest = 0.0;
        for (std::size_t k = 0; k < 4; ++k)
            largest = std::max(
                largest, glm::length(glm::cross(face.corners[(k + 1) % 4] - face.corners[k],
                                                face.corners[(k + 3) % 4] - face.corners[k])));
        largest *= metresPerUnit * metresPerUnit;
        face.rows = std::max(face.rows, parts(largest / face.columns, limits.maxArea));
    }
}

// Where the columns or rows of a grid begin that is even but for `cuts`, and 1: between two of
// these there are as many as keep to the width of the even ones.
std::vector<float> linesOf(std::uint32_t even, std::vector<float> cuts) {
    std::erase_if(cuts, [](float at) { return at < FaceCut::kSame || at > 1.0f - FaceCut::kSame; });
    std::ranges::sort(cuts);
    const auto same = [](float a, float b) { return b - a < FaceCut::kSame; };
    cuts.erase(std::unique(cuts.begin(), cuts.end(), same), cuts.end());
    cuts.push_back(1.0f);
    std::vector<float> lines;
    float from = 0.0f;
    for (const float to : cuts) {
        const int parts = std::max(
            1, static_cast<int>(std::ceil((to - from) * static_cast<float>(even) - 1e-3f)));
        for (int i = 0; i < parts; ++i)
            lines.push_back(from + (to - from) * static_cast<float>(i) / static_cast<float>(parts));
        from = to;
    }
    lines.push_back(1.0f);
    return lines;
}

double cross2(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

Error tooManyElements(double count, std::size_t allowed) {
    return {ErrorKind::Usage,
            fmt::format("The scene would be divided into {:.0f} elements, and {} are allowed; "
                        "divide it less finely.",
                        count, allowed),
            {},
            {}};
}

// The two coordinates in which the face is largest.
glm::dvec2 flattened(const glm::dvec3& v, const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    if (size.x >= size.y && size.x >= size.z)
        return {v.y, v.z};
    return size.y >= size.z ? glm::dvec2(v.z, v.x) : glm::dvec2(v.x, v.y);
}

} // namespace

glm::dvec3 positionOn(const Face& face, const glm::dvec2& at) {
    const std::array<glm::dvec3, 4>& c = face.corners;
    if (face.cornerCount == 3)
        return c[0] + at.x * (c[1] - c[0]) + at.y * (c[2] - c[0]);
    return glm::mix(glm::mix(c[0], c[1], at.x), glm::mix(c[3], c[2], at.x), at.y);
}

glm::dvec2 uvOn(const Face& f, const glm::dvec2& at) {
    if (f.cornerCount == 3)
        return f.uvs[0] + at.x * (f.uvs[1] - f.uvs[0]) + at.y * (f.uvs[2] - f.uvs[0]);
    return glm::mix(glm::mix(f.uvs[0], f.uvs[1], at.x), glm::mix(f.uvs[3], f.uvs[2], at.x), at.y);
}

glm::vec3 normalOn(const Face& face, const glm::dvec2& at) {
    const std::array<glm::vec3, 4>& n = face.normals;
    const glm::vec2 w(at);
    const glm::vec3 mean =
        face.cornerCount == 3 ? (1.0f - w.x - w.y) * n[0] + w.x * n[1] + w.y * n[2]
                              : glm::mix(glm::mix(n[0], n[1], w.x), glm::mix(n[3], n[2], w.x), w.y);
    const float length = glm::length(mean);
    return length > 1e-3f ? mean / length : glm::vec3(face.normal);
}

glm::dvec2 coordinatesOn(const Face& face, const glm::dvec3& position) {
    const std::array<glm::dvec3, 4>& c = face.corners;
    const auto flat = [&](const glm::dvec3& v) { return flattened(v, face.normal); };
    const glm::dvec2 p = flat(position - c[0]), e = flat(c[1] - c[0]);
    const glm::dvec2 f = flat(c[face.cornerCount - 1] - c[0]);
    if (face.cornerCount == 3) {
        const double twice = cross2(e, f);
        return {cross2(p, f) / twice, cross2(e, p) / twice};
    }
    // p = u e + v f + u v g: what crosses (e + v g) is 0 gives v of a quadratic equation.
    const glm::dvec2 g = flat(c[0] - c[1] + c[2] - c[3]);
    const double k2 = cross2(g, f), k1 = cross2(e, f) + cross2(p, g), k0 = -cross2(e, p);
    const double root = std::sqrt(std::max(0.0, k1 * k1 - 4.0 * k0 * k2));
    // The solution that stays finite as g vanishes.
    const double v = 2.0 * k0 / -(k1 + (cross2(e, f) < 0.0 ? -root : root));
    const glm::dvec2 way = e + v * g, left = p - v * f;
    const double u = glm::dot(left, way) / glm::dot(way, way);
    return {u, v};
}

Result<ElementMesh> ElementMesh::make(const BakeGeometry& geometry, const ElementLimits& limits) {
    const bool patches = limits.patchArea > 0.0;
    if (patches && limits.patchArea < limits.maxArea * (1.0 - 1e-9))
        return Error{
            ErrorKind::Usage,
            fmt::format("Patches of {:.3g} m² are smaller than elements of {:.3g} m², into "
                        "which they are divided; make patches larger, or elements smaller.",
                        limits.patchArea, limits.maxArea),
            {},
            {}};
    ElementLimits grid = limits;
    if (patches)
        grid.maxArea = limits.patchArea;
    ElementMesh result;
    result.m_geometry = &geometry;
    result.m_metresPerUnit = 1.0 / geometry.unitsPerMetre;
    double count = 0.0;
    const auto add = [&](Face face, bool back) {
        if (back) {
            reverse(face);
            for (glm::vec3& normal : face.normals)
                normal = -normal;
        }
        face.back = back;
        divideFace(face, grid, result.m_metresPerUnit);
        const auto index = static_cast<std::uint32_t>(result.m_faces.size());
        std::vector<float> columnCuts, rowCuts;
        for (const FaceCut& cut : limits.cuts)
            if (cut.face == index && face.cornerCount == 4)
                (cut.row ? rowCuts : columnCuts).push_back(cut.at);
        if (!columnCuts.empty() || !rowCuts.empty()) {
            Lines& lines = result.m_lines[index];
            lines = {linesOf(face.columns, std::move(columnCuts)),
                     linesOf(face.rows, std::move(rowCuts))};
            face.columns = static_cast<std::uint32_t>(lines.columns.size()) - 1;
            face.rows = static_cast<std::uint32_t>(lines.rows.size()) - 1;
            face.cut = face.fenced = true;
        }
        count += static_cast<double>(face.columns) * face.rows;
        for (const std::uint32_t triangle : face.triangles)
            if (triangle != kNone)
                result.m_faceOf[result.m_firstTriangle[face.mesh] + triangle][back] = index;
        result.m_faces.push_back(face);
    };
    for (std::uint32_t m = 0; m < geometry.meshes.size(); ++m) {
        const BakeGeometryMesh& mesh = geometry.meshes[m];
        const auto triangles = static_cast<std::uint32_t>(mesh.mesh->triangleCount());
        result.m_firstTriangle.push_back(static_cast<std::uint32_t>(result.m_faceOf.size()));
        result.m_faceOf.resize(result.m_faceOf.size() + triangles, {kNone, kNone});
        for (std::uint32_t t = 0; t < triangles; ++t) {
            Face face;
            face.mesh = m;
            face.triangles = {t, kNone};
            const std::array<Corner, 3> corners = cornersOf(mesh, t);
            if (t + 1 < triangles && makeQuad(corners, cornersOf(mesh, t + 1), face)) {
                face.triangles[1] = ++t;
            } else {
                face.cornerCount = 3;
                for (std::size_t k = 0; k < 3; ++k)
                    setCorner(face, k, corners[k]);
            }
            const glm::dvec3 area = areaVectorOf(face);
            const double size = glm::length(area);
            if (!(size > 0.0))
                continue; // no area: reflects and receives nothing
            face.normal = area / size;
            if (mesh.winding < 0.0f)
                reverse(face);
            add(face, false);
            if (mesh.doubleSided)
                add(face, true);
        }
    }
    if (result.m_faces.empty())
        return Error{ErrorKind::InputBroken,
                     "The scene has no faces that light could fall on; add a mesh whose triangles "
                     "have an area.",
                     {},
                     {}};
    if (count > static_cast<double>(limits.maxElements))
        return tooManyElements(count, limits.maxElements);
    for (std::uint32_t f = 0; f < result.m_faces.size(); ++f) {
        Face& face = result.m_faces[f];
        face.firstNode = static_cast<std::uint32_t>(result.m_nodes.size());
        const glm::vec2 extent(1.0f / static_cast<float>(face.columns),
                               1.0f / static_cast<float>(face.rows));
        const auto addNode = [&](std::uint32_t x, std::uint32_t y, const glm::vec2& size) {
            const glm::vec2 origin(static_cast<float>(x) / static_cast<float>(face.columns),
                                   static_cast<float>(y) / static_cast<float>(face.rows));
            result.m_nodes.push_back({origin, size, f, kNone, kNone, kNone});
        };
        if (face.cut) {
            const Lines& lines = result.m_lines.at(f);
            for (std::uint32_t y = 0; y < face.rows; ++y)
                for (std::uint32_t x = 0; x < face.columns; ++x) {
                    const glm::vec2 from(lines.columns[x], lines.rows[y]);
                    result.m_nodes.push_back(
                        {from, glm::vec2(lines.columns[x + 1], lines.rows[y + 1]) - from, f, kNone,
                         kNone, kNone});
                }
            continue;
        }
        for (std::uint32_t y = 0; y < face.rows; ++y)
            if (face.cornerCount == 4) {
                for (std::uint32_t x = 0; x < face.columns; ++x)
                    addNode(x, y, extent);
            } else { // a row of triangles, upright and inverted ones in turn
                for (std::uint32_t x = 0; x + y < face.columns; ++x) {
                    addNode(x, y, extent);
                    if (x + y + 1 < face.columns)
                        addNode(x + 1, y + 1, -extent);
                }
            }
    }
    if (patches)
        result.m_patchCount = static_cast<std::uint32_t>(result.m_nodes.size());
    result.number();
    if (patches && limits.maxArea > 0.0)
        if (Result<void> divided = result.dividePatches(limits); !divided)
            return divided.error();
    return result;
}

Result<void> ElementMesh::dividePatches(const ElementLimits& limits) {
    // The cells of one face as often as one another, so that they stay a grid; what they differ by
    // through rounding of their coordinates divides nothing.
    constexpr double kRounding = 1e-5;
    for (;;) {
        std::vector<double> largest(m_faces.size(), 0.0);
        for (std::uint32_t e = 0; e < size(); ++e)
            largest[node(e).face] = std::max(largest[node(e).face], area(e));
        std::vector<std::uint32_t> tooLarge;
        for (std::uint32_t e = 0; e < size(); ++e)
            if (largest[node(e).face] > limits.maxArea * (1.0 + kRounding))
                tooLarge.push_back(e);
        if (tooLarge.empty())
            return {};
        if (const std::size_t count = size() + 3 * tooLarge.size(); count > limits.maxElements)
            return tooManyElements(static_cast<double>(count), limits.maxElements);
        divide(tooLarge);
    }
}

void ElementMesh::number() {
    m_elements.clear();
    for (std::uint32_t n = 0; n < m_nodes.size(); ++n) {
        m_nodes[n].element = kNone;
        if (m_nodes[n].firstChild == kNone) {
            m_nodes[n].element = static_cast<std::uint32_t>(m_elements.size());
            m_elements.push_back(n);
        }
    }
    m_exposed.clear();
    if (m_patchCount > 0) {
        m_patches.of.resize(m_elements.size());
        m_patches.first.assign(m_patchCount + std::size_t{1}, 0);
        for (std::uint32_t e = 0; e < m_elements.size(); ++e) {
            std::uint32_t n = m_elements[e];
            while (m_nodes[n].parent != kNone)
                n = m_nodes[n].parent;
            m_patches.of[e] = n;
            ++m_patches.first[n + 1];
        }
        for (std::uint32_t p = 0; p < m_patchCount; ++p)
            m_patches.first[p + 1] += m_patches.first[p];
        m_patches.elements.resize(m_elements.size());
        std::vector<std::uint32_t> next(m_patches.first.begin(), m_patches.first.end() - 1);
        for (std::uint32_t e = 0; e < m_elements.size(); ++e)
            m_patches.elements[next[m_patches.of[e]]++] = e;
    }
    m_areas.resize(m_elements.size());
    for (std::uint32_t e = 0; e < m_elements.size(); ++e)
        m_areas[e] =
            m_metresPerUnit * m_metresPerUnit * glm::length(areaVector(polygon(e).points()));
}

Polygon ElementMesh::polygon(const Node& n) const {
    const Face& f = m_faces[n.face];
    const glm::dvec2 o(n.origin), x(n.extent.x, 0.0), y(0.0, n.extent.y);
    Polygon result;
    result.add(positionOn(f, o));
    result.add(positionOn(f, o + x));
    if (f.cornerCount == 4)
        result.add(positionOn(f, o + x + y));
    result.add(positionOn(f, o + y));
    return result;
}

glm::dvec3 ElementMesh::centre(const Node& n) const {
    const Face& f = m_faces[n.face];
    const double share = f.cornerCount == 4 ? 0.5 : 1.0 / 3.0;
    return positionOn(f, glm::dvec2(n.origin) + share * glm::dvec2(n.extent));
}

float ElementMesh::senderExposed(std::uint32_t sender) const {
    if (m_patches.empty())
        return exposed(sender);
    double sum = 0.0, all = 0.0;
    bool wholly = true;
    for (const std::uint32_t element : m_patches.elementsOf(sender)) {
        sum += double{exposed(element)} * area(element);
        all += area(element);
        wholly = wholly && exposed(element) >= 1.0f;
    }
    return wholly ? 1.0f : static_cast<float>(sum / all);
}

bool ElementMesh::isSenderBuried(std::uint32_t sender, const glm::dvec2& at,
                                 const RayScene& rays) const {
    const std::uint32_t f = this->sender(sender).face;
    const std::uint32_t element = m_patches.empty() ? sender : elementAt(f, at);
    return isBuried(element, positionOn(m_faces[f], at), rays);
}

glm::dvec2 ElementMesh::samplePoint(const Node& n, const glm::vec2& u) const {
    const Face& f = m_faces[n.face];
    // Even over a triangle: Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
    const auto inTriangle = [](double x, double y) {
        return y > x ? glm::dvec2(0.5 * x, y - 0.5 * x) : glm::dvec2(x - 0.5 * y, 0.5 * y);
    };
    if (f.cornerCount == 3)
        return glm::dvec2(n.origin) + inTriangle(u.x, u.y) * glm::dvec2(n.extent);
    // Either triangle of the quad by its area, so that the point is even over it.
    const Polygon quad = polygon(n);
    const std::array<glm::dvec3, 4> c{quad.corners[0], quad.corners[1], quad.corners[2],
                                      quad.corners[3]};
    const double first = glm::length(glm::cross(c[1] - c[0], c[2] - c[0])),
                 second = glm::length(glm::cross(c[2] - c[0], c[3] - c[0]));
    const double share = first / (first + second);
    if (std::abs(share - 0.5) < 1e-12)
        return glm::dvec2(n.origin) + glm::dvec2(u) * glm::dvec2(n.extent);
    const bool inFirst = u.x < share;
    const glm::dvec2 w = inTriangle(inFirst ? u.x / share : (u.x - share) / (1.0 - share), u.y);
    const glm::dvec3 position = inFirst ? c[0] + w.x * (c[1] - c[0]) + w.y * (c[2] - c[0])
                                        : c[0] + w.x * (c[2] - c[0]) + w.y * (c[3] - c[0]);
    return coordinatesOn(f, position);
}

std::uint32_t ElementMesh::elementAt(std::uint32_t faceIndex, const glm::dvec2& at) const {
    const Face& f = m_faces[faceIndex];
    const auto cell = [](double x, std::uint32_t count) {
        const double scaled = std::clamp(x, 0.0, 1.0) * count;
        return std::min(static_cast<std::uint32_t>(scaled), count - 1);
    };
    const auto cellOf = [](double x, const std::vector<float>& lines) {
        const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, x);
        return static_cast<std::uint32_t>(above - lines.begin()) - 1;
    };
    std::uint32_t x = 0, y = 0, index = f.firstNode;
    if (f.cut) {
        const Lines& lines = m_lines.at(faceIndex);
        x = cellOf(at.x, lines.columns);
        y = cellOf(at.y, lines.rows);
    } else {
        x = cell(at.x, f.columns);
        y = cell(at.y, f.rows);
    }
    if (f.cornerCount == 4) {
        index += y * f.columns + x;
    } else {
        const std::uint32_t n = f.columns;
        x = std::min(x, n - 1 - y);
        const double restX = at.x * n - x, restY = at.y * n - y;
        const bool inverted = restX + restY > 1.0 && x + y + 1 < n;
        // Rows below have 2 n - 1, 2 n - 3 … triangles.
        index += y * (2 * n - y) + 2 * x + (inverted ? 1 : 0);
    }
    while (m_nodes[index].firstChild != kNone) {
        const Node& n = m_nodes[index];
        const glm::dvec2 place = (at - glm::dvec2(n.origin)) / glm::dvec2(n.extent);
        std::uint32_t child = 0;
        if (f.cornerCount == 4)
            child = (place.x >= 0.5 ? 1u : 0u) + (place.y >= 0.5 ? 2u : 0u);
        else if (place.x >= 0.5)
            child = 1;
        else if (place.y >= 0.5)
            child = 2;
        else if (place.x + place.y > 0.5)
            child = 3;
        index = n.firstChild + child;
    }
    return m_nodes[index].element;
}

std::uint32_t ElementMesh::met(const ClosestRay& ray) const {
    if (ray.mesh == ClosestRay::kNothing)
        return kNone;
    const BakeGeometryMesh& mesh = m_geometry->meshes[ray.mesh];
    const std::uint32_t* vertices = mesh.mesh->indices.data() + 3 * std::size_t{ray.triangle};
    const glm::dvec3 a(mesh.positions[vertices[0]]), b(mesh.positions[vertices[1]]),
        c(mesh.positions[vertices[2]]);
    const bool back =
        mesh.winding * glm::dot(glm::cross(b - a, c - a), glm::dvec3(ray.ray.direction)) > 0.0;
    const std::uint32_t index = m_faceOf[m_firstTriangle[ray.mesh] + ray.triangle][back];
    if (index == kNone)
        return kNone;
    const glm::dvec3 position = a + double{ray.u} * (b - a) + double{ray.v} * (c - a);
    return elementAt(index, coordinatesOn(m_faces[index], position));
}

bool ElementMesh::isBuried(std::uint32_t element, const glm::dvec3& position,
                           const RayScene& rays) const {
    if (exposed(element) >= 1.0f)
        return false;
    const glm::vec3 normal(face(element).normal);
    glm::vec3 x, y;
    orthonormalBasis(normal, x, y);
    // Backs in every direction: straight up, and flat to four sides.
    constexpr float kFlatSine = 0.96f, kFlatCosine = 0.28f;
    for (const glm::vec3& direction :
         {normal, kFlatSine * x + kFlatCosine * normal, kFlatSine * y + kFlatCosine * normal,
          -kFlatSine * x + kFlatCosine * normal, -kFlatSine * y + kFlatCosine * normal}) {
        ClosestRay ray;
        ray.ray.origin = glm::vec3(position) + kRayOffset * normal;
        ray.ray.direction = direction;
        rays.intersect({&ray, 1});
        if (ray.mesh == ClosestRay::kNothing || met(ray) != kNone)
            return false;
    }
    return true;
}

void ElementMesh::findBuried(const RayScene& rays, const JobContext& job) {
    constexpr std::uint32_t kPoints = 64;
    m_exposed.assign(size(), 0.5f); // asks every point
    std::vector<float> exposed(size(), 1.0f);
    parallelFor(job, size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            const auto element = static_cast<std::uint32_t>(e);
            std::uint32_t buried = 0;
            for (std::uint32_t i = 0; i < kPoints; ++i)
                buried += isBuried(element, samplePosition(element, sobolOwen2D(i, element)), rays)
                              ? 1
                              : 0;
            exposed[e] = 1.0f - static_cast<float>(buried) / float{kPoints};
        }
    });
    m_exposed = std::move(exposed);
}

std::vector<std::uint32_t> ElementMesh::divide(std::span<const std::uint32_t> elements) {
    const std::vector<std::uint32_t> before = m_elements;
    std::vector<std::uint32_t> oldOf(m_nodes.size(), kNone);
    for (std::uint32_t e = 0; e < before.size(); ++e)
        oldOf[before[e]] = e;
    for (const std::uint32_t element : elements) {
        const std::uint32_t parent = before[element];
        if (m_nodes[parent].firstChild != kNone)
            continue; // named twice
        const Node n = m_nodes[parent];
        const glm::vec2 half = 0.5f * n.extent;
        m_nodes[parent].firstChild = static_cast<std::uint32_t>(m_nodes.size());
        const auto child = [&](const glm::vec2& origin, const glm::vec2& extent) {
            m_nodes.push_back({origin, extent, n.face, kNone, parent, kNone});
            oldOf.push_back(element);
        };
        child(n.origin, half);
        child(n.origin + glm::vec2(half.x, 0.0f), half);
        child(n.origin + glm::vec2(0.0f, half.y), half);
        // The last: a quad's far corner, or a triangle's middle, the other way round.
        child(n.origin + half, m_faces[n.face].cornerCount == 4 ? half : -half);
    }
    number();
    std::vector<std::uint32_t> result(m_elements.size());
    for (std::uint32_t e = 0; e < m_elements.size(); ++e)
        result[e] = oldOf[m_elements[e]];
    return result;
}

void ElementMesh::setFenced(std::span<const std::uint32_t> elements) {
    for (const std::uint32_t element : elements)
        m_faces[node(element).face].fenced = true;
}

std::size_t ElementMesh::memoryBytes() const {
    return m_faces.capacity() * sizeof(Face) + m_nodes.capacity() * sizeof(Node) +
           m_elements.capacity() * sizeof(std::uint32_t) + m_areas.capacity() * sizeof(double) +
           m_faceOf.capacity() * sizeof(m_faceOf[0]) +
           m_firstTriangle.capacity() * sizeof(std::uint32_t) + m_patches.memoryBytes();
}

} // namespace patina::radiosity
