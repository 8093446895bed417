#include "core/bake/study/TransferStudy.h"

#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/local/NearLightAt.h"
#include "core/bake/transfer/TransferMeaning.h"
#include "core/base/Check.h"
#include "core/document/Document.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/mix/TransferLight.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace patina {
namespace {

constexpr int kFunctionHeight = 192;
constexpr int kRayHeight = 64; // 8192 rays

Error cancelled() {
    return {ErrorKind::Cancelled, "the study of a point was cancelled", {}, {}};
}

// Coefficients of the parts' pictures, of which those of the last study are kept.
void project(const std::vector<EnvironmentPart>& parts, TransferMemory& memory,
             const JobContext& job) {
    std::map<ImagePtr, std::vector<glm::vec3>> projections;
    for (const EnvironmentPart& part : parts) {
        const auto known = memory.projections.find(part.image);
        projections[part.image] =
            part.image == memory.environment    ? memory.analysis->bands.coefficients
            : known != memory.projections.end() ? known->second
                                                : projectLatLong(*part.image, kMaxShOrder, job);
    }
    if (!job.cancelled())
        memory.projections = std::move(projections);
}

} // namespace

TransferRequest transferRequest(const Document& document) {
    TransferRequest request;
    request.bake = findBake(document, BakeKind::PrtVertex);
    if (!request.bake)
        request.bake = findBake(document, BakeKind::PrtTexel);
    request.environment = shownEnvironment(document);
    request.parts = environmentParts(document);
    for (const Light* light : activeLights(document))
        request.lights.push_back(*light);
    return request;
}

Result<TransferStudy> studyTransfer(const Document& document, const TransferRequest& request,
                                    TransferMemory& memory, const JobContext& job) {
    CHECK(request.bake != nullptr);
    CHECK(request.environment.image != nullptr);
    const std::optional<MeshPoint> point =
        nearestMeshPoint(document, request.mesh, request.position);
    std::optional<PointTransfer> transfer =
        point ? pointTransfer(document, *request.bake, *point) : std::nullopt;
    if (!transfer)
        return Error{
            ErrorKind::InputBroken, "the bake has no values for this mesh; bake it again", {}, {}};
    TransferStudy study;
    study.transfer = *std::move(transfer);
    const EnvironmentPart& mix = request.environment;
    if (memory.environment != mix.image) {
        memory.analysis = analyseEnvironment(mix.image, job);
        memory.environment = memory.analysis ? mix.image : nullptr;
    }
    if (!memory.analysis)
        return cancelled();
    study.environment.analysis = memory.analysis;
    study.environment.orientation = mix.orientation;
    study.environment.setScale(mix.scale);

    // Environment and lights as coefficients, and what each band of them adds.
    project(request.parts, memory, job);
    if (job.cancelled())
        return cancelled();
    const int order = study.transfer.order;
    study.light = transferLight(document, order,
                                [&](const EnvironmentPart& part) -> std::span<const glm::vec3> {
                                    const auto known = memory.projections.find(part.image);
                                    if (known == memory.projections.end())
                                        return {};
                                    return known->second;
                                });
    // Of local lights whose shadows are traced, transfer adds what bounces alone.
    const NearLightAt traced = nearLightAt(document, request.shadows, *point);
    std::vector<glm::vec3> bouncing(study.light.size(), glm::vec3(0.0f));
    for (const Light& light : request.lights)
        if (light.type != LightType::Directional)
            addNearLight(light, request.position, order,
                         std::ranges::count(traced.lights, light.id) > 0 ? bouncing : study.light);
    const auto radiance = [&](unsigned bands) {
        return study.transfer.radiance(study.light, bands) +
               study.transfer.bouncedRadiance(bouncing, bands);
    };
    for (int l = 0; l < order; ++l)
        study.byBand.push_back(radiance(1u << static_cast<unsigned>(l)));
    study.radiance = radiance(request.bands);
    study.local = traced.radiance;
    study.tracedLights = traced.lights.size();
    study.visibility = std::clamp(ambientVisibility(study.transfer.direct), 0.0f, 1.0f);
    study.function = transferFunction(study.transfer, request.bands, kFunctionHeight);

    if (request.traced && !job.cancelled()) {
        Result<std::vector<bool>> visible =
            visibleDirections(bakeInputs(document), *point, kRayHeight, job);
        if (visible) {
            study.visible = *std::move(visible);
            study.visibleHeight = kRayHeight;
        }
    }
    if (job.cancelled())
        return cancelled();
    return study;
}

} // namespace patina
