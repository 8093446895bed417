#include "core/bake/lightmap/LightMapBake.h"

#include "core/bake/domain/BakeOptions.h"
#include "core/bake/domain/GutterFill.h"
#include "core/bake/lightmap/LightMapTexel.h"
#include "core/bake/transfer/BakeTracer.h"
#include "core/bake/transfer/TexelTransfer.h"
#include "core/job/Parallel.h"
#include "core/trace/path/TraceHash.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstddef>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <utility>
#include <vector>

namespace patina {
namespace {

constexpr std::uint32_t kFirstPass = 8;
constexpr double kRidge = 0.02;            // of fitHemisphere()
constexpr std::size_t kTexelsAtATime = 16; // also what shards take turns at
// Of a texel, between two looks at whether the job ends: some milliseconds.
constexpr std::uint32_t kSamplesAtATime = 256;

// The texels of all materials, one after another, and their places on the surface.
struct Texels {
    TexelLayout layout;               // without points, which paths do not begin at
    std::vector<SurfacePlace> places; // of those points
    std::vector<std::size_t> first;   // of each of the layout's parts
    std::size_t count = 0;

    [[nodiscard]] std::size_t partOf(std::size_t texel) const {
        return static_cast<std::size_t>(std::ranges::upper_bound(first, texel) - first.begin()) - 1;
    }
};

Result<Texels> layOut(const BakeGeometry& geometry, int size, const JobContext& job) {
    Texels all;
    Result<TexelLayout> layout =
        texelLayout(geometry, materialsInOrder(geometry), size, job, &all.places);
    if (!layout)
        return layout.error();
    all.layout = *std::move(layout);
    std::vector<BakePoint>().swap(all.layout.points);
    for (const MaterialTexels& part : all.layout.parts) {
        all.first.push_back(all.count);
        all.count += part.texels.texels.size();
    }
    return all;
}

void placesOf(const TraceScene& scene, const Texels& texels, std::size_t texel,
              std::vector<TracePoint>& places) {
    const std::size_t p = texels.partOf(texel);
    const MaterialTexels& part = texels.layout.parts[p];
    const std::size_t at = texel - texels.first[p];
    places.clear();
    for (std::size_t i = part.texels.firstPoint[at]; i < part.texels.firstPoint[at + 1]; ++i) {
        const SurfacePlace& place = texels.places[part.firstPoint + i];
        places.push_back(scene.pointAt(place.mesh, place.triangle, {place.b1, place.b2}));
    }
}

std::vector<PointRange> rangesOf(std::size_t texels) {
    std::vector<PointRange> ranges;
    for (std::size_t first = 0; first < texels; first += kTexelsAtATime)
        ranges.push_back({first, std::min(kTexelsAtATime, texels - first)});
    return ranges;
}

// What passes have left of a texel, and back.
LightMapSums sumsOf(const PassState& state, std::size_t texel) {
    std::array<float, kLightMapSumFloats> values{};
    std::copy_n(state.values.begin() + static_cast<std::ptrdiff_t>(texel * kLightMapSumFloats),
                kLightMapSumFloats, values.begin());
    return std::bit_cast<LightMapSums>(values);
}
void keepSums(PassState& state, std::size_t texel, const LightMapSums& sums) {
    const auto values = std::bit_cast<std::array<float, kLightMapSumFloats>>(sums);
    std::ranges::copy(values, state.values.begin() +
                                  static_cast<std::ptrdiff_t>(texel * kLightMapSumFloats));
}

Error cancelledBake() {
    return {ErrorKind::Cancelled, "the bake was cancelled", {}, {}};
}

// The paths of all texels, or of a shard's: what there is to do, and a run of it.
class LightMapPasses {
  public:
    // All outlive it.
    LightMapPasses(const TraceScene& scene, const Texels& texels,
                   const EnvironmentLookup& imageLight, std::uint32_t samples, std::uint32_t seed,
                   const JobContext& job)
        : m_scene(scene)
        , m_texels(texels)
        , m_imageLight(imageLight)
        , m_samples(samples)
        , m_first(std::min(kFirstPass, samples))
        , m_seed(seed)
        , m_job(job)
        , m_ranges(rangesOf(texels.count)) {}

    [[nodiscard]] int passes() const {
        int passes = 1;
        while (samplesAfter(passes) < m_samples)
            ++passes;
        return passes;
    }
    [[nodiscard]] std::uint32_t samplesAfter(int passes) const {
        return passes == 0 ? 0 : m_first << (passes - 1);
    }

    Result<std::optional<PassState>> trace(BakeTracer* tracer) {
        const PassCallbacks nobodyWatches;
        const auto work = [this](const PassShard& shard, const PassCallbacks& callbacks,
                                 PassState state) {
            return run(shard, callbacks, std::move(state));
        };
        return tracePasses(tracer,
                           {m_texels.count, m_ranges, static_cast<int>(kLightMapSumFloats),
                            static_cast<int>(m_samples), passes(), nobodyWatches, m_job, work});
    }

