#include "core/radiosity/Reconstruction.h"

#include "core/radiosity/ElementSides.h"
#include "core/radiosity/PointIndex.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace patina::radiosity {
namespace {

// Angle between the scene's normals of two faces at one point from which on their edge is a crease.
constexpr float kSameNormal = 0.9998f; // cos 1.1°

// A corner of an element's outline.
struct Outline {
    glm::dvec2 at; // on the face
    std::uint32_t point = 0;
};

class MeshMaker {
  public:
    MeshMaker(const ElementMesh& elements, const BakeGeometry& geometry, const RayScene& rays)
        : m_elements(elements)
        , m_geometry(geometry)
        , m_rays(rays) {}

    LitMesh make() {
        findPoints();
        for (std::uint32_t e = 0; e < m_elements.size(); ++e)
            add(e);
        return std::move(m_mesh);
    }

  private:
    using EdgeKey = std::pair<std::uint32_t, std::uint32_t>; // points at its ends, ascending

    // Coordinates of an element's corners on its face.
    [[nodiscard]] std::vector<glm::dvec2> cornersOf(std::uint32_t element) const {
        const ElementMesh::Node& node = m_elements.node(element);
        const glm::dvec2 o(node.origin), x(node.extent.x, 0.0), y(0.0, node.extent.y);
        if (m_elements.face(element).cornerCount == 3)
            return {o, o + x, o + y};
        return {o, o + x, o + x + y, o + y};
    }

    // Which edge of its face both places are on; its number, or -1. `t`: how far along it, 0…1.
    static int faceEdge(const Face& face, const glm::dvec2& a, const glm::dvec2& b, double& ta,
                        double& tb) {
        constexpr double kOn = 1e-6;
        const auto on = [&](double va, double vb, double value) {
            return std::abs(va - value) < kOn && std::abs(vb - value) < kOn;
        };
        if (on(a.y, b.y, 0.0)) {
            ta = a.x;
            tb = b.x;
            return 0;
        }
        if (face.cornerCount == 3) {
            if (on(a.x + a.y, b.x + b.y, 1.0)) {
                ta = a.y;
                tb = b.y;
                return 1;
            }
            if (on(a.x, b.x, 0.0)) {
                ta = 1.0 - a.y;
                tb = 1.0 - b.y;
                return 2;
            }
            return -1;
        }
        if (on(a.x, b.x, 1.0)) {
            ta = a.y;
            tb = b.y;
            return 1;
        }
        if (on(a.y, b.y, 1.0)) {
            ta = 1.0 - a.x;
            tb = 1.0 - b.x;
            return 2;
        }
        if (on(a.x, b.x, 0.0)) {
            ta = 1.0 - a.y;
            tb = 1.0 - b.y;
            return 3;
        }
        return -1;
    }

    // The edge of the scene that a face's edge is, and whether it runs the other way there.
    std::pair<EdgeKey, bool> edgeOf(const Face& face, int edge) {
        const auto first = static_cast<std::size_t>(edge);
        const std::uint32_t a = m_points.add(face.corners[first]),
                            b = m_points.add(face.corners[(first + 1) % face.cornerCount]);
        return {{std::min(a, b), std::max(a, b)}, a > b};
    }

    void findPoints() {
        for (std::uint32_t e = 0; e < m_elements.size(); ++e) {
            const Face& face = m_elements.face(e);
            const std::vector<glm::dvec2> corners = cornersOf(e);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const glm::dvec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
                const std::uint32_t point = m_points.add(positionOn(face, a));
                double ta = 0.0, tb = 0.0;
                const int edge = faceEdge(face, a, b, ta, tb);
                if (edge < 0)
                    continue;
                const auto [key, reversed] = edgeOf(face, edge);
                std::vector<std::pair<double, std::uint32_t>>& along = m_alongEdge[key];
                along.emplace_back(reversed ? 1.0 - ta : ta, point);
            }
        }
        for (auto& [key, along] : m_alongEdge) {
            std::sort(along.begin(), along.end());
            along.erase(
                std::unique(along.begin(), along.end(),
                            [](const auto& a, const auto& b) { return a.second == b.second; }),
                along.end());
        }
    }

    // Points strictly between a and b on an edge of the face.
    void addAlongFaceEdge(const Face& face, int edge, const glm::dvec2& a, const glm::dvec2& b,
                          double ta, double tb, std::vector<Outline>& outline) {
        const auto [key, reversed] = edgeOf(face, edge);
        std::vector<std::pair<double, std::uint32_t>> found;
        const double low = std::min(ta, tb), high = std::max(ta, tb);
        for (const auto& [along, point] : m_alongEdge[key]) {
            const double t = reversed ? 1.0 - along : along;
            if (t > low + 1e-6 && t < high - 1e-6)
                found.emplace_back((t - ta) / (tb - ta), point);
        }
        std::sort(found.begin(), found.end());
        for (const auto& [t, point] : found)
            outline.push_back({glm::mix(a, b, t), point});
    }

