// From what the samples of a bake per vertex saw to the transfer of every mesh.

#include "core/bake/transfer/VertexFit.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <utility>

namespace patina {
namespace {

constexpr float kY00 = 0.28209479177387814f; // uniform light of radiance 1 has L_00 = 1 / Y_00

// The rows of one mesh: of its vertices, then of its points on triangles.
std::vector<float> rowsOf(const VertexSamples& samples, std::size_t mesh,
                          std::size_t firstOnTriangles, std::size_t onTriangles, std::size_t stride,
                          std::span<const float> all) {
    const auto at = [&](std::size_t point) {
        return all.begin() + static_cast<std::ptrdiff_t>(point * stride);
    };
    const std::size_t begin = samples.firstOfMesh[mesh], end = samples.firstOfMesh[mesh + 1];
    const std::size_t first = samples.vertexCount() + firstOnTriangles;
    std::vector<float> rows;
    rows.reserve((end - begin + onTriangles) * stride);
    rows.insert(rows.end(), at(begin), at(end));
    rows.insert(rows.end(), at(first), at(first + onTriangles));
    return rows;
}

} // namespace

Result<std::vector<VertexBake>> finishVertexTransfer(const BakeGeometry& geometry,
                                                     const VertexSamples& samples,
                                                     const PassSettings& settings, PassState& state,
                                                     const JobContext& job) {
    const auto stride = static_cast<std::size_t>(settings.stride());
    state.passes = state.wanted = std::vector<std::uint8_t>();
    std::vector<float> sky(samples.points.size());
    for (std::size_t p = 0; p < sky.size(); ++p)
        sky[p] = skyShare(state.hiddenSky[p], samples.points[p].normal);
    state.hiddenSky = std::vector<float>();

    std::vector<VertexBake> bakes;
    std::size_t firstOnTriangles = 0;
    for (std::size_t m = 0; m < geometry.meshes.size(); ++m) {
        std::size_t endOnTriangles = firstOnTriangles;
        while (endOnTriangles < samples.onTriangles.size() &&
               samples.onTriangles[endOnTriangles].mesh == m)
            ++endOnTriangles;
        const std::size_t onTriangles = endOnTriangles - firstOnTriangles;
        const auto rows = [&](std::size_t width, std::span<const float> all) {
            return rowsOf(samples, m, firstOnTriangles, onTriangles, width, all);
        };
        VertexBake& bake = bakes.emplace_back();
        bake.mesh = geometry.meshes[m].id;
        bake.stride = settings.stride();
        // Of a single mesh they stand in this order already, and are too many to have twice.
        const bool single = geometry.meshes.size() == 1;
        bake.values = single ? std::exchange(state.values, {}) : rows(stride, state.values);
        bake.sky = single ? std::exchange(sky, {}) : rows(1, sky);
        if (samples.onTriangles.empty()) {
            if (settings.method != SampleMethod::Stratified) // whose one pass cannot tell
                bake.error = rows(1, state.error);
            continue;
        }

        // Band 0 of a transfer is its visibility: zero where no ray got out.
        std::vector<std::uint8_t> hidden(bake.sky.size());
        for (std::size_t p = 0; p < hidden.size(); ++p)
            hidden[p] = bake.values[p * stride] == 0.0f ? 1 : 0;
        const VertexFit fit(geometry.meshes[m],
                            std::span(samples.onTriangles).subspan(firstOnTriangles, onTriangles),
                            hidden, job);
        if (job.cancelled())
            break;
        std::vector<float> fitted = fit.solve(settings.stride(), bake.values, job);
        // What least squares overshoots beside steep slopes stays, below zero too: between the
        // vertices it makes up for what a straight line misses. But nothing is more than open.
        for (std::size_t first = 0; first < fitted.size(); first += stride)
            if (const float open = fitted[first] / kY00; open > 1.0f)
                for (std::size_t i = 0; i < stride; ++i)
                    fitted[first + i] /= open;
        bake.error = fit.residual(settings.stride(), bake.values, fitted);
        bake.values = std::move(fitted);
        bake.sky = fit.solve(1, bake.sky, job);
        for (float& share : bake.sky)
            share = std::clamp(share, 0.0f, 1.0f);
        firstOnTriangles = endOnTriangles;
    }
    if (job.cancelled())
        return bakeCancelled();
    return bakes;
}

} // namespace patina
