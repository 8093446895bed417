// Bakes against the bare limit: the same rays through the same kind of hierarchy in a loop that
// only counts, by the fastest fitting call of Embree 3. The two alternate within one run, and CPU
// time is compared, so that a busy machine slows both alike. The only other file that sees Embree,
// so that RayScene's own cost shows.
#include "core/bake/Bake.h"
#include "core/bake/domain/BakePoints.h"
#include "core/bake/domain/VertexSamples.h"
#include "core/bake/transfer/RangeTracer.h"
#include "core/job/Parallel.h"
#include "core/library/Library.h"
#include "core/library/Meshes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <benchmark/benchmark.h>
#include <chrono>
#include <cmath>
#include <embree3/rtcore.h>
#include <string>
#include <sys/resource.h>

using namespace patina;

namespace {

struct Case {
    const char* name;
    int segments, sides; // of a torus knot
    int samples;
};
constexpr Case kCases[] = {{"100k triangles, 1024 rays", 1600, 32, 1024},
                           {"1M triangles, 64 rays", 5000, 100, 64}};

BakeInputs knot(const Case& c) {
    Mesh mesh = library::makeTorusKnot(c.segments, c.sides);
    (void)sanitizeMesh(mesh);
    BakeInputs result;
    result.meshes.push_back(
        {1, 1, std::make_shared<const Mesh>(std::move(mesh)), glm::mat4(1.0f), false});
    return result;
}

// Of all threads.
double cpuSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

double wallSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

class BareScene {
  public:
    BareScene(const BakeGeometry& geometry, RTCBuildQuality quality)
        : m_device(rtcNewDevice(nullptr))
        , m_scene(rtcNewScene(m_device)) {
        rtcSetSceneBuildQuality(m_scene, quality);
        RTCGeometry triangles = rtcNewGeometry(m_device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(triangles, quality);
        const BakeGeometryMesh& mesh = geometry.meshes.front();
        rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   mesh.positions.data(), 0, sizeof(glm::vec3),
                                   mesh.positions.size());
        rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.mesh->indices.data(), 0, 12, mesh.mesh->triangleCount());
        rtcCommitGeometry(triangles);
        rtcAttachGeometry(m_scene, triangles);
        rtcReleaseGeometry(triangles);
        rtcCommitScene(m_scene);
    }
    ~BareScene() {
        rtcReleaseScene(m_scene);
        rtcReleaseDevice(m_device);
    }
    BareScene(const BareScene&) = delete;
    BareScene& operator=(const BareScene&) = delete;

    // Number of rays that are free.
    std::size_t trace(RTCRay* rays, std::size_t count) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        rtcOccluded1M(m_scene, &context, rays, unsigned(count), sizeof(RTCRay));
        std::size_t open = 0;
        for (std::size_t i = 0; i < count; ++i)
            open += rays[i].tfar >= 0.0f ? 1 : 0;
        return open;
    }

  private:
    RTCDevice m_device;
    RTCScene m_scene;
};

// Part of the points that is baked and traced by itself, long enough for two threads to end at
// about the same time and short enough that what is compared runs within a second or two.
struct Piece {
    std::span<const BakePoint> points;
    std::vector<PointRange> ranges;
};

std::vector<Piece> piecesOf(std::span<const BakePoint> points,
                            const std::vector<PointRange>& ranges) {
    std::vector<Piece> pieces;
    const std::size_t quarter = ranges.size() / 4;
    for (const std::size_t begin : {std::size_t{0}, 2 * quarter}) {
        Piece& piece = pieces.emplace_back();
        const std::size_t first = ranges[begin].first;
        for (std::size_t r = begin; r < begin + quarter; ++r)
            piece.ranges.push_back({ranges[r].first - first, ranges[r].count});
        piece.points = points.subspan(first, piece.ranges.back().first + piece.ranges.back().count);
    }
    return pieces;
}

// How the rays of a point follow each other: as the sequence has them, or as the bake sorts them.
enum class Order { Sequence, Sorted };

