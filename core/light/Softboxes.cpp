#include "core/light/Softboxes.h"

#include "core/job/Parallel.h"
#include "core/light/LatLongGrid.h"
#include "core/math/Quadrature.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <vector>

namespace patina {

SoftboxShape::SoftboxShape(const Softbox& softbox)
    : m_axis(directionFromAngles(softbox.azimuthDeg, softbox.elevationDeg))
    , m_half(std::tan(glm::radians(0.5 * softbox.widthDeg)),
             std::tan(glm::radians(0.5 * softbox.heightDeg)))
    , m_fade(softbox.softness * std::min(m_half.x, m_half.y)) {
    // Azimuth grows to the left as seen from the centre.
    const glm::dvec3 right = directionFromAngles(softbox.azimuthDeg - 90.0, 0.0);
    const glm::dvec3 up = glm::cross(right, m_axis);
    const double roll = glm::radians(static_cast<double>(softbox.rollDeg));
    m_right = right * std::cos(roll) + up * std::sin(roll);
    m_up = up * std::cos(roll) - right * std::sin(roll);
}

std::optional<glm::dvec2> SoftboxShape::local(const glm::dvec3& d) const {
    const double depth = glm::dot(d, m_axis);
    if (depth < 1e-6) // beside or behind: the plane is not met, or too far out to matter
        return std::nullopt;
    return glm::dvec2(glm::dot(d, m_right), glm::dot(d, m_up)) / depth;
}

glm::dvec3 SoftboxShape::direction(const glm::dvec2& local) const {
    return glm::normalize(m_axis + local.x * m_right + local.y * m_up);
}

double SoftboxShape::weight(const glm::dvec2& local) const {
    const glm::dvec2 inward = m_half - glm::abs(local); // distance from the edges
    if (inward.x <= 0.0 || inward.y <= 0.0)
        return 0.0;
    if (m_fade <= 0.0)
        return 1.0;
    return glm::smoothstep(0.0, m_fade, inward.x) * glm::smoothstep(0.0, m_fade, inward.y);
}

double solidAngle(const Softbox& softbox) {
    return 4.0 * std::asin(std::sin(glm::radians(0.5 * softbox.widthDeg)) *
                           std::sin(glm::radians(0.5 * softbox.heightDeg)));
}

double luminousSolidAngle(const Softbox& softbox) {
    const SoftboxShape shape(softbox);
    if (shape.fade() <= 0.0)
        return solidAngle(softbox);
    // A quarter of the plane, dω = dx dy / (1 + x² + y²)^(3/2), in pieces on which it is smooth.
    const GaussLegendre rule(32);
    const glm::dvec2 half = shape.half(), core = half - shape.fade();
    double sum = 0.0;
    const auto addPiece = [&](const glm::dvec2& from, const glm::dvec2& to) {
        for (int j = 0; j < rule.size(); ++j)
            for (int i = 0; i < rule.size(); ++i) {
                const glm::dvec2 p = glm::mix(from, to, glm::dvec2(rule.node01(i), rule.node01(j)));
                const double r2 = 1.0 + glm::dot(p, p);
                sum += rule.weight01(i) * rule.weight01(j) * (to.x - from.x) * (to.y - from.y) *
                       shape.weight(p) / (r2 * std::sqrt(r2));
            }
    };
    addPiece({0.0, 0.0}, core);
    addPiece({core.x, 0.0}, {half.x, core.y});
    addPiece({0.0, core.y}, {core.x, half.y});
    addPiece(core, half);
    return 4.0 * sum;
}

namespace {

// Mean weight of a texel: one sample where the weight is plain, a grid of them at the edges.
double texelWeight(const SoftboxShape& shape, const LatLongGrid& grid, int x, int y, int parts) {
    const auto center = shape.local(grid.direction(x, y));
    if (center) {
        // The texel in the plane: a disc beyond its corners, stretched by the slant of the plane.
        const double reach = grid.texelAngle() * (1.0 + glm::dot(*center, *center));
        const glm::dvec2 inward = shape.half() - glm::abs(*center);
        const double nearest = std::min(inward.x, inward.y);
        if (nearest < -reach)
            return 0.0;
        if (nearest > shape.fade() + reach)
            return 1.0;
    }
    double sum = 0.0;
    for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i) {
            const glm::dvec2 p = subTexel(i, j, parts, parts);
            if (const auto local = shape.local(grid.directionAt(x + p.x, y + p.y)))
                sum += shape.weight(*local);
        }
    return sum / (parts * parts);
}

} // namespace

Image softboxImage(std::span<const Softbox> softboxes, const glm::vec3& ambient, int height,
                   const JobContext& job) {
    const LatLongGrid grid(height);
    const auto width = static_cast<std::size_t>(grid.width());
    Image image(grid.width(), height, 3, PixelType::F32, ColorEncoding::Linear);
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    auto* pixels = reinterpret_cast<glm::vec3*>(image.f32().data());
    std::fill_n(pixels, width * static_cast<std::size_t>(height), ambient);

    std::vector<float> weights;
    for (const Softbox& softbox : softboxes) {
        if (!softbox.enabled)
            continue;
        const SoftboxShape shape(softbox);
        // Only rows that the circle around the rectangle meets, and texels within that circle.
        const double radius = std::atan(glm::length(shape.half())) + grid.texelAngle();
        const double cosRadius = std::cos(radius);
        // Sharp edges need finer samples than soft ones, and small boxes finer than texels.
        const double smallSide = glm::radians(std::min(softbox.widthDeg, softbox.heightDeg));
        const int parts =
            std::max(shape.fade() > 4.0 * grid.texelAngle() ? 3 : 8,
                     static_cast<int>(std::ceil(4.0 * grid.texelAngle() / smallSide)));
        const double polar = glm::radians(90.0 - softbox.elevationDeg);
        const glm::ivec2 rows = grid.rowsBetween(polar - radius, polar + radius);
        const auto count = static_cast<std::size_t>(rows[1] - rows[0]);
        weights.assign(count * width, 0.0f);
        std::vector<double> sums(count);
        parallelFor(job, count, grid.rowsPerRange(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                const int y = rows[0] + static_cast<int>(row);
                double sum = 0.0;
                for (std::size_t x = 0; x < width; ++x) {
                    const int column = static_cast<int>(x);
                    if (glm::dot(grid.direction(column, y), shape.axis()) < cosRadius)
                        continue;
                    const double weight = texelWeight(shape, grid, column, y, parts);
                    weights[row * width + x] = static_cast<float>(weight);
                    sum += weight;
                }
                sums[row] = sum * grid.solidAngle(y);
            }
        });

        // The grids' small error is taken out, so that the flux is exact.
        double total = 0.0;
        for (const double sum : sums)
            total += sum;
        if (total <= 0.0)
            continue; // cancelled
        const glm::vec3 radiance =
            softbox.color *
            static_cast<float>(softbox.intensity * (luminousSolidAngle(softbox) / total));
        glm::vec3* first = pixels + static_cast<std::size_t>(rows[0]) * width;
        for (std::size_t i = 0; i < weights.size(); ++i)
            first[i] += radiance * weights[i];
    }
    return image;
}

} // namespace patina
