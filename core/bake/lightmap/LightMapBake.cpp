#include "core/bake/lightmap/LightMapBake.h"

#include "core/bake/domain/BakeOptions.h"
#include "core/bake/domain/GutterFill.h"
#include "core/bake/lightmap/LightMapTexel.h"
#include "core/bake/transfer/Passes.h"
#include "core/bake/transfer/TexelTransfer.h"
#include "core/job/Parallel.h"
#include "core/trace/path/TraceHash.h"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace patina {
namespace {

constexpr std::uint32_t kFirstPass = 8;
constexpr double kRidge = 0.02; // of fitHemisphere()
constexpr std::size_t kTexelsAtATime = 16;

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

// Calls visit(texel, places) for texels `from` … `to` - 1, on the pool's threads; `begin` makes one
// for some of them. Ends early when the job is cancelled.
template <class Begin>
void forEachTexel(const TraceScene& scene, const Texels& texels, std::size_t from, std::size_t to,
                  const JobContext& job, const Begin& begin) {
    parallelFor(job, to - from, kTexelsAtATime, [&](std::size_t first, std::size_t last) {
        const FlushDenormals flush;
        auto visit = begin();
        std::vector<TracePoint> places;
        for (std::size_t t = from + first; t < from + last && !job.cancelled(); ++t) {
            const std::size_t p = texels.partOf(t);
            const MaterialTexels& part = texels.layout.parts[p];
            const std::size_t at = t - texels.first[p];
            places.clear();
            for (std::size_t i = part.texels.firstPoint[at]; i < part.texels.firstPoint[at + 1];
                 ++i) {
                const SurfacePlace& place = texels.places[part.firstPoint + i];
                places.push_back(scene.pointAt(place.mesh, place.triangle, {place.b1, place.b2}));
            }
            visit(t, std::span<const TracePoint>(places));
        }
    });
}

Error cancelledBake() {
    return {ErrorKind::Cancelled, "the bake was cancelled", {}, {}};
}

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
    for (const Hash& part : {all.materials, all.lights, all.environment})
        hasher.text(part.hex());
    return hasher.finish();
}

Result<BakeArtifact> bakeLightMap(const LightMapInputs& inputs, const LightMapSettings& settings,
                                  const JobContext& job) {
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
    std::vector<LightMapSums> sums(texels->count);
    std::vector<std::uint32_t> counts(texels->count, 0); // of samples
    std::uint32_t done = 0;
    for (std::uint32_t pass = std::min(kFirstPass, samples); done < samples && !job.stopping();
         pass = std::min(2 * pass, samples)) {
        job.setActivity(fmt::format("tracing {} of {} paths per texel", pass, samples));
        std::atomic<std::size_t> visited{0};
        forEachTexel(*scene, *texels, 0, texels->count, job, [&] {
            return [&, texel = LightMapTexel(*scene, inputs.imageLight, settings.seed)](
                       std::size_t t, std::span<const TracePoint> places) mutable {
                if (job.stopping())
                    return; // keeps the samples that it has
                const std::uint64_t before = texel.rays();
                texel.trace(places, static_cast<std::uint32_t>(t), done, pass - done, sums[t]);
                counts[t] = pass;
                job.addWork(static_cast<double>(texel.rays() - before), "rays");
                const double share =
                    static_cast<double>(++visited) / static_cast<double>(texels->count);
                job.setProgress((done + share * (pass - done)) / samples);
            };
        });
        if (!job.stopping())
            done = pass; // else some texels have more
    }
    if (job.cancelled())
        return cancelledBake();

    // What there is after a stop is finished; a cancel ends that, too.
    job.setActivity("finishing");
    BakeArtifact artifact;
    artifact.kind = BakeKind::LightMap;
    BakeRequest request;
    request.kind = artifact.kind;
    request.lightMap = settings;
    request.lightMap.samples = *wanted;
    artifact.settings = settingsText(request);
    artifact.inputs = inputs.geometry;
    artifact.light = hashLightMapLight(inputs.scene);
    artifact.samplesDone = static_cast<int>(done);
    artifact.stopped = done < samples;
    // Where nothing is known, image-based light stays as it is.
    std::vector<float> unknown(kLightMapStride, 0.0f);
    unknown[3] = 1.0f;
    const auto side = static_cast<std::size_t>(settings.size);
    for (std::size_t p = 0; p < texels->layout.parts.size(); ++p) {
        const MaterialTexels& part = texels->layout.parts[p];
        const std::size_t first = texels->first[p];
        LightMapTexture texture{settings.size, std::vector<LightMapTexture::Texel>(side * side)};
        forEachTexel(*scene, *texels, first, first + part.texels.texels.size(), job, [&] {
            return [&, texel = LightMapTexel(*scene, inputs.imageLight, settings.seed)](
                       std::size_t t, std::span<const TracePoint> places) {
                if (counts[t] > 0)
                    texture.texels[part.texels.texels[t - first]] =
                        texel.finish(places, counts[t], sums[t]);
            };
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