// `cluster` neighbours share directions, direction after direction; 1: point after point.
std::size_t bareLoop(const BareScene& scene, const Piece& piece, int samples, int cluster,
                     Order order) {
    const std::span<const BakePoint> points = piece.points;
    const std::vector<PointRange>& ranges = piece.ranges;
    const bool sorted = order == Order::Sorted;
    const HemisphereSamples neighbours(0, 0, std::uint32_t(samples));
    std::vector<std::vector<glm::vec3>> sequences(sorted ? 0 : HemisphereSamples::kSequences);
    for (std::size_t s = 0; s < sequences.size(); ++s)
        for (std::uint32_t i = 0; i < std::uint32_t(samples); ++i)
            sequences[s].push_back(cosineHemisphere(sobolOwen2D(i, seedFor(0, std::uint32_t(s)))));
    std::atomic<std::size_t> open = 0;
    parallelFor({}, ranges.size(), 1, [&](std::size_t begin, std::size_t end) {
        const FlushDenormals flush;
        constexpr std::size_t kStream = 1024;
        alignas(16) RTCRay rays[kStream];
        std::vector<RangeElement> elements;
        std::vector<glm::mat3> frames;
        std::vector<glm::vec3> scratch;
        std::size_t count = 0;
        for (std::size_t r = begin; r < end; ++r) {
            orderRange(points, ranges[r], cluster, 0, elements);
            std::size_t n = 0;
            for (std::size_t first = 0; first < elements.size(); first += std::size_t(cluster)) {
                const std::size_t last = std::min(first + std::size_t(cluster), elements.size());
                frames.clear();
                for (std::size_t e = first; e < last; ++e)
                    frames.push_back(HemisphereSamples::frame(points[elements[e].point].normal,
                                                              elements[e].seed));
                const std::uint32_t seed = elements[first].seed;
                const std::span<const glm::vec3> directions =
                    sorted ? neighbours.directions(seed, scratch)
                           : sequences[seed % HemisphereSamples::kSequences];
                for (const glm::vec3& local : directions)
                    for (std::size_t e = first; e < last; ++e) {
                        const glm::vec3 o = points[elements[e].point].origin;
                        const glm::vec3 d = frames[e - first] * local;
                        rays[n++] = {o.x,  o.y,  o.z,
                                     0.0f, d.x,  d.y,
                                     d.z,  0.0f, std::numeric_limits<float>::infinity(),
                                     ~0u,  0,    0};
                        if (n == kStream) {
                            count += scene.trace(rays, n);
                            n = 0;
                        }
                    }
            }
            count += scene.trace(rays, n);
        }
        open += count;
    });
    return open;
}

struct Times {
    double cpu = 1e9, wall = 1e9; // best seconds
    template <typename F>
    void run(F f) {
        const double cpuBefore = cpuSeconds(), wallBefore = wallSeconds();
        f();
        cpu = std::min(cpu, cpuSeconds() - cpuBefore);
        wall = std::min(wall, wallSeconds() - wallBefore);
    }
};

