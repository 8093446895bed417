// The estimators of a scene's light in real time, from the coarsest on, each as a document that is
// drawn with it: what is compared with the traced picture of the same scene.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"

#include <string>
#include <vector>

namespace patina {

struct LadderSettings {
    int order = 5;   // bands of the transfer, 1…8
    int rays = 256;  // of each vertex, of both bakes
    int bounces = 3; // of the transfer
};

// What some of the estimators need; those that the document has are taken, the others baked.
struct LadderBakes {
    BakeArtifactPtr occlusion; // in place of occlusion maps, which know of a surface's detail alone
    BakeArtifactPtr transfer;  // with bounces, unless the document has one without
    double occlusionSeconds = 0.0, transferSeconds = 0.0; // that they took; 0: nothing was baked
};
// Errors: those of bake(); Cancelled.
Result<LadderBakes> ladderBakes(const Document& document, const LadderSettings& settings,
                                const JobContext& job);

struct LadderRung {
    std::string name;  // in files: "cosine"
    std::string label; // "N·L"
    Document document;
    std::string whyNot;       // it cannot be drawn; empty: it can
    double bakeSeconds = 0.0; // that its bake took
};

// In this order: N·L of the dominant light, irradiance of nine coefficients, image-based light
// without and with ambient occlusion, transfer of the open sky, with shadows, with bounces.
[[nodiscard]] std::vector<LadderRung> ladderRungs(const Document& document,
                                                  const LadderBakes& bakes);

} // namespace patina
