// The triangles of a bake and the hierarchy over them, for who casts a few rays into a scene.
#pragma once

#include "core/trace/RayScene.h"

#include <memory>

namespace patina {

struct BakeScene {
    // Errors: those of makeBakeGeometry() and RayScene::build().
    static Result<BakeScene> build(const BakeInputs& inputs, const JobContext& job);

    std::unique_ptr<const BakeGeometry> geometry; // stays where it is, however the scene moves:
    RayScene rays;                                // uses it in place
    bool passesByChance = false;                  // some surface is blended
};

} // namespace patina
