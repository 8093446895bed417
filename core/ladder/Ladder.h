// The estimators of a scene's light in real time, from the coarsest on, each as a document that is
// drawn with it: what is compared with the traced picture of the same scene.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"

#include <functional>
#include <string>
#include <vector>

namespace patina {

struct IblMaps;
class Image;

struct LadderSettings {
    int order = 5;                              // bands of the transfer, 1…8
    int rays = 256;                             // of each vertex, of both bakes
    int bounces = 3;                            // of the transfer
    int lightMapSize = 256, lightMapPaths = 16; // texels of a side, paths of each
};

// What some of the estimators need; those that the document has are taken, the others baked.
struct LadderBakes {
    BakeArtifactPtr occlusion; // in place of occlusion maps, which know of a surface's detail alone
    BakeArtifactPtr transfer;  // with bounces, unless the document has one without
    BakeArtifactPtr lightMap;
    // That they took; 0: nothing was baked.
    double occlusionSeconds = 0.0, transferSeconds = 0.0, lightMapSeconds = 0.0;
};
// Those that the document has. Nothing is baked.
[[nodiscard]] LadderBakes attachedLadderBakes(const Document& document);
// `prepare` makes the maps of an environment. Errors: those of bake() and bakeLightMap(), those of
// `prepare`; Cancelled. A scene that no light map can be baked of has none.
Result<LadderBakes> ladderBakes(const Document& document, const LadderSettings& settings,
                                const std::function<Result<IblMaps>(const Image&)>& prepare,
                                const JobContext& job);

struct LadderRung {
    std::string name;  // in files: "cosine"
    std::string label; // "N·L"
    Document document;
    std::string whyNot;       // it cannot be drawn; empty: it can
    double bakeSeconds = 0.0; // that its bake took
};

// Those that need a bake which is not there cannot be drawn. In this order: N·L of the dominant
// light, irradiance of nine coefficients, image-based light without and with ambient occlusion,
// transfer of the open sky, with shadows, with bounces, image-based light with a light map.
[[nodiscard]] std::vector<LadderRung> ladderRungs(const Document& document,
                                                  const LadderBakes& bakes);

} // namespace patina
