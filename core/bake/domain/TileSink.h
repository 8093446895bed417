// Where a bake that runs reports what it has.
#pragma once

#include "core/base/Id.h"

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

namespace patina {

class HitSource; // core/bake/bounce/HitCache.h

// From where the results are looked at: world space, OpenGL's clip space.
struct BakeView {
    glm::vec3 eye{0.0f};
    glm::mat4 worldToClip{1.0f};
};

// Receives results while a bake runs, from the pool's threads, so that a preview can show them.
class TileSink {
  public:
    virtual ~TileSink() = default;
    // `values`: stride floats for each vertex first, first+1, … of mesh `mesh`, final for the pass.
    virtual void vertices(Id /*mesh*/, std::size_t /*first*/, int /*stride*/,
                          std::span<const float> /*values*/) {}
    // A rectangle of a material's texture: `width` texels of `stride` floats per row, rows from the
    // top.
    virtual void texels(Id /*material*/, int /*imageSize*/, int /*stride*/, int /*x*/, int /*y*/,
                        int /*width*/, std::span<const float> /*values*/) {}
    // A whole pass over all elements is complete with `samples` rays per element.
    virtual void passDone(int /*samples*/) {}
    // An interreflected bake: where its rays ended, for bounces to be followed again with other
    // albedo (core/bake/bounce/BounceSolver.h). Only when `hitBudget` allows to keep them.
    virtual void hits(const std::shared_ptr<const HitSource>& /*hits*/) {}
    // Asked before each pass: what is seen comes first. Changes the order of work alone.
    virtual std::optional<BakeView> view() { return std::nullopt; }
};

} // namespace patina