// The bare loops and order-5 transfer, in turn, by one thread and by two. The yardstick is the
// faster of the loops point after point and by tiles of shared directions, in the order of the
// sequence, over the better hierarchy where that pays. What sorting the directions gives is the
// bake's own; `sorted` tells what it would give to the yardstick too.
void transferAgainstBareLoop(benchmark::State& state) {
    const Case& c = kCases[state.range(0)];
    const BakeGeometry geometry = *makeBakeGeometry(knot(c), {});
    const std::vector<BakePoint> points = vertexPoints(geometry, {});
    const RayScene scene =
        std::move(*RayScene::build(geometry, {}, 0, double(points.size()) * c.samples));
    const BareScene bare(geometry,
                         c.samples >= 1024 ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    const std::vector<Piece> pieces =
        piecesOf(points, vertexRanges(geometry, rangeSize(points.size())));
    PassSettings settings;
    settings.samples = c.samples;
    settings.shOrder = 5;
    struct Loops {
        Times single, tiled, sorted, bake;
    };
    std::vector<std::array<Loops, 2>> timed(pieces.size()); // by one thread, by two
    std::vector<std::size_t> open(pieces.size());
    std::vector<double> transferred(pieces.size());
    for (auto _ : state)
        for (std::size_t i = 0; i < pieces.size(); ++i)
            for (int threads = 1; threads <= 2; ++threads) {
                const ThreadLimit limit(threads);
                const Piece& piece = pieces[i];
                Loops& loops = timed[i][std::size_t(threads - 1)];
                loops.single.run(
                    [&] { open[i] = bareLoop(bare, piece, c.samples, 1, Order::Sequence); });
                loops.tiled.run(
                    [&] { open[i] = bareLoop(bare, piece, c.samples, 32, Order::Sequence); });
                const int better = loops.single.cpu < loops.tiled.cpu ? 1 : 32;
                loops.sorted.run(
                    [&] { open[i] = bareLoop(bare, piece, c.samples, better, Order::Sorted); });
                loops.bake.run([&] {
                    const PassState done =
                        *runPasses(scene, piece.points, piece.ranges, settings, {}, {});
                    transferred[i] = 0.0;
                    for (std::size_t v = 0; v < done.values.size(); v += 25)
                        transferred[i] += done.values[v];
                });
            }
    double rays = 0.0, isOpen = 0.0, bakeOpen = 0.0, bakeWall[2] = {};
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        rays += double(pieces[i].points.size()) * c.samples;
        isOpen += double(open[i]);
        bakeOpen += transferred[i] / 0.282094791773878 * c.samples;
    }
    for (const int t : {0, 1}) {
        double single = 0.0, tiled = 0.0, sorted = 0.0, bake = 0.0, bareWall = 0.0;
        for (const std::array<Loops, 2>& both : timed) {
            const Loops& loops = both[std::size_t(t)];
            single += loops.single.cpu;
            tiled += loops.tiled.cpu;
            sorted += loops.sorted.cpu;
            bake += loops.bake.cpu;
            bareWall += std::min(loops.single.wall, loops.tiled.wall);
            bakeWall[t] += loops.bake.wall;
        }
        const std::string by = t == 0 ? " 1" : " 2";
        state.counters["bake Mrays/s" + by] = 1e-6 * rays / bakeWall[t];
        state.counters["bare Mrays/s" + by] = 1e-6 * rays / bareWall;
        state.counters["share" + by] = std::min(single, tiled) / bake; // at least 0.92
        state.counters["share of sorted" + by] = sorted / bake;
        state.counters["tiled/point" + by] = single / tiled;
    }
    state.counters["1 to 2"] = bakeWall[0] / bakeWall[1]; // at least 1.85
    state.counters["open"] = isOpen / rays;
    state.counters["openBake"] = bakeOpen / rays; // equal but for noise
    state.SetLabel(c.name);
}

// A model of the library ready to bake, and what 16,384 rays per point find.
struct Truth {
    explicit Truth(const char* model, bool fitted, std::size_t most)
        : geometry(std::move(*makeBakeGeometry(inputsOf(model), {})))
        , samples(fitted ? fittedVertexSamples(geometry, {}) : vertexSamples(geometry, {}))
        , scene(std::move(*RayScene::build(geometry, {}, 0, 1e9))) {
        // Evenly over the model.
        const std::size_t step = (samples.points.size() + most - 1) / most;
        for (std::size_t p = 0; p < samples.points.size(); p += step)
            points.push_back(samples.points[p]);
        for (std::size_t first = 0; first < points.size(); first += 64)
            ranges.push_back({first, std::min<std::size_t>(64, points.size() - first)});
        PassSettings settings;
        settings.samples = 16384;
        settings.shOrder = 5;
        settings.seed = 77;
        settings.cluster = 1;
        values = runPasses(scene, points, ranges, settings, {}, {})->values;
    }
    [[nodiscard]] double rmse(const PassSettings& settings, Times* times = nullptr) const {
        PassState state;
        Times once;
        (times ? *times : once).run([&] {
            state = *runPasses(scene, points, ranges, settings, {}, {});
        });
        double squares = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i)
            squares += std::pow(double(state.values[i]) - values[i], 2.0);
        return std::sqrt(squares / double(values.size()));
    }

    BakeGeometry geometry;
    VertexSamples samples;
    RayScene scene;
    std::vector<BakePoint> points;
    std::vector<PointRange> ranges;
    std::vector<float> values;

  private:
    static BakeInputs inputsOf(const char* model) {
        BakeInputs inputs;
        const Result<std::vector<library::ModelPart>> parts = library::model(model);
        for (const library::ModelPart& part : *parts) {
            BakeMesh& mesh = inputs.meshes.emplace_back();
            mesh.id = mesh.material = Id(inputs.meshes.size());
            mesh.mesh = part.mesh;
        }
        return inputs;
    }
};

