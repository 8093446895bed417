// What the BRDF lens draws: curves of one or several looks of a surface, evaluated together so that
// they share their scale.
#pragma once

#include "core/job/JobContext.h"
#include "core/light/BrdfLens.h"
#include "core/light/LobeMesh.h"

#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <vector>

namespace patina {

// DFG tables as models ask for them, each made once (some milliseconds). Not thread-safe.
class DfgTables {
  public:
    [[nodiscard]] ImagePtr of(const ShadingModel& model);

  private:
    std::map<std::pair<Distribution, Visibility>, ImagePtr> m_tables;
};

struct LensLook {
    ShadingModel model;
    SurfacePoint point;
    friend bool operator==(const LensLook&, const LensLook&) = default;
};

struct LensRequest {
    std::vector<LensLook> looks;
    float incidence = 0.785f; // of the light, radians from n, 0…pi/2
    LobeScale scale;
    friend bool operator==(const LensRequest&, const LensRequest&) = default;
};

// Of one look. Points are (angle in degrees, value), angles ascending; `scale` of the request says
// which part of f_r and which channel.
struct LensCurves {
    using Curve = std::vector<glm::vec2>;
    std::shared_ptr<const BrdfLens> lens;
    Curve lobe; // f_r over the viewer's angle -90…90°, the mirror direction at +incidence
    Curve distribution;         // D (1/sr) over the half vector's angle 0…90°
    Curve masking;              // G2 over the viewer's angle 0…90°, opposite the light
    Curve fresnel;              // F over the angle between viewer and half vector 0…90°
    Curve single, multi, exact; // albedo over the viewer's angle 0…90°: LensAlbedo
    LobeMesh mesh;
};

struct LensResult {
    LensRequest request;
    float peak = 0.0f; // the largest value of all lobes, 1 in their meshes; 0: nothing reflected
    std::vector<LensCurves> curves; // in the order of the looks; empty after a cancel
};

[[nodiscard]] LensResult evaluateLens(const LensRequest& request, DfgTables& tables,
                                      const JobContext& job);

} // namespace patina
