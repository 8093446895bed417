#include "core/radiosity/document/ElementLinks.h"

#include <algorithm>

namespace patina {

using namespace radiosity;

namespace {

// Of an element under a source alone, as it is scaled now: what it sends, W/m².
glm::dvec3 sentOf(const LiveRadiosity& live, const RadiositySource& source, std::uint32_t e) {
    const glm::dvec3 reflectance = live.lit.problem.reflectance[e];
    const bool shot = source.kind == RadiositySource::Kind::Glow && live.settings.classic;
    return source.power * ((shot ? live.lit.glow[e] : reflectance * source.direct[e]) +
                           reflectance * source.bounced[e]);
}

bool hasLinks(const RadiositySource& source) {
    return source.links && source.links->tree && !source.bounced.empty();
}

// visit(node of the cluster that has the link, node at the other end, kernel in 1/m²).
template <class Visit>
void forEachLink(const HierarchyLinks& links, std::uint32_t element, const Visit& visit) {
    const std::vector<ClusterTree::Node>& nodes = links.tree->nodes();
    const std::vector<std::uint32_t>& leaves = links.tree->leaves();
    const auto leaf =
        static_cast<std::uint32_t>(std::ranges::find(leaves, element) - leaves.begin());
    // The clusters that it is in, from the root down.
    std::vector<bool> holds(nodes.size(), false);
    for (std::uint32_t at = ClusterTree::kRoot;;) {
        holds[at] = true;
        const ClusterTree::Node& node = nodes[at];
        if (node.isElement())
            break;
        for (std::uint32_t child = node.firstChild; child < node.firstChild + node.childCount;
             ++child)
            if (leaf >= nodes[child].firstLeaf &&
                leaf < nodes[child].firstLeaf + nodes[child].leafCount)
                at = child;
    }
    for (const Link& link : links.links)
        if (holds[link.a])
            visit(nodes[link.a], nodes[link.b], double{link.kernel});
        else if (holds[link.b])
            visit(nodes[link.b], nodes[link.a], double{link.kernel});
}

// The source whose links are shown; null: none.
const RadiositySource* sourceOfMost(const LiveRadiosity& live, std::uint32_t element) {
    const RadiositySource* best = nullptr;
    double most = -1.0;
    for (const RadiositySource& source : live.sources)
        if (hasLinks(source))
            if (const double light = magnitude(source.power * source.bounced[element]);
                light > most) {
                most = light;
                best = &source;
            }
    return best;
}

} // namespace

ElementLinks linksOf(const LiveRadiosity& live, std::uint32_t element) {
    ElementLinks result;
    const RadiositySource* source = sourceOfMost(live, element);
    if (source == nullptr)
        return result;
    result.source = static_cast<std::size_t>(source - live.sources.data());
    const ClusterTree& tree = *source->links->tree;
    double sum = 0.0;
    forEachLink(*source->links, element,
                [&](const ClusterTree::Node& own, const ClusterTree::Node& other, double kernel) {
                    ElementLink& link = result.links.emplace_back();
                    if (other.isElement())
                        link.element = tree.leaves()[other.firstLeaf];
                    link.elements = other.leafCount;
                    link.receivers = own.leafCount;
                    link.factor = kernel * tree.area(other);
                    for (std::uint32_t l = 0; l < other.leafCount; ++l) {
                        const std::uint32_t e = tree.leaves()[other.firstLeaf + l];
                        link.light += kernel * live.lit.problem.areas[e] * sentOf(live, *source, e);
                    }
                    link.centre = live.scene->toWorld(other.centre);
                    link.radius = live.scene->metres(other.radius);
                    result.factorSum += link.factor;
                    sum += magnitude(link.light);
                });
    for (ElementLink& link : result.links)
        link.share = sum > 0.0 ? magnitude(link.light) / sum : 0.0;
    std::ranges::stable_sort(result.links, std::ranges::greater{}, &ElementLink::share);
    return result;
}

std::vector<glm::dvec3> lightOverLinks(const LiveRadiosity& live, std::uint32_t element) {
    std::vector<glm::dvec3> light;
    for (const RadiositySource& source : live.sources) {
        if (!hasLinks(source))
            continue;
        light.resize(live.elements().size(), glm::dvec3(0.0));
        const ClusterTree& tree = *source.links->tree;
        forEachLink(*source.links, element,
                    [&](const ClusterTree::Node&, const ClusterTree::Node& other, double kernel) {
                        for (std::uint32_t l = 0; l < other.leafCount; ++l) {
                            const std::uint32_t e = tree.leaves()[other.firstLeaf + l];
                            light[e] +=
                                kernel * live.lit.problem.areas[e] * sentOf(live, source, e);
                        }
                    });
    }
    return light;
}

std::vector<double> factorsOverLinks(const LiveRadiosity& live, std::uint32_t element) {
    std::vector<double> factors;
    const RadiositySource* source = sourceOfMost(live, element);
    if (source == nullptr)
        return factors;
    factors.resize(live.elements().size(), 0.0);
    const ClusterTree& tree = *source->links->tree;
    forEachLink(*source->links, element,
                [&](const ClusterTree::Node&, const ClusterTree::Node& other, double kernel) {
                    for (std::uint32_t l = 0; l < other.leafCount; ++l) {
                        const std::uint32_t e = tree.leaves()[other.firstLeaf + l];
                        factors[e] += kernel * live.lit.problem.areas[e];
                    }
                });
    return factors;
}

} // namespace patina