// 1024 rays by each method: the RMS error of the coefficients.
void errorAtEqualRays(benchmark::State& state) {
    const Truth truth("shader-ball", false, 4000);
    PassSettings settings;
    settings.samples = 1024;
    settings.shOrder = 5;
    double ofMethod[3] = {};
    for (auto _ : state)
        for (const SampleMethod method :
             {SampleMethod::Qmc, SampleMethod::Stratified, SampleMethod::Random}) {
            settings.method = method;
            ofMethod[int(method)] = truth.rmse(settings);
        }
    state.counters["RMSE"] = ofMethod[0];
    state.counters["of jittered"] = ofMethod[0] / ofMethod[1]; // at most 0.85
    state.counters["of random"] = ofMethod[0] / ofMethod[2];   // at most 0.15
}

// Passes to a tolerance against the fixed count that gets as far, by CPU time: between two fixed
// counts time is a power of the error.
void toleranceAgainstFixedCount(benchmark::State& state) {
    const Truth truth("cornell-box", true, 100'000);
    PassSettings settings;
    settings.shOrder = 5;
    constexpr int kCounts = 6; // 128 … 4096
    constexpr float kTolerances[] = {2e-3f, 1e-3f, 7e-4f, 5e-4f};
    Times fixed[kCounts], adaptive[std::size(kTolerances)];
    double fixedError[kCounts] = {}, error[std::size(kTolerances)] = {};
    for (auto _ : state) {
        settings.tolerance = 0.0f;
        for (int i = 0; i < kCounts; ++i) {
            settings.samples = 128 << i;
            fixedError[i] = truth.rmse(settings, &fixed[i]);
        }
        settings.samples = 8192;
        for (std::size_t i = 0; i < std::size(kTolerances); ++i) {
            settings.tolerance = kTolerances[i];
            error[i] = truth.rmse(settings, &adaptive[i]);
        }
    }
    for (std::size_t i = 0; i < std::size(kTolerances); ++i) {
        int n = 1;
        while (n + 1 < kCounts && fixedError[n] > error[i])
            ++n;
        const double along =
            std::log(fixedError[n - 1] / error[i]) / std::log(fixedError[n - 1] / fixedError[n]);
        const double equal = fixed[n - 1].cpu * std::pow(fixed[n].cpu / fixed[n - 1].cpu, along);
        const std::string at = " at " + std::to_string(error[i]).substr(0, 7);
        state.counters["of fixed" + at] = adaptive[i].cpu / equal; // at most 0.70
    }
}

void ambientOcclusion(benchmark::State& state) {
    const BakeInputs inputs = knot(kCases[0]);
    TileSink sink;
    for (auto _ : state)
        benchmark::DoNotOptimize(bakeAoVertex(inputs, {.samples = 256}, sink, {}));
    state.counters["Mrays/s"] = benchmark::Counter(
        256e-6 * double(inputs.meshes.front().mesh->vertexCount() * state.iterations()),
        benchmark::Counter::kIsRate);
}

} // namespace

BENCHMARK(transferAgainstBareLoop)
    ->DenseRange(0, 1)
    ->ArgName("case")
    ->Iterations(4)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(errorAtEqualRays)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(toleranceAgainstFixedCount)->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(ambientOcclusion)->UseRealTime()->Unit(benchmark::kMillisecond);
