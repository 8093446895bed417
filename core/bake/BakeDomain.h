// Where the values of a bake stand: at vertices, at texels. One pipeline (Bake.cpp) bakes any of
// them: it builds the scene, traces a domain's points, and asks the domain to make values of what
// they saw.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakePoints.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/bake/domain/TileSink.h"
#include "core/bake/transfer/Passes.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/BakeInputs.h"
#include "core/trace/RayScene.h"

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace patina {

class BakeDomain {
  public:
    virtual ~BakeDomain() = default;

    // Where rays start. Ranges are computed and reported together.
    [[nodiscard]] virtual std::span<const BakePoint> points() const = 0;
    [[nodiscard]] virtual std::span<const PointRange> ranges() const = 0;

    // What the points of a range have seen so far, `stride` floats each: whatever of it can be
    // shown goes to the sink. From any thread.
    virtual void report(const PointRange& range, int stride, std::span<const float> values,
                        TileSink& sink) const = 0;
    // What the user should know of the geometry; empty: nothing. `scene`: null where no ray was
    // traced.
    [[nodiscard]] virtual std::string note(const RayScene* scene, const PassSettings& settings,
                                           const PassState& state, const JobContext& job) const = 0;
    // The artifact's values, of its kind. Takes out of `state` what addBounces() has no use for.
    // Errors: Cancelled.
    virtual Result<void> finish(BakeArtifact& artifact, const PassSettings& settings,
                                PassState& state, const JobContext& job) const = 0;
    // Adds what arrives by way of other surfaces to finished transfer. Errors: Usage, Cancelled.
    virtual std::optional<Error> addBounces(BakeArtifact& artifact, const RayScene& scene,
                                            const PassState& state, const PrtSettings& settings,
                                            TileSink& sink, const JobContext& job) const = 0;
};

using BakeDomainPtr = std::unique_ptr<const BakeDomain>;

// Each keeps references to `inputs` and `geometry`.
//
// The vertices of all meshes; for transfer that is fitted also points on their triangles. Errors:
// Cancelled.
[[nodiscard]] Result<BakeDomainPtr> vertexDomain(const BakeInputs& inputs,
                                                 const BakeGeometry& geometry,
                                                 const BakeRequest& request, const JobContext& job);
// The texels of the materials' textures, `size` texels a side. Errors: as texelLayout() of
// core/bake/transfer/TexelTransfer.h.
[[nodiscard]] Result<BakeDomainPtr> texelDomain(const BakeInputs& inputs,
                                                const BakeGeometry& geometry,
                                                std::span<const Id> materials, int size,
                                                const JobContext& job);

// Kind, order, transport and settings of what is asked for, without values.
[[nodiscard]] BakeArtifact describeBake(BakeRequest request, const PassSettings& settings);

} // namespace patina
