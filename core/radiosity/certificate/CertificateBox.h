// The Cornell box of a certificate as rays see it, and divided.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/library/CornellPoints.h"
#include "core/radiosity/SceneProblem.h"
#include "core/radiosity/certificate/Certificate.h"
#include "core/trace/path/TraceInputs.h"

#include <cstdint>
#include <memory>
#include <span>

namespace patina::radiosity {

// builtin:cornell-reference, Lambertian: its refractive index is 1, so that nothing is glossy.
[[nodiscard]] Result<TraceInputs> certificateInputs(const library::CornellWalls& walls,
                                                    bool blocks);

// A box and its elements; stays where it is.
struct DividedBox {
    TraceScene scene;
    ElementMesh elements;

    // Elements close to one of the points have half that edge: it receives most of its light from
    // them. Errors: those of TraceScene::build() and ElementMesh::make(); Cancelled.
    static Result<std::unique_ptr<DividedBox>> make(const TraceInputs& inputs, double edge,
                                                    std::span<const library::CornellPoint> points,
                                                    const JobContext& job);
};

// What a point receives: straight from the light, W/m², and from which elements everything else.
// Points lie anywhere within elements and close to other surfaces: light interpolated between
// elements would depend on the division more than on the solution.
struct GatheringPoint {
    double direct = 0.0; // of each colour
    FactorRow row;
    [[nodiscard]] glm::dvec3 irradiance(const Solution& solution) const;
};
// `rays`: to elements, and a quarter of them to the light.
[[nodiscard]] GatheringPoint gatherAt(const DividedBox& box, const library::CornellPoint& point,
                                      std::uint32_t rays, std::uint32_t seed);

} // namespace patina::radiosity
