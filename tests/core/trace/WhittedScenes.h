// Scenes and views of the tests of the classical ray tracer.
#pragma once

#include "core/trace/whitted/WhittedTracer.h"

#include <vector>

namespace patina::test {

[[nodiscard]] TraceScene whittedScene(const TraceInputs& inputs);
[[nodiscard]] TraceView viewFrom(float distance, int size = 16);
[[nodiscard]] TraceView fromAbove();
[[nodiscard]] Film whitted(const TraceScene& scene, const TraceView& view,
                           const WhittedSettings& settings = {}, std::uint32_t samples = 1);

[[nodiscard]] MeshPtr floorMesh(); // a square of 4 m in y = 0, seen from above
[[nodiscard]] MeshPtr cubeMesh();  // from -1 to 1
[[nodiscard]] Material mirror(float reflectance);
[[nodiscard]] Material glass(float ior = 1.5f);

// That floor without gloss, and a point above it.
[[nodiscard]] TraceInputs floorUnderPoint(float roughness = 0.5f);
// Rays that meet mirrors, rough things, things that glow, lights of every kind and the sky.
[[nodiscard]] TraceInputs variedScene();
[[nodiscard]] TraceView ofVariedScene();

[[nodiscard]] std::vector<RayNode> ofKind(const RayTree& tree, RayKind kind);

} // namespace patina::test
