#include "core/radiosity/PointFactors.h"

#include "core/math/Sampling.h"
#include "core/radiosity/HitCount.h"
#include "core/radiosity/PolygonFactor.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina::radiosity {
namespace {

// How much nearer than its size others may be: Baum et al. 1989 found the hemicube's error to be
// small from five times on.
constexpr double kNearSizes = 5.0;

} // namespace

glm::mat3 PointFactors::frameOf(std::uint32_t sender) const {
    const glm::vec3 normal(m_elements.faces()[m_elements.sender(sender).face].normal);
    glm::vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    const float angle = 6.2831853f * detail::unitFloat(seedFor(m_settings.seed, sender));
    const glm::vec3 x = std::cos(angle) * tangent + std::sin(angle) * bitangent;
    return {x, glm::cross(normal, x), normal};
}

bool PointFactors::isNear(std::uint32_t sender, const FactorRow& row) const {
    const ElementMesh::Node& node = m_elements.sender(sender);
    const double size = std::sqrt(glm::length(areaVector(m_elements.polygon(node).points())));
    const glm::dvec3 centre = m_elements.centre(node);
    return std::any_of(row.shares.begin(), row.shares.end(), [&](const FactorRow::Share& share) {
        const double other = std::sqrt(m_elements.area(share.element)) / m_elements.metresPerUnit();
        const double distance = glm::length(m_elements.centre(share.element) - centre);
        return distance - 0.5 * other < kNearSizes * size;
    });
}

std::vector<std::uint32_t> PointFactors::seenFromCentre(std::uint32_t sender) const {
    std::vector<std::uint32_t> seen(weights().size());
    look(sender, glm::vec3(m_elements.centre(m_elements.sender(sender))), frameOf(sender), seen);
    return seen;
}

void PointFactors::row(std::uint32_t sender, FactorRow& row) const {
    thread_local HitCount hits;
    thread_local std::vector<std::uint32_t> seen;
    const ElementMesh::Node& node = m_elements.sender(sender);
    const Face& face = m_elements.faces()[node.face];
    const glm::mat3 frame = frameOf(sender);
    const std::span<const double> weights = this->weights();
    seen.resize(weights.size());
    const auto add = [&](const glm::dvec3& from, double share) {
        look(sender, glm::vec3(from), frame, seen);
        // Neighbours mostly see the same element.
        for (std::size_t i = 0; i < seen.size();) {
            const std::uint32_t what = seen[i];
            double sum = 0.0;
            for (; i < seen.size() && seen[i] == what; ++i)
                sum += weights[i];
            if (!(sum > 0.0)) // no cells
                continue;
            if (what == kOutside)
                hits.addEscaped(share * sum);
            else if (what == kBack)
                hits.addAbsorbed(share * sum);
            else
                hits.add(what, share * sum);
        }
    };
    add(m_elements.centre(node), 1.0);
    hits.finish(row);
    const bool whole = m_elements.senderExposed(sender) >= 1.0f;
    if (m_settings.centreOnly || (whole && (m_settings.stands <= 1 || !isNear(sender, row))))
        return;
    for (int i = 0; i < m_stands.size(); ++i)
        for (int k = 0; k < m_stands.size(); ++k) {
            glm::dvec2 at(m_stands.node01(i), m_stands.node01(k));
            double weight = m_stands.weight01(i) * m_stands.weight01(k);
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
