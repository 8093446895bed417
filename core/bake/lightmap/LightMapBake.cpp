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

// The texels of all materials and their places on the surface.
struct Texels {
    struct Part {
        Id material = 0;
        TexelPoints texels; // without points
        std::vector<SurfacePlace> places;
        std::size_t first = 0; // of all texels
    };
    std::vector<Part> parts;
    std::size_t count = 0;
    std::size_t shared = 0;

    [[nodiscard]] const Part& partOf(std::size_t texel) const {
        return *(std::upper_bound(parts.begin(), parts.end(), texel,
                                  [](std::size_t t, const Part& part) { return t < part.first; }) -
                 1);
    }
};

Result<Texels> layOut(const BakeGeometry& geometry, int size, const JobContext& job) {
    Result<TexelLayout> checked = texelLayout(geometry, std::span<const Id>(), size, job);
    if (!checked)
        return checked.error();
    Texels all;
    for (const Id material : materialsInOrder(geometry)) {
        Texels::Part part;
        part.material = material;
        part.first = all.count;
        part.texels = texelPoints(geometry, material, size, job, &part.places);
        std::vector<BakePoint>().swap(part.texels.points);
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "the bake was cancelled", {}, {}};
        all.count += part.texels.texels.size();
        all.shared += part.texels.sharedTexels;
        all.parts.push_back(std::move(part));
    }
    return all;
}

// Calls visit(texel, places) for texels `from` … `to` - 1, on the pool's threads.
template <class Visit>
void forEachTexel(const TraceScene& scene, const Texels& texels, std::size_t from, std::size_t to,
                  const JobContext& job, const Visit& begin) {
    parallelFor(job, to - from, kTexelsAtATime, [&](std::size_t first, std::size_t last) {
        const FlushDenormals flush;
        auto visit = begin();
        std::vector<TracePoint> places;
        for (std::size_t t = from + first; t < from + last; ++t) {
            if (job.stopping())
                return;
            const Texels::Part& part = texels.partOf(t);
            const std::size_t at = t - part.first;
            places.clear();
            for (std::size_t p = part.texels.firstPoint[at]; p < part.texels.firstPoint[at + 1];
                 ++p) {
                const SurfacePlace& place = part.places[p];
                places.push_back(scene.pointAt(place.mesh, place.triangle, {place.b1, place.b2}));
            }
            visit(t, std::span<const TracePoint>(places));
        }
    });
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
        return Error{ErrorKind::Cancelled, "the bake was cancelled", {}, {}};

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
    const JobContext nobody; // what there is after a stop is finished
    // Where nothing is known, image-based light stays as it is.
    std::vector<float> unknown(kLightMapStride, 0.0f);
    unknown[3] = 1.0f;
    const auto side = static_cast<std::size_t>(settings.size);
    for (const Texels::Part& part : texels->parts) {
        LightMapTexture texture{settings.size, std::vector<LightMapTexture::Texel>(side * side)};
        forEachTexel(
            *scene, *texels, part.first, part.first + part.texels.texels.size(), nobody, [&] {
                return [&, texel = LightMapTexel(*scene, inputs.imageLight, settings.seed)](
                           std::size_t t, std::span<const TracePoint> places) {
                    if (counts[t] > 0)
                        texture.texels[part.texels.texels[t - part.first]] =
                            texel.finish(places, counts[t], sums[t]);
                };
            });
        if (settings.smooth)
            filterLightMap(texture, nobody);
        parallelFor(nobody, texture.texels.size(), kTexelsAtATime,
                    [&](std::size_t first, std::size_t last) {
                        for (std::size_t t = first; t < last; ++t)
                            fitSpecular(texture.texels[t]);
                    });
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
    if (texels->shared * 1000 > texels->count)
        artifact.note = fmt::format("UVs overlap or repeat on {:.0f} % of the baked texels, which "
                                    "hold the mean of the places that share them. Unwrap the mesh "
                                    "for one value per place.",
                                    std::max(1.0, 100.0 * static_cast<double>(texels->shared) /
                                                      static_cast<double>(texels->count)));
    job.setProgress(1.0);
    return artifact;
}

} // namespace patina
