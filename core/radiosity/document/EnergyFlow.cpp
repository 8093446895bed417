#include "core/radiosity/document/EnergyFlow.h"

#include "core/radiosity/document/ElementLinks.h"

#include <algorithm>
#include <map>

namespace patina {

using namespace radiosity;

namespace {

FlowShare::Kind kindOf(RadiositySource::Kind kind) {
    switch (kind) {
    case RadiositySource::Kind::Glow:
        return FlowShare::Kind::Glow;
    case RadiositySource::Kind::Sky:
        return FlowShare::Kind::Sky;
    case RadiositySource::Kind::Light:
        return FlowShare::Kind::Light;
    case RadiositySource::Kind::Lights:
        break;
    }
    return FlowShare::Kind::Lights;
}

std::optional<glm::vec3> placeOf(const LiveRadiosity& live, const RadiositySource& source) {
    if (source.kind == RadiositySource::Kind::Glow) {
        glm::dvec3 weighted(0.0);
        double weight = 0.0;
        for (std::uint32_t e = 0; e < live.elements().size(); ++e)
            if (const double power = live.elements().area(e) * magnitude(live.lit.glow[e]);
                power > 0.0) {
                weighted += power * glm::dvec3(elementCentre(live, e));
                weight += power;
            }
        return weight > 0.0 ? std::optional(glm::vec3(weighted / weight)) : std::nullopt;
    }
    if (source.kind != RadiositySource::Kind::Light ||
        source.lights.front().type == LightType::Directional)
        return std::nullopt;
    return source.lights.front().position;
}

std::vector<FlowShare> straightFromSources(const LiveRadiosity& live, std::uint32_t element) {
    std::vector<FlowShare> shares;
    for (const RadiositySource& source : live.sources)
        shares.push_back({.kind = kindOf(source.kind),
                          .id = source.id,
                          .light = source.power * source.direct[element],
                          .place = placeOf(live, source)});
    return shares;
}

// By mesh: what an element exchanges with those of it.
struct MeshFlow {
    glm::dvec3 light{0.0}, weighted{0.0};
    double weight = 0.0;