  private:
    Result<PassState> run(const PassShard& shard, const PassCallbacks& callbacks, PassState state) {
        if (state.passes.empty()) {
            state.values.resize(m_texels.count * kLightMapSumFloats);
            state.passes.resize(m_texels.count);
        }
        std::vector<PointRange> held;
        for (std::size_t r = 0; r < m_ranges.size(); ++r)
            if (shard.holds(r))
                held.push_back(m_ranges[r]);
        m_kept = std::chrono::steady_clock::now();
        const int all = passes();
        for (int pass = 0; pass < all && !m_job.stopping(); ++pass)
            runPass(pass, held, callbacks, state);

        int least = all;
        for (const PointRange& range : held)
            for (std::size_t t = range.first; t < range.first + range.count; ++t)
                least = std::min<int>(least, state.passes[t]);
        state.samplesDone = static_cast<int>(samplesAfter(least));
        if (!m_job.cancelled())
            return state;
        if (callbacks.checkpoint)
            callbacks.checkpoint(state);
        return cancelledBake();
    }

    void runPass(int pass, const std::vector<PointRange>& held, const PassCallbacks& callbacks,
                 PassState& state) {
        const std::uint32_t before = samplesAfter(pass), after = samplesAfter(pass + 1);
        m_job.setActivity(fmt::format("tracing {} of {} paths per texel", after, m_samples));
        // Every texel of the shard has those of the pass before.
        state.samplesDone = std::max(state.samplesDone, static_cast<int>(before));
        std::atomic<std::size_t> visited{0};
        parallelFor(m_job, held.size(), 1, [&](std::size_t first, std::size_t last) {
            const FlushDenormals flush;
            LightMapTexel texel(m_scene, m_imageLight, m_seed);
            std::vector<TracePoint> places;
            for (std::size_t r = first; r < last && !m_job.stopping(); ++r) {
                traceRange(held[r], pass, texel, places, state);
                const double share =
                    static_cast<double>(++visited) / static_cast<double>(held.size());
                m_job.setProgress((before + share * (after - before)) / m_samples);
                keep(callbacks, state);
            }
        });
    }

    // Texels that a checkpoint has this pass of are passed over; one that is stopped in the middle
    // keeps what it had.
    void traceRange(const PointRange& range, int pass, LightMapTexel& texel,
                    std::vector<TracePoint>& places, PassState& state) {
        const std::uint32_t before = samplesAfter(pass), after = samplesAfter(pass + 1);
        for (std::size_t t = range.first; t < range.first + range.count; ++t) {
            if (state.passes[t] > pass)
                continue;
            placesOf(m_scene, m_texels, t, places);
            LightMapSums sums = sumsOf(state, t);
            const std::uint64_t rays = texel.rays();
            for (std::uint32_t done = before; done < after; done += kSamplesAtATime) {
                if (m_job.stopping())
                    return;
                texel.trace(places, static_cast<std::uint32_t>(t), done,
                            std::min(kSamplesAtATime, after - done), sums);
            }
            m_job.addWork(static_cast<double>(texel.rays() - rays), "rays");
            // No checkpoint sees half of a texel's.
            const std::shared_lock lock(m_commit);
            keepSums(state, t, sums);
            state.passes[t] = static_cast<std::uint8_t>(pass + 1);
        }
    }

    void keep(const PassCallbacks& callbacks, const PassState& state) {
        if (!callbacks.checkpoint)
            return;
        const std::unique_lock lock(m_commit, std::try_to_lock);
        const std::chrono::duration<double> every(callbacks.checkpointSeconds);
        if (!lock || std::chrono::steady_clock::now() - m_kept < every)
            return; // the next range tries again
        callbacks.checkpoint(state);
        m_kept = std::chrono::steady_clock::now();
    }

