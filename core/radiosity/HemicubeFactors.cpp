#include "core/radiosity/HemicubeFactors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

namespace patina::radiosity {
namespace {

constexpr std::size_t kCellBatch = 2048;
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
    : PointFactors(elements, rays, settings)
    , m_cells(settings.resolution) {
    m_weights.reserve(m_cells.cells().size());
    for (const HemicubeCells::Cell& cell : m_cells.cells())
        m_weights.push_back(cell.factor);
}

Result<std::unique_ptr<FormFactors>> HemicubeFactors::make(const ElementMesh& elements,
                                                           const RayScene& rays,
                                                           const FactorSettings& settings) {
    auto result = std::make_unique<HemicubeFactors>(elements, rays, settings);
    if (settings.drawer) {
        result->m_faces = std::make_unique<const FaceItems>(elements);
        auto drawn = settings.drawer->load(*result->m_faces, settings.resolution);
        if (!drawn)
            return drawn.error();
        result->m_drawn = *std::move(drawn);
    }
    return std::unique_ptr<FormFactors>(std::move(result));
}

void HemicubeFactors::look(std::uint32_t sender, const glm::vec3& from, const glm::mat3& frame,
                           std::span<std::uint32_t> seen) const {
    if (!m_drawn) {
        cast(from, frame, seen);
        return;
    }
    const PointView view(m_elements, sender, from, frame);
    m_drawn->draw(view, seen);
    m_faces->toElements(
        view, seen, [&](std::size_t cell) { return glm::dvec3(m_cells.cells()[cell].direction); });
}

void HemicubeFactors::cast(const glm::vec3& from, const glm::mat3& frame,
                           std::span<std::uint32_t> seen) const {
    thread_local std::vector<ClosestRay> rays;
    const std::span<const HemicubeCells::Cell> cells = m_cells.cells();
    const glm::vec3 origin = from + kRayOffset * frame[2];
    for (std::size_t first = 0; first < cells.size(); first += kCellBatch) {
        const std::size_t size = std::min(kCellBatch, cells.size() - first);
        rays.assign(size, {});
        for (std::size_t i = 0; i < size; ++i) {
            rays[i].ray.origin = origin;
            rays[i].ray.direction = frame * cells[first + i].direction;
        }
        m_rays.intersect(rays);
        for (std::size_t i = 0; i < size; ++i) {
            const std::uint32_t met = m_elements.met(rays[i]);
            seen[first + i] = met != kNone                           ? met
                              : rays[i].mesh != ClosestRay::kNothing ? kBack
                                                                     : kOutside;
        }
    }
}

} // namespace patina::radiosity