    void add(const glm::dvec3& amount, const glm::vec3& centre) {
        light += amount;
        weighted += magnitude(amount) * glm::dvec3(centre);
        weight += magnitude(amount);
    }
};

void addMeshes(const std::map<Id, MeshFlow>& flows, std::vector<FlowShare>& shares) {
    for (const auto& [id, flow] : flows)
        if (flow.weight > 0.0)
            shares.push_back({.kind = FlowShare::Kind::Mesh,
                              .id = id,
                              .light = flow.light,
                              .place = glm::vec3(flow.weighted / flow.weight)});
}

std::vector<FlowShare> inOrder(std::vector<FlowShare> shares) {
    double sum = 0.0;
    for (const FlowShare& share : shares)
        sum += magnitude(share.light);
    std::erase_if(shares, [](const FlowShare& share) { return !(magnitude(share.light) > 0.0); });
    for (FlowShare& share : shares)
        share.share = magnitude(share.light) / sum;
    std::ranges::stable_sort(shares, std::ranges::greater{}, &FlowShare::share);
    return shares;
}

std::vector<glm::vec3> outlineOf(const LiveRadiosity& live, const ElementMesh::Node& node) {
    std::vector<glm::vec3> outline;
    const Polygon polygon = live.elements().polygon(node);
    for (const glm::dvec3& corner : polygon.points())
        outline.push_back(live.scene->toWorld(glm::vec3(corner)));
    return outline;
}

Id meshOf(const LiveRadiosity& live, std::uint32_t element) {
    return live.scene->meshId(live.elements().face(element).mesh);
}

// visit(element that sends, W/m²): of each that lights `element`, by its row of form factors; over
// links; or by the rows of the patches, of which its elements send as much each as they have.
template <class Visit>
void forEachSender(const LiveRadiosity& live, const Solution& solution, std::uint32_t element,
                   const Visit& visit) {
    const std::vector<glm::dvec3> linked = lightOverLinks(live, element);
    for (std::uint32_t from = 0; from < linked.size(); ++from)
        if (magnitude(linked[from]) > 0.0)
            visit(from, linked[from]);
    if (!live.factors)
        return;
    const FactorMatrix& matrix = live.factors->matrix;
    const Problem& problem = live.lit.problem;
    if (problem.patches.empty()) {
        for (const FactorRow::Share& share : matrix.row(element))
            visit(share.element, double{share.factor} * solution.radiosity[share.element]);
        return;
    }
    for (std::uint32_t patch = 0; patch < matrix.size(); ++patch) {
        const auto row = matrix.row(patch);
        const auto share = std::ranges::lower_bound(row, element, {}, &FactorRow::Share::element);
        if (share == row.end() || share->element != element)
            continue;
        const double perArea = double{share->factor} / problem.areas[element];
        for (const std::uint32_t from : problem.patches.elementsOf(patch))
            visit(from, perArea * problem.areas[from] * solution.radiosity[from]);
    }
}

} // namespace

std::vector<FlowShare> arrivingLight(const LiveRadiosity& live, const Solution& solution,
                                     std::uint32_t element) {
    std::vector<FlowShare> shares = straightFromSources(live, element);
    std::map<Id, MeshFlow> meshes;
    forEachSender(live, solution, element, [&](std::uint32_t from, const glm::dvec3& light) {
        meshes[meshOf(live, from)].add(light, elementCentre(live, from));
    });
    addMeshes(meshes, shares);
    return inOrder(std::move(shares));
}

std::vector<FlowShare> largestSenders(const LiveRadiosity& live, const Solution& solution,
                                      std::uint32_t element, std::size_t count) {
    std::vector<FlowShare> shares = straightFromSources(live, element);
    forEachSender(live, solution, element, [&](std::uint32_t from, const glm::dvec3& light) {
        shares.push_back({.kind = FlowShare::Kind::Element,
                          .id = meshOf(live, from),
                          .element = from,
                          .light = light,
                          .place = elementCentre(live, from)});
    });
    shares = inOrder(std::move(shares));
    if (shares.size() > count)
        shares.erase(shares.begin() + static_cast<std::ptrdiff_t>(count), shares.end());
    return shares;
}

std::vector<FlowShare> leavingLight(const LiveRadiosity& live, const Solution& solution,
                                    std::uint32_t element) {
    std::vector<FlowShare> shares;
    if (!live.factors)
        return shares;
    const glm::dvec3 sent = live.lit.radiosity(solution, element);
    std::map<Id, MeshFlow> meshes;
    const std::uint32_t sender = live.elements().senderOf(element);
    for (const FactorRow::Share& share : live.factors->matrix.row(sender))
        meshes[meshOf(live, share.element)].add(double{share.factor} * sent,
                                                elementCentre(live, share.element));
    addMeshes(meshes, shares);
    shares.push_back({.kind = FlowShare::Kind::Escaped,
                      .light = double{live.factors->matrix.escaped(sender)} * sent,
                      .place = {}});
    shares.push_back({.kind = FlowShare::Kind::Absorbed,
                      .light = double{live.factors->matrix.absorbed(sender)} * sent,
                      .place = {}});
    return inOrder(std::move(shares));
}

glm::vec3 elementCentre(const LiveRadiosity& live, std::uint32_t element) {
    return live.scene->toWorld(glm::vec3(live.elements().centre(element)));
}

std::vector<glm::vec3> elementOutline(const LiveRadiosity& live, std::uint32_t element) {
    return outlineOf(live, live.elements().node(element));
}

std::vector<glm::vec3> senderOutline(const LiveRadiosity& live, std::uint32_t sender) {
    return outlineOf(live, live.elements().sender(sender));
}

std::optional<std::uint32_t> elementAlong(const LiveRadiosity& live, const glm::vec3& origin,
                                          const glm::vec3& direction) {
    constexpr int kMostBacks = 64;
    glm::vec3 from = live.scene->toScene(glm::dvec3(origin));
    for (int i = 0; i < kMostBacks; ++i) {
        const ClosestRay ray = live.scene->closest(from, direction);
        if (ray.mesh == ClosestRay::kNothing)
            break;
        if (const std::uint32_t element = live.elements().met(ray); element != kNone)
            return element;
        from += (ray.ray.maxDistance + kRayOffset) * direction;
    }
    return std::nullopt;
}

} // namespace patina