    const TraceScene& m_scene;
    const Texels& m_texels;
    const EnvironmentLookup& m_imageLight;
    std::uint32_t m_samples, m_first, m_seed;
    const JobContext& m_job;
    std::vector<PointRange> m_ranges;
    std::shared_mutex m_commit; // held alone while a checkpoint is taken; guards m_kept
    std::chrono::steady_clock::time_point m_kept;
};

void fitSpecular(LightMapTexture::Texel& texel) {
    if (texel.normal == glm::vec3(0.0f))
        return;
    std::array<glm::vec4, kLightMapTerms> moments{};
    std::copy_n(texel.values.begin() + 1, kLightMapTerms, moments.begin());
    const auto fitted = fitHemisphere(texel.normal, moments, kRidge);
    std::ranges::copy(fitted, texel.values.begin() + 1);
}

} // namespace

Hash hashLightMapLight(const TraceInputs& scene) {
    const TraceHash all = hashTraceInputs(scene);
    Hasher hasher;
    hasher.text("exact irradiance"); // what is corrected: until 2026-11 it was nine coefficients
    for (const Hash& part : {all.materials, all.lights, all.environment})
        hasher.text(part.hex());
    return hasher.finish();
}

Result<BakeArtifact> bakeLightMap(const LightMapInputs& inputs, const LightMapSettings& settings,
                                  const JobContext& job, BakeTracer* tracer) {
    const Result<int> wanted = roundSamples(settings.samples);
    if (!wanted)
        return wanted.error();
    if (settings.size < 1 || settings.size > kMaxLightMapSize)
        return Error{ErrorKind::Usage,
                     fmt::format("The side of a light map is 1 to {} texels, not {}.",
                                 kMaxLightMapSize, settings.size),
                     {},
                     {}};
    job.setActivity("preparing the scene");
    const Result<TraceScene> scene = TraceScene::build(inputs.scene, job);
    if (!scene)
        return scene.error();
    if (scene->isEmpty())
        return Error{ErrorKind::InputBroken, "The scene has no triangles to bake.", {}, {}};
    const Result<Texels> texels = layOut(*scene->geometry(), settings.size, job);
    if (!texels)
        return texels.error();

    const auto samples = static_cast<std::uint32_t>(*wanted);
    LightMapPasses passes(*scene, *texels, inputs.imageLight, samples, settings.seed, job);
    const Result<std::optional<PassState>> traced = passes.trace(tracer);
    if (!traced)
        return traced.error();

    BakeArtifact artifact;
    artifact.kind = BakeKind::LightMap;
    BakeRequest request;
    request.kind = artifact.kind;
    request.lightMap = settings;
    request.lightMap.samples = *wanted;
    artifact.settings = settingsText(request);
    artifact.inputs = inputs.geometry;
    artifact.light = hashLightMapLight(inputs.scene);
    if (!traced->has_value())
        return artifact;
    const PassState& state = **traced;
    artifact.samplesDone = state.samplesDone;
    artifact.stopped = state.samplesDone < *wanted;

    // What there is after a stop is finished; a cancel ends that, too.
    job.setActivity("finishing");
    // Where nothing is known, image-based light stays as it is.
    std::vector<float> unknown(kLightMapStride, 0.0f);
    unknown[3] = 1.0f;
    const auto side = static_cast<std::size_t>(settings.size);
    for (std::size_t p = 0; p < texels->layout.parts.size(); ++p) {
        const MaterialTexels& part = texels->layout.parts[p];
        const std::size_t first = texels->first[p];
        LightMapTexture texture{settings.size, std::vector<LightMapTexture::Texel>(side * side)};
        parallelFor(job, part.texels.texels.size(), kTexelsAtATime,
                    [&](std::size_t begin, std::size_t end) {
                        const FlushDenormals flush;
                        const LightMapTexel texel(*scene, inputs.imageLight, settings.seed);
                        std::vector<TracePoint> places;
                        for (std::size_t at = begin; at < end && !job.cancelled(); ++at) {
                            const std::size_t t = first + at;
                            if (state.passes[t] == 0)
                                continue;
                            placesOf(*scene, *texels, t, places);
                            texture.texels[part.texels.texels[at]] = texel.finish(
                                places, passes.samplesAfter(state.passes[t]), sumsOf(state, t));
                        }
                    });
        if (settings.smooth)
            filterLightMap(texture, job);
        parallelFor(job, texture.texels.size(), kTexelsAtATime,
                    [&](std::size_t begin, std::size_t end) {
                        for (std::size_t t = begin; t < end; ++t)
                            fitSpecular(texture.texels[t]);
                    });
        if (job.cancelled())
            return cancelledBake();
        TexelBake& bake = artifact.texels.emplace_back();
        bake.material = part.material;
        bake.side = settings.size;
        bake.stride = kLightMapStride;
        bake.values.resize(side * side * kLightMapStride);
        std::vector<std::uint8_t> known(side * side, 0);
        for (std::size_t at = 0; at < texture.texels.size(); ++at) {
            const LightMapTexture::Texel& from = texture.texels[at];
            known[at] = from.normal != glm::vec3(0.0f) ? 1 : 0;
            for (std::size_t i = 0; i < kLightMapStride; ++i)
                bake.values[at * kLightMapStride + i] = from.values[i / 4][static_cast<int>(i % 4)];
        }
        fillGutters(bake.values, std::move(known), settings.size, unknown);
    }
    artifact.note = texels->layout.note();
    job.setProgress(1.0);
    return artifact;
}

} // namespace patina