    // Within a face all that is smaller is halves of halves.
    void addHalves(const Face& face, const glm::dvec2& a, const glm::dvec2& b, int depth,
                   std::vector<Outline>& outline) {
        const glm::dvec2 middle = 0.5 * (a + b);
        const std::uint32_t point = m_points.find(positionOn(face, middle));
        if (depth == 0 || point == kNone)
            return;
        addHalves(face, a, middle, depth - 1, outline);
        outline.push_back({middle, point});
        addHalves(face, middle, b, depth - 1, outline);
    }

    // Whether light runs on from the element of a vertex to another one there.
    [[nodiscard]] bool runsOn(std::uint32_t vertex, std::uint32_t element) const {
        const std::uint32_t owner = m_owners[vertex];
        return owner == element ||
               !(m_elements.face(owner).fenced || m_elements.face(element).fenced) ||
               !isWallBetween(m_elements, owner, element, m_rays);
    }

    std::uint32_t vertex(std::uint32_t element, const Outline& corner) {
        const Face& face = m_elements.face(element);
        const glm::vec3 normal = normalOn(face, corner.at);
        const glm::vec2 uv(uvOn(face, corner.at));
        const std::uint64_t key = std::uint64_t{corner.point} << 32 | (2 * face.mesh + face.back);
        std::vector<std::uint32_t>& here = m_vertices[key];
        std::uint32_t light = kNone;
        for (const std::uint32_t v : here) {
            const LitMesh::Vertex& other = m_mesh.vertices[v];
            if (glm::dot(other.normal, normal) < kSameNormal || !runsOn(v, element))
                continue;
            light = other.light;
            if (glm::length(other.uv - uv) < 1e-5f)
                return v;
        }
        if (light == kNone)
            light = static_cast<std::uint32_t>(m_mesh.lights++);
        const glm::dvec3 world =
            m_points.position(corner.point) / m_geometry.unitsPerMetre + m_geometry.centre;
        here.push_back(static_cast<std::uint32_t>(m_mesh.vertices.size()));
        m_mesh.vertices.push_back({glm::vec3(world), normal, uv, light});
        m_owners.push_back(element);
        return here.back();
    }

    void add(std::uint32_t element) {
        const Face& face = m_elements.face(element);
        const std::vector<glm::dvec2> corners = cornersOf(element);
        std::vector<Outline> outline;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const glm::dvec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
            outline.push_back({a, m_points.add(positionOn(face, a))});
            double ta = 0.0, tb = 0.0;
            const int edge = faceEdge(face, a, b, ta, tb);
            if (edge >= 0)
                addAlongFaceEdge(face, edge, a, b, ta, tb, outline);
            else
                addHalves(face, a, b, 16, outline);
        }
        std::vector<std::uint32_t> v;
        for (const Outline& corner : outline)
            v.push_back(vertex(element, corner));
        const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            m_mesh.triangles.push_back({{a, b, c}, element});
        };
        if (v.size() == 3) {
            triangle(v[0], v[1], v[2]);
        } else if (v.size() == 4 && corners.size() == 4) {
            const auto distance = [&](std::size_t i, std::size_t k) {
                return glm::length(m_mesh.vertices[v[i]].position - m_mesh.vertices[v[k]].position);
            };
            if (distance(0, 2) <= distance(1, 3) * 1.001f) {
                triangle(v[0], v[1], v[2]);
                triangle(v[0], v[2], v[3]);
            } else {
                triangle(v[0], v[1], v[3]);
                triangle(v[1], v[2], v[3]);
            }
        } else {
            glm::dvec2 middle(0.0);
            for (const glm::dvec2& corner : corners)
                middle += corner / static_cast<double>(corners.size());
            const std::uint32_t centre =
                vertex(element, {middle, m_points.add(positionOn(face, middle))});
            for (std::size_t k = 0; k < v.size(); ++k)
                triangle(v[k], v[(k + 1) % v.size()], centre);
        }
    }

    const ElementMesh& m_elements;
    const BakeGeometry& m_geometry;
    const RayScene& m_rays;
    PointIndex m_points;
    std::map<EdgeKey, std::vector<std::pair<double, std::uint32_t>>> m_alongEdge;
    std::map<std::uint64_t, std::vector<std::uint32_t>> m_vertices;
    LitMesh m_mesh;
    std::vector<std::uint32_t> m_owners; // of each vertex the element that it was made for
};

} // namespace

double LitMesh::area(const Triangle& triangle) const {
    const glm::dvec3 a(vertices[triangle.vertices[0]].position),
        b(vertices[triangle.vertices[1]].position), c(vertices[triangle.vertices[2]].position);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

LitMesh litMesh(const ElementMesh& elements, const BakeGeometry& geometry, const RayScene& rays) {
    return MeshMaker(elements, geometry, rays).make();
}

} // namespace patina::radiosity
