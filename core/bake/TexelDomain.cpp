// Ambient occlusion and radiance transfer per texel, one texture per material.

#include "core/bake/BakeDomain.h"
#include "core/bake/bounce/TexelBounces.h"
#include "core/bake/transfer/TexelTransfer.h"

#include <utility>

namespace patina {
namespace {

class TexelDomain : public BakeDomain {
  public:
    TexelDomain(const BakeInputs& inputs, const BakeGeometry& geometry, TexelLayout layout)
        : m_inputs(inputs)
        , m_geometry(geometry)
        , m_layout(std::move(layout)) {}

    [[nodiscard]] std::span<const BakePoint> points() const override { return m_layout.points; }
    [[nodiscard]] std::span<const PointRange> ranges() const override { return m_layout.ranges; }

    void report(const PointRange& range, int stride, std::span<const float> values,
                TileSink& sink) const override {
        const Id material = m_layout.partOf(range.first).material;
        forEachTexelRun(m_layout, range, stride, values,
                        [&](int x, int y, int width, std::span<const float> run) {
                            sink.texels(material, m_layout.size, stride, x, y, width, run);
                        });
    }

    [[nodiscard]] std::string note(const RayScene* /*scene*/, const PassSettings& /*settings*/,
                                   const PassState& /*state*/,
                                   const JobContext& /*job*/) const override {
        return m_layout.note();
    }

    Result<void> finish(BakeArtifact& artifact, const PassSettings& settings, PassState& state,
                        const JobContext& /*job*/) const override {
        if (holdsTransfer(artifact.kind))
            artifact.texels = finishTexelTransfer(m_layout, settings, state);
        else
            for (const MaterialTexels& part : m_layout.parts)
                artifact.texels.push_back(
                    {part.material, occlusionTexture(m_layout, part, state.values)});
        return {};
    }

    std::optional<Error> addBounces(BakeArtifact& artifact, const RayScene& scene,
                                    const PassState& state, const PrtSettings& settings,
                                    TileSink& /*sink*/, const JobContext& job) const override {
        return addTexelInterreflection(artifact, m_inputs, m_geometry, scene, m_layout, state,
                                       settings, job);
    }

  private:
    const BakeInputs& m_inputs;
    const BakeGeometry& m_geometry;
    const TexelLayout m_layout;
};

} // namespace

Result<BakeDomainPtr> texelDomain(const BakeInputs& inputs, const BakeGeometry& geometry,
                                  std::span<const Id> materials, int size, const JobContext& job) {
    Result<TexelLayout> layout = texelLayout(geometry, materials, size, job);
    if (!layout)
        return layout.error();
    return BakeDomainPtr(std::make_unique<const TexelDomain>(inputs, geometry, *std::move(layout)));
}

} // namespace patina
