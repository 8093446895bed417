// Ambient occlusion and radiance transfer per vertex.

#include "core/bake/BakeDomain.h"
#include "core/bake/TransferRefinement.h"
#include "core/bake/bounce/Interreflection.h"
#include "core/bake/transfer/InsideGeometry.h"
#include "core/bake/transfer/TransferMeaning.h"
#include "core/bake/transfer/VertexFit.h"

#include <fmt/format.h>
#include <utility>

namespace patina {
namespace {

// Advice where triangles cannot show their shadows: from about this share of the surface on it is
// seen in pictures, by a few per cent of their mean (docs/maths/transfer-truth.md).
void noteCoarseMeshes(BakeArtifact& artifact, const BakeInputs& inputs) {
    constexpr int kEnoughRays = 128; // their noise is below the tolerance
    constexpr double kMuch = 0.005;
    if (artifact.samplesDone < kEnoughRays)
        return;
    const double share = coarseShare(inputs, artifact.vertices);
    if (share < kMuch)
        return;
    if (!artifact.note.empty())
        artifact.note += ' ';
    artifact.note +=
        fmt::format("On {:.1f} % of the surface, triangles are too coarse for its shadows: "
                    "smaller ones are needed there, or a bake per texel, which has no such "
                    "limit.",
                    100.0 * share);
}

class VertexDomain : public BakeDomain {
  public:
    VertexDomain(const BakeInputs& inputs, const BakeGeometry& geometry, VertexSamples samples)
        : m_inputs(inputs)
        , m_geometry(geometry)
        , m_samples(std::move(samples)) {}

    [[nodiscard]] std::span<const BakePoint> points() const override { return m_samples.points; }
    [[nodiscard]] std::span<const PointRange> ranges() const override { return m_samples.ranges; }

    void report(const PointRange& range, int stride, std::span<const float> values,
                TileSink& sink) const override {
        if (range.first >= m_samples.vertexCount())
            return; // on triangles: seen when they are fitted
        const std::size_t mesh = m_samples.meshOf(range.first);
        sink.vertices(m_geometry.meshes[mesh].id, range.first - m_samples.firstOfMesh[mesh], stride,
                      values);
    }

    [[nodiscard]] std::string note(const RayScene* scene, const PassSettings& settings,
                                   const PassState& state, const JobContext& job) const override {
        if (scene == nullptr)
            return {};
        const auto stride = static_cast<std::size_t>(settings.stride());
        std::vector<float> visibility(m_samples.vertexCount());
        for (std::size_t v = 0; v < visibility.size(); ++v)
            visibility[v] =
                settings.shOrder == 0
                    ? state.values[v]
                    : ambientVisibility(std::span(state.values).subspan(v * stride, stride));
        return insideNote(m_geometry,
                          countVerticesInside(m_geometry, *scene, points().first(visibility.size()),
                                              visibility, job));
    }

    Result<void> finish(BakeArtifact& artifact, const PassSettings& settings, PassState& state,
                        const JobContext& job) const override {
        if (!holdsTransfer(artifact.kind)) {
            artifact.vertices = visibilityOf(state.values);
        } else {
            const bool fitted = !m_samples.onTriangles.empty();
            if (fitted)
                job.setActivity("fitting values to the surface");
            Result<std::vector<VertexBake>> vertices =
                finishVertexTransfer(m_geometry, m_samples, settings, state, job);
            if (!vertices)
                return vertices.error();
            artifact.vertices = *std::move(vertices);
            if (fitted)
                noteCoarseMeshes(artifact, m_inputs);
        }
        state = {}; // makes room for hits
        return {};
    }

    std::optional<Error> addBounces(BakeArtifact& artifact, const RayScene& scene,
                                    const PassState& /*state*/, const PrtSettings& settings,
                                    TileSink& sink, const JobContext& job) const override {
        return addInterreflection(artifact, m_inputs, m_geometry, scene, settings, sink, job);
    }

  private:
    // The values of the vertices themselves.
    [[nodiscard]] std::vector<VertexBake> visibilityOf(std::span<const float> values) const {
        std::vector<VertexBake> bakes;
        for (std::size_t m = 0; m < m_geometry.meshes.size(); ++m) {
            const std::size_t first = m_samples.firstOfMesh[m], end = m_samples.firstOfMesh[m + 1];
            const std::span<const float> own = values.subspan(first, end - first);
            VertexBake& bake = bakes.emplace_back();
            bake.mesh = m_geometry.meshes[m].id;
            bake.values.assign(own.begin(), own.end());
        }
        return bakes;
    }

    const BakeInputs& m_inputs;
    const BakeGeometry& m_geometry;
    const VertexSamples m_samples;
};

} // namespace

Result<BakeDomainPtr> vertexDomain(const BakeInputs& inputs, const BakeGeometry& geometry,
                                   const BakeRequest& request, const JobContext& job) {
    // Nothing shades an open surface: its values are exact at the vertices, and nothing is fitted.
    const bool fitted = holdsTransfer(request.kind) && request.prt.fitted &&
                        request.prt.transfer != TransferKind::Unshadowed;
    return BakeDomainPtr(std::make_unique<const VertexDomain>(
        inputs, geometry,
        fitted ? fittedVertexSamples(geometry, job) : vertexSamples(geometry, job)));
}

} // namespace patina
