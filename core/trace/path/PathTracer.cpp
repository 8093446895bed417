#include "core/trace/path/PathTracer.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/trace/path/Eye.h"
#include "core/trace/path/LightPath.h"
#include "core/trace/path/TraceOutputs.h"

#include <algorithm>
#include <mutex>

namespace patina {

static constexpr int kTile = kTraceTile;

Result<void> tracePaths(const TraceScene& scene, const TraceView& view,
                        const PathSettings& settings, Film& film, std::uint32_t first,
                        std::uint32_t count, const JobContext& job, TraceRays* rays,
                        const TraceTiles& tiles) {
    CHECK(film.width() == view.width && film.height() == view.height);
    const int columns = (view.width + kTile - 1) / kTile, rows = (view.height + kTile - 1) / kTile;
    const Eye eye(scene, view);
    const auto traceTile = [&](int tile) {
        LightPath path(scene, settings);
        const int x0 = tile % columns * kTile, y0 = tile / columns * kTile;
        for (int y = y0; y < std::min(y0 + kTile, view.height) && !job.stopping(); ++y)
            for (int x = x0; x < std::min(x0 + kTile, view.width); ++x) {
                const auto pixel = static_cast<std::uint32_t>(y * view.width + x);
                Film::Pixel sum = film.at(x, y);
                TraceOutputSum outputs;
                for (std::uint32_t i = std::max(first, sum.samples); i < first + count; ++i) {
                    const PathSequence sequence(i, seedFor(settings.seed, pixel));
                    float alpha = 0.0f;
                    TraceSample sample;
                    path.fill(tiles.outputs != nullptr ? &sample : nullptr);
                    const glm::vec2 at = sequence.at(0, PathSequence::kPixel);
                    const Eye::Ray ray = eye.hasLens()
                                             ? eye.throughLens(x, y, at, sequence.onLens())
                                             : Eye::Ray{eye.origin(), eye.direction(x, y, at)};
                    const glm::vec3 radiance =
                        path.look(ray.origin, ray.direction, sequence, view, alpha);
                    sum.add(radiance, alpha);
                    if (tiles.outputs != nullptr)
                        outputs.add(sample, radiance);
                }
                const auto held = tiles.film != nullptr ? std::unique_lock(*tiles.film)
                                                        : std::unique_lock<std::mutex>();
                film.at(x, y) = sum;
                if (tiles.outputs != nullptr)
                    outputs.addTo(tiles.outputs->pixels()[pixel]);
            }
        job.addWork(static_cast<double>(path.rays()), "rays");
        if (rays != nullptr)
            rays->count += path.rays();
        if (tiles.tileDone)
            tiles.tileDone();
    };
    parallelFor(job, static_cast<std::size_t>(columns * rows), 1,
                [&](std::size_t begin, std::size_t end) {
                    const FlushDenormals flush;
                    for (std::size_t tile = begin; tile < end; ++tile)
                        if (tiles.shard.holds(tile))
                            traceTile(static_cast<int>(tile));
                });
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    return {};
}

void traceIrradiance(const TraceScene& scene, const glm::dvec3& position, const glm::vec3& normal,
                     const PathSettings& settings, std::uint32_t count, Film::Pixel& pixel) {
    // A white surface returns its irradiance over pi; one of index 1 has no gloss above it.
    shading::BrdfModel model = shading::defaultBrdfModel();
    model.fresnel = shading::kFresnelDielectric;
    model.ior = 1.0f;
    const shading::SurfaceInputs white{glm::vec3(1.0f), 0.0f, 1.0f, 0.0f};
    TraceSurface surface;
    surface.opaque = shading::makeSurface(model, white, normal, normal, glm::vec2(0.0f));
    TracePoint point;
    point.position = scene.toScene(position);
    point.face = point.normal = normal;
    const FlushDenormals flush;
    LightPath path(scene, settings);
    for (std::uint32_t i = 0; i < count; ++i)
        pixel.add(shading::kPi *
                      path.follow(point, surface, PathSequence(i, settings.seed)).radiance,
                  1.0f);
}

} // namespace patina
