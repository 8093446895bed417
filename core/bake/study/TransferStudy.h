// How light reaches one point of a surface by the attached transfer bake, band by band. The
// Transfer dock shows it, `patina render --inspect` states its numbers.
#pragma once

#include "core/bake/document/TransferPoint.h"
#include "core/bake/local/NearShadows.h"
#include "core/bake/study/TransferFunction.h"
#include "core/light/EnvironmentLookup.h"
#include "core/light/Light.h"
#include "core/mix/LightMix.h"

#include <glm/vec3.hpp>
#include <map>
#include <vector>

namespace patina {

// All that a study depends on; equal requests have equal studies.
struct TransferRequest {
    BakeArtifactPtr bake;               // null: there is none
    EnvironmentPart environment;        // the mix as one picture; null image: there is none
    std::vector<EnvironmentPart> parts; // of the mix
    std::vector<Light> lights;          // that are on
    NearShadowsPtr shadows;             // of local ones, as they are shown; null: none
    Id mesh = 0;
    glm::vec3 position{0.0f}; // world
    bool traced = false;      // rays find what the point sees
    unsigned bands = ~0u;     // of the transfer that are on, a bit each
    friend bool operator==(const TransferRequest&, const TransferRequest&) = default;
};

// Bake (transfer per vertex before per texel), environment and lights of a document; shadows, mesh
// and position are the caller's.
[[nodiscard]] TransferRequest transferRequest(const Document& document);

// Radiance is exit radiance of albedo 1, in the document's unit.
struct TransferStudy {
    PointTransfer transfer;
    EnvironmentLookup environment; // of the request, without maps
    std::vector<glm::vec3> light;  // coefficients of the light that meets the point: environment
                                   // and lights, as many as the transfer has; without local lights
                                   // whose shadows are traced
    std::vector<glm::vec3> byBand; // radiance that each band adds; below zero where that is
    glm::vec3 radiance{0.0f};      // of the bands that are on
    glm::vec3 local{0.0f};         // besides, directly from local lights whose shadows are traced
    std::size_t tracedLights = 0;  // how many these are
    float visibility = 1.0f;   // share of the light of a uniform environment that arrives, 0…1
    TransferFunction function; // of the bands that are on
    std::vector<bool> visible; // directions that nothing hides, as visibleDirections(); empty
                               // where they were not traced, or could not be
    int visibleHeight = 0;     // of these

    [[nodiscard]] glm::vec3 all() const { return radiance + local; }
};

// What was computed for an earlier study and may serve again; one thread at a time.
struct TransferMemory {
    ImagePtr environment;
    EnvironmentAnalysisPtr analysis;
    std::map<ImagePtr, std::vector<glm::vec3>> projections; // of the parts of the mix
};

// `request` has a bake and an environment. Errors: InputBroken when the bake has no values for the
// mesh as it is now; Cancelled.
Result<TransferStudy> studyTransfer(const Document& document, const TransferRequest& request,
                                    TransferMemory& memory, const JobContext& job);

} // namespace patina
