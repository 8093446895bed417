#include "core/radiosity/HemicubeFactors.h"

#include "core/math/Quadrature.h"
#include "core/math/Sampling.h"
#include "core/radiosity/HitCount.h"
#include "core/radiosity/PolygonFactor.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

namespace patina::radiosity {
namespace {

constexpr std::size_t kCellBatch = 2048;
// Points along each direction of an element that others are near to.
constexpr int kNearPoints = 3;
// How much nearer than its size others may be: Baum et al. 1989 found the hemicube's error to be
// small from five times on.
constexpr double kNearSizes = 5.0;

// The integral of 1 / (pi (x² + y² + 1)²) from the origin to (x, y).
double topFromOrigin(double x, double y) {
    const double a = std::sqrt(1.0 + x * x), b = std::sqrt(1.0 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2.0 * std::numbers::pi);
}

// The integral of z / (pi (y² + z² + 1)²), but for its sign, from y = 0 and z to infinity.
double sideAbove(double y, double z) {
    const double a = std::sqrt(1.0 + z * z);
    return std::atan(y / a) / (2.0 * std::numbers::pi * a);
}

} // namespace

double HemicubeCells::top(double x0, double x1, double y0, double y1) {
    return topFromOrigin(x1, y1) - topFromOrigin(x0, y1) - topFromOrigin(x1, y0) +
           topFromOrigin(x0, y0);
}

double HemicubeCells::side(double y0, double y1, double z0, double z1) {
    return sideAbove(y1, z0) - sideAbove(y0, z0) - sideAbove(y1, z1) + sideAbove(y0, z1);
}

HemicubeCells::HemicubeCells(int resolution)
    : m_resolution(resolution) {
    const double step = 2.0 / resolution;
    m_cells.reserve(3 * static_cast<std::size_t>(resolution) * resolution);
    const auto edge = [&](int i) { return i * step - 1.0; };
    for (int row = 0; row < resolution; ++row)
        for (int column = 0; column < resolution; ++column)
            m_cells.push_back({glm::vec3(glm::normalize(glm::dvec3(edge(column) + 0.5 * step,
                                                                   edge(row) + 0.5 * step, 1.0))),
                               top(edge(column), edge(column + 1), edge(row), edge(row + 1))});
    for (int face = 0; face < 4; ++face)
        for (int row = 0; row < resolution / 2; ++row)
            for (int column = 0; column < resolution; ++column) {
                const double along = edge(column) + 0.5 * step, up = (row + 0.5) * step;
                const double towards = face % 2 == 0 ? 1.0 : -1.0;
                const glm::dvec3 middle =
                    face < 2 ? glm::dvec3(towards, along, up) : glm::dvec3(along, towards, up);
                m_cells.push_back(
                    {glm::vec3(glm::normalize(middle)),
                     side(edge(column), edge(column + 1), row * step, (row + 1) * step)});
            }
}

std::span<const HemicubeCells::Cell> HemicubeCells::cells(Face face) const {
    const std::size_t whole = static_cast<std::size_t>(m_resolution) * m_resolution;
    if (face == Face::Top)
        return {m_cells.data(), whole};
    const auto index = static_cast<std::size_t>(face) - 1;
    return {m_cells.data() + whole + index * whole / 2, whole / 2};
}

HemicubeFactors::HemicubeFactors(const ElementMesh& elements, const RayScene& rays,
                                 const FactorSettings& settings)
    : m_elements(elements)
    , m_rays(rays)
    , m_settings(settings)
    , m_cells(settings.resolution) {}

bool HemicubeFactors::isNear(std::uint32_t sender, const FactorRow& row) const {
    const ElementMesh::Node& node = m_elements.sender(sender);
    const double size = std::sqrt(glm::length(areaVector(m_elements.polygon(node).points())));
    const glm::dvec3 centre = m_elements.centre(node);
    return std::any_of(row.shares.begin(), row.shares.end(), [&](const FactorRow::Share& share) {
        const double other = std::sqrt(m_elements.area(share.element)) / m_elements.metresPerUnit();
        const double distance = glm::length(m_elements.centre(share.element) - centre);
        return distance - 0.5 * other < kNearSizes * size;
    });
}

template <class Take>
void HemicubeFactors::look(std::uint32_t sender, const glm::dvec3& from, const Take& take) const {
    thread_local std::vector<ClosestRay> rays;
    const glm::vec3 normal(m_elements.faces()[m_elements.sender(sender).face].normal);
    // Rotated about the normal by an angle of the sender's own: edges of cells that line up with
    // those of elements would make the same error everywhere.
    glm::vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    const float angle = 6.2831853f * detail::unitFloat(seedFor(m_settings.seed, sender));
    const glm::vec3 x = std::cos(angle) * tangent + std::sin(angle) * bitangent;
    const glm::mat3 frame(x, glm::cross(normal, x), normal);
    const std::span<const HemicubeCells::Cell> cells = m_cells.cells();
    const glm::vec3 origin = glm::vec3(from) + kRayOffset * normal;
    for (std::size_t first = 0; first < cells.size(); first += kCellBatch) {
        const std::size_t size = std::min(kCellBatch, cells.size() - first);
        rays.assign(size, {});
        for (std::size_t i = 0; i < size; ++i) {
            rays[i].ray.origin = origin;
            rays[i].ray.direction = frame * cells[first + i].direction;
        }
        m_rays.intersect(rays);
        take(first, std::span<const ClosestRay>(rays));
    }
}

std::vector<std::uint32_t> HemicubeFactors::seenFromCentre(std::uint32_t sender) const {
    std::vector<std::uint32_t> seen;
    seen.reserve(m_cells.cells().size());
    const glm::dvec3 centre = m_elements.centre(m_elements.sender(sender));
    look(sender, centre, [&](std::size_t, std::span<const ClosestRay> rays) {
        for (const ClosestRay& ray : rays) {
            const std::uint32_t met = m_elements.met(ray);
            seen.push_back(met != kNone                       ? met
                           : ray.mesh != ClosestRay::kNothing ? kBack
                                                              : kOutside);
        }
    });
    return seen;
}

void HemicubeFactors::row(std::uint32_t sender, FactorRow& row) const {
    thread_local HitCount hits;
    const ElementMesh::Node& node = m_elements.sender(sender);
    const Face& face = m_elements.faces()[node.face];
    const auto add = [&](const glm::dvec3& from, double weight) {
        look(sender, from, [&](std::size_t first, std::span<const ClosestRay> rays) {
            for (std::size_t i = 0; i < rays.size(); ++i)
                hits.add(m_elements, rays[i], weight * m_cells.cells()[first + i].factor);
        });
    };
    add(m_elements.centre(node), 1.0);
    hits.finish(row);
    if (m_settings.classicalHemicube ||
        (!isNear(sender, row) && m_elements.senderExposed(sender) >= 1.0f))
        return;
    static const GaussLegendre kPoints(kNearPoints);
    for (int i = 0; i < kNearPoints; ++i)
        for (int k = 0; k < kNearPoints; ++k) {
            glm::dvec2 at(kPoints.node01(i), kPoints.node01(k));
            double weight = kPoints.weight01(i) * kPoints.weight01(k);
            if (face.cornerCount == 3) { // the square folded to a triangle
                weight *= 2.0 * (1.0 - at.x);
                at.y *= 1.0 - at.x;
            }
            const glm::dvec2 onFace = glm::dvec2(node.origin) + at * glm::dvec2(node.extent);
            if (!m_elements.isSenderBuried(sender, onFace, m_rays))
                add(positionOn(face, onFace), weight);
        }
    hits.finish(row);
}

} // namespace patina::radiosity
