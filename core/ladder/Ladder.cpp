#include "core/ladder/Ladder.h"

#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/TileSink.h"
#include "core/document/Lighting.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/light/Ibl.h"
#include "core/material/Material.h"
#include "core/trace/document/DocumentLightMap.h"

#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <tuple>
#include <utility>

namespace patina {
namespace {

constexpr double kOcclusionShare = 0.2;            // of the time that it and transfer take
constexpr double kLightMapShare = 0.6;             // of that of all
constexpr std::size_t kMostForRadiosity = 100'000; // triangles, which are elements at least

BakeArtifactPtr attached(const Document& document, std::initializer_list<BakeKind> kinds) {
    for (const BakeKind kind : kinds)
        if (BakeArtifactPtr bake = findBake(document, kind))
            return bake;
    return nullptr;
}

Result<BakeArtifactPtr> timed(const std::function<Result<BakeArtifact>()>& bakeIt,
                              double& seconds) {
    const auto start = std::chrono::steady_clock::now();
    Result<BakeArtifact> made = bakeIt();
    if (!made)
        return made.error();
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::make_shared<const BakeArtifact>(*std::move(made));
}

// Without what hides light from places.
void removeOcclusion(Document& document) {
    removeBake(document, BakeKind::AoTexel);
    removeBake(document, BakeKind::AoVertex);
    for (Material& material : document.materials)
        material.occlusionStrength = 0.0f;
}

} // namespace

LadderBakes attachedLadderBakes(const Document& document) {
    return {attached(document, {BakeKind::AoTexel, BakeKind::AoVertex}),
            attached(document, {BakeKind::PrtVertex, BakeKind::PrtTexel}),
            attached(document, {BakeKind::LightMap})};
}

Result<LadderBakes> ladderBakes(const Document& document, const LadderSettings& settings,
                                const std::function<Result<IblMaps>(const Image&)>& prepare,
                                const JobContext& job) {
    TileSink nobody;
    LadderBakes bakes = attachedLadderBakes(document);
    const BakeInputs inputs = bakeInputs(document);
    // Of the progress; the transfer's bounces take longest.
    const double last = bakes.lightMap ? 1.0 : 1.0 - kLightMapShare;
    const double half = last * (bakes.transfer ? 1.0 : bakes.occlusion ? 0.0 : kOcclusionShare);
    if (!bakes.occlusion) {
        job.setActivity("baking ambient occlusion");
        BakeRequest request;
        request.kind = BakeKind::AoVertex;
        request.ao.samples = settings.rays;
        Result<BakeArtifactPtr> made =
            timed([&] { return bake(request, inputs, nobody, job.part(0.0, half)); },
                  bakes.occlusionSeconds);
        if (!made)
            return made.error();
        bakes.occlusion = *made;
    }
    if (!bakes.transfer) {
        job.setActivity("baking transfer");
        BakeRequest request;
        request.kind = BakeKind::PrtVertex;
        request.prt.order = settings.order;
        request.prt.samples = request.prt.bounceSamples = settings.rays;
        request.prt.bounces = settings.bounces;
        request.prt.transfer = TransferKind::Interreflected;
        Result<BakeArtifactPtr> made =
            timed([&] { return bake(request, inputs, nobody, job.part(half, last)); },
                  bakes.transferSeconds);
        if (!made)
            return made.error();
        bakes.transfer = *made;
    }
    if (!bakes.lightMap) {
        job.setActivity("baking a light map");
        const Result<LightMapInputs> light = lightMapInputs(document, prepare);
        if (!light)
            return light.error();
        LightMapSettings lightMap;
        lightMap.size = settings.lightMapSize;
        lightMap.samples = settings.lightMapPaths;
        Result<BakeArtifactPtr> made =
            timed([&] { return bakeLightMap(*light, lightMap, job.part(last, 1.0)); },
                  bakes.lightMapSeconds);
        if (made)
            bakes.lightMap = *made;
        else if (made.error().kind != ErrorKind::InputBroken) // without texture coordinates
            return made.error();
    }
    return bakes;
}

std::vector<LadderRung> ladderRungs(const Document& document, const LadderBakes& bakes) {
    const ParameterInfo& lighting = *findParameter("view.lighting");
    std::vector<LadderRung> rungs;
    const auto add = [&](const char* name, const char* label, LightingMode mode) -> LadderRung& {
        LadderRung& rung = rungs.emplace_back();
        rung.name = name;
        rung.label = label;
        rung.document = document;
        rung.document.view.lighting = mode;
        return rung;
    };
    add("cosine", "N·L", LightingMode::Cosine);
    add("sh", "SH irradiance", LightingMode::ShIrradiance);
    removeOcclusion(add("ibl", "Image-based light", LightingMode::Ibl).document);
    LadderRung& occluded = add("ao", "+ ambient occlusion", LightingMode::Ibl);
    if (bakes.occlusion)
        attachBake(occluded.document, bakes.occlusion);
    else
        occluded.whyNot = "Needs baked ambient occlusion.";
    occluded.bakeSeconds = bakes.occlusionSeconds;
    for (const auto& [name, label, mode] :
         {std::tuple{"unshadowed", "Transfer, unshadowed", LightingMode::Unshadowed},
          std::tuple{"shadowed", "Transfer, shadowed", LightingMode::Shadowed},
          std::tuple{"prt", "Transfer, with bounces", LightingMode::Prt}}) {
        LadderRung& rung = add(name, label, mode);
        if (readsBake(mode)) { // an open sky needs none
            if (bakes.transfer)
                attachBake(rung.document, bakes.transfer);
            rung.bakeSeconds = bakes.transferSeconds;
        }
        rung.whyNot = whyUnavailable(lighting, rung.document, static_cast<int>(mode));
    }
    LadderRung& solved = add("radiosity", "Radiosity", LightingMode::Radiosity);
    solved.whyNot =
        document.triangleCount() > kMostForRadiosity
            ? "The scene has too many triangles to be divided further."
            : whyUnavailable(lighting, document, static_cast<int>(LightingMode::Radiosity));
    LadderRung& mapped = add("lightMap", "Light map", LightingMode::LightMap);
    if (bakes.lightMap)
        attachBake(mapped.document, bakes.lightMap);
    mapped.bakeSeconds = bakes.lightMapSeconds;
    mapped.whyNot =
        whyUnavailable(lighting, mapped.document, static_cast<int>(LightingMode::LightMap));
    return rungs;
}

} // namespace patina
