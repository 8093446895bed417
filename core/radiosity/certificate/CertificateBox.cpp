#include "core/radiosity/certificate/CertificateBox.h"

#include "core/library/Library.h"
#include "core/math/Sampling.h"
#include "core/radiosity/HitCount.h"
#include "core/radiosity/PolygonFactor.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <utility>
#include <vector>

namespace patina::radiosity {
namespace {

constexpr double kClose = 0.12; // metres, from a point to the middle of an element

} // namespace

Result<TraceInputs> certificateInputs(const library::CornellWalls& walls, bool blocks) {
    const Result<std::vector<library::ModelPart>> parts = library::model("cornell-reference");
    if (!parts)
        return parts.error();
    TraceInputs inputs;
    inputs.model.fresnel = Fresnel::Dielectric;
    inputs.model.ior = 1.0f;
    for (const library::ModelPart& part : *parts) {
        if (!blocks && part.name.ends_with("Block"))
            continue;
        Material material = part.material;
        if (part.materialName == "White")
            material.baseColor = walls.white;
        else if (part.materialName == "Red")
            material.baseColor = walls.red;
        else if (part.materialName == "Green")
            material.baseColor = walls.green;
        inputs.materials.push_back(std::move(material));
        inputs.meshes.push_back({static_cast<Id>(inputs.meshes.size() + 1), part.mesh,
                                 glm::mat4(1.0f), inputs.materials.size() - 1});
    }
    return inputs;
}

Result<std::unique_ptr<DividedBox>> DividedBox::make(const TraceInputs& inputs, double edge,
                                                     std::span<const library::CornellPoint> points,
                                                     const JobContext& job) {
    Result<TraceScene> scene = TraceScene::build(inputs, job);
    if (!scene)
        return scene.error();
    ElementLimits limits;
    limits.maxEdge = edge;
    Result<ElementMesh> elements = ElementMesh::make(*scene->geometry(), limits);
    if (!elements)
        return elements.error();
    std::vector<std::uint32_t> close;
    for (std::uint32_t e = 0; e < elements->size(); ++e)
        if (std::ranges::any_of(points, [&](const library::CornellPoint& point) {
                const glm::dvec3 at(scene->toScene(library::cornellPosition(point.position)));
                return glm::length(elements->centre(e) - at) * elements->metresPerUnit() < kClose;
            }))
            close.push_back(e);
    elements->divide(close);
    auto box = std::make_unique<DividedBox>(DividedBox{std::move(*scene), std::move(*elements)});
    box->elements.findBuried(*box->scene.rays(), job);
    if (job.cancelled())
        return bakeCancelled();
    return box;
}

glm::dvec3 GatheringPoint::irradiance(const Solution& solution) const {
    glm::dvec3 sum(direct);
    for (const FactorRow::Share& share : row.shares)
        sum += double{share.factor} * solution.radiosity[share.element];
    return sum;
}

GatheringPoint gatherAt(const DividedBox& box, const library::CornellPoint& point,
                        std::uint32_t rays, std::uint32_t seed) {
    GatheringPoint result;
    const glm::vec3 normal(library::cornellDirection(point.normal));
    const glm::vec3 from =
        box.scene.toScene(library::cornellPosition(point.position)) + kRayOffset * normal;
    glm::vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    const glm::mat3 frame(tangent, bitangent, normal);
    HitCount hits;
    for (std::uint32_t i = 0; i < rays; ++i)
        hits.add(box.elements,
                 box.scene.closest(from, frame * cosineHemisphere(sobolOwen2D(i, seed))), 1.0);
    hits.finish(result.row);

    // The light in closed form, times the share of it that is seen (docs/maths/radiosity.md).
    for (const Face& face : box.elements.faces()) {
        const TracePoint middle =
            box.scene.pointAt(face.mesh, face.triangles[0], glm::vec2(1.0f / 3.0f));
        if (!middle.material->emits())
            continue;
        const double factor = pointToPolygon(glm::dvec3(from), glm::dvec3(normal),
                                             Polygon({face.corners.data(), face.cornerCount}));
        double total = 0.0, seen = 0.0;
        for (std::uint32_t i = 0; factor > 0.0 && i < std::max(rays / 4, 1u); ++i) {
            const glm::dvec3 to = positionOn(face, glm::dvec2(sobolOwen2D(i, seed + 1)));
            const glm::dvec3 way = to - glm::dvec3(from);
            const double length2 = glm::dot(way, way);
            const double weight = glm::dot(way, glm::dvec3(normal)) * -glm::dot(way, face.normal) /
                                  (length2 * length2);
            if (!(weight > 0.0))
                continue;
            const double length = std::sqrt(length2);
            total += weight;
            if (!box.scene.occluded(from, glm::vec3(way / length),
                                    static_cast<float>(length) - 2.0f * kRayOffset))
                seen += weight;
        }
        if (total > 0.0)
            result.direct += std::numbers::pi * factor * seen / total *
                             double{middle.material->emissionAt(middle.uv).x};
    }
    return result;
}

} // namespace patina::radiosity
