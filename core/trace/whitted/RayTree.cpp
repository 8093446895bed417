#include "core/trace/whitted/RayTree.h"

#include "core/trace/RayScene.h"

#include <array>

namespace patina {
namespace {

constexpr std::array<RayEndInfo, 12> kRayEnds{{
    {"continues", "Goes on"},
    {"missed", "Left the scene: background"},
    {"notReflecting", "Surface does not reflect"},
    {"emissive", "Surface gives off light and does not reflect"},
    {"back", "Back of a one-sided surface absorbs"},
    {"depth", "Not cast: the tree is deep enough"},
    {"contribution", "Not cast: would contribute too little"},
    {"below", "Not cast: would enter the triangle it leaves"},
    {"lit", "Reaches the light"},
    {"blocked", "Blocked: in shadow"},
    {"noShadow", "Not cast: the light casts no shadow"},
    {"facing", "Not cast: the light does not shine on this side"},
}};

constexpr std::array<RayEndInfo, 4> kRayKinds{{
    {"camera", "Camera"},
    {"shadow", "Shadow"},
    {"reflected", "Reflected"},
    {"refracted", "Refracted"},
}};

} // namespace

const RayEndInfo& rayEndInfo(RayEnd end) {
    return kRayEnds.at(static_cast<std::size_t>(end));
}

const RayEndInfo& rayKindInfo(RayKind kind) {
    return kRayKinds.at(static_cast<std::size_t>(kind));
}

bool wasCast(RayEnd end) {
    switch (end) {
    case RayEnd::Depth:
    case RayEnd::Contribution:
    case RayEnd::Below:
    case RayEnd::NoShadow:
    case RayEnd::Facing:
        return false;
    case RayEnd::Continues:
    case RayEnd::Missed:
    case RayEnd::NotReflecting:
    case RayEnd::Emissive:
    case RayEnd::Back:
    case RayEnd::Lit:
    case RayEnd::Blocked:
        break;
    }
    return true;
}

int RayTree::add(const RayNode& node) {
    if (node.kind == RayKind::Camera)
        ++m_samples;
    m_nodes.push_back(node);
    return static_cast<int>(m_nodes.size()) - 1;
}

glm::vec3 RayTree::radiance() const {
    const FlushDenormals flush; // as while the film was traced
    std::vector<glm::vec3> samples;
    std::vector<double> shares;
    glm::dvec3 sample(0.0);
    for (const RayNode& node : m_nodes) {
        if (node.kind == RayKind::Camera) {
            samples.emplace_back();
            shares.push_back(node.share);
            sample = glm::dvec3(0.0);
        }
        sample += glm::dvec3(node.contribution);
        samples.back() = glm::vec3(sample);
    }
    glm::dvec3 pixel(0.0);
    for (std::size_t i = 0; i < samples.size(); ++i)
        pixel += shares[i] * glm::dvec3(samples[i]);
    if (m_mean > 0)
        return glm::vec3(1.0 / m_mean * pixel);
    return glm::vec3(pixel);
}

std::vector<glm::vec3> RayTree::subtotals() const {
    std::vector<glm::dvec3> sums(m_nodes.size());
    double share = 1.0;
    for (std::size_t i = 0; i < m_nodes.size(); ++i) {
        if (m_nodes[i].kind == RayKind::Camera)
            share = m_mean > 0 ? m_nodes[i].share / m_mean : m_nodes[i].share;
        sums[i] = share * glm::dvec3(m_nodes[i].contribution);
    }
    for (std::size_t i = m_nodes.size(); i-- > 0;)
        if (m_nodes[i].parent >= 0)
            sums[static_cast<std::size_t>(m_nodes[i].parent)] += sums[i];
    return {sums.begin(), sums.end()};
}

} // namespace patina
