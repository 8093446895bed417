// Bakes against the bare limit: the same rays through the same kind of hierarchy in a loop that
// only counts, by the fastest fitting call of Embree 3. The two alternate within one run, and CPU
// time is compared, so that a busy machine slows both alike. The only other file that sees Embree,
// so that RayScene's own cost shows.
#include "core/bake/BakePoints.h"
#include "core/bake/RangeTracer.h"
#include "core/job/Parallel.h"
#include "core/library/Meshes.h"

#include <algorithm>
#include <atomic>
#include <benchmark/benchmark.h>
#include <chrono>
#include <embree3/rtcore.h>
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

// `cluster` neighbours share directions, direction after direction; 1: point after point.
std::size_t bareLoop(const BareScene& scene, std::span<const BakePoint> points,
                     std::span<const PointRange> ranges, int samples, int cluster) {
    const HemisphereSamples directions(0, 0, std::uint32_t(samples));
    std::atomic<std::size_t> open = 0;
    parallelFor({}, ranges.size(), 1, [&](std::size_t begin, std::size_t end) {
        const FlushDenormals flush;
        constexpr std::size_t kStream = 1024;
        alignas(16) RTCRay rays[kStream];
        std::vector<RangeElement> order;
        std::vector<glm::mat3> frames;
        std::vector<glm::vec3> scratch;
        std::size_t count = 0;
        for (std::size_t r = begin; r < end; ++r) {
            orderRange(points, ranges[r], cluster, 0, order);
            std::size_t n = 0;
            for (std::size_t first = 0; first < order.size(); first += std::size_t(cluster)) {
                const std::size_t last = std::min(first + std::size_t(cluster), order.size());
                frames.clear();
                for (std::size_t e = first; e < last; ++e)
                    frames.push_back(
                        HemisphereSamples::frame(points[order[e].point].normal, order[e].seed));
                for (const glm::vec3& local : directions.directions(order[first].seed, scratch))
                    for (std::size_t e = first; e < last; ++e) {
                        const glm::vec3 o = points[order[e].point].origin;
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

// The bare loops and order-5 transfer, in turn. The yardstick is the faster of the loops point
// after point and by tiles of shared directions, over the better hierarchy where that pays.
void transferAgainstBareLoop(benchmark::State& state) {
    const Case& c = kCases[state.range(0)];
    const ThreadLimit limit(int(state.range(1)));
    const BakeGeometry geometry = *makeBakeGeometry(knot(c), {});
    const std::vector<BakePoint> points = vertexPoints(geometry, {});
    const std::vector<PointRange> ranges = vertexRanges(geometry, rangeSize(points.size()));
    const RayScene scene =
        std::move(*RayScene::build(geometry, {}, 0, double(points.size()) * c.samples));
    const double rays = double(points.size()) * c.samples;
    const BareScene bare(geometry,
                         c.samples >= 1024 ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    PassSettings settings;
    settings.samples = c.samples;
    settings.shOrder = 5;
    Times single, tiled, bake;
    std::size_t open = 0;
    double transferred = 0.0;
    for (auto _ : state) {
        single.run([&] { open = bareLoop(bare, points, ranges, c.samples, 1); });
        tiled.run([&] { open = bareLoop(bare, points, ranges, c.samples, 32); });
        bake.run([&] {
            const PassState done = *runPasses(scene, points, ranges, settings, {}, {});
            transferred = 0.0;
            for (std::size_t i = 0; i < done.values.size(); i += 25)
                transferred += done.values[i];
        });
    }
    const double yardstick = std::min(single.cpu, tiled.cpu);
    state.counters["bake Mrays/s"] = 1e-6 * rays / bake.wall;
    state.counters["bare Mrays/s"] = 1e-6 * rays / std::min(single.wall, tiled.wall);
    state.counters["bake/CPU"] = 1e-6 * rays / bake.cpu;
    state.counters["point/CPU"] = 1e-6 * rays / single.cpu;
    state.counters["tiled/CPU"] = 1e-6 * rays / tiled.cpu;
    state.counters["share"] = yardstick / bake.cpu;
    state.counters["open"] = double(open) / rays;
    state.counters["openBake"] =
        transferred / 0.282094791773878 / double(points.size()); // equal but for noise
    state.SetLabel(c.name);
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
    ->ArgsProduct({{0, 1}, {1, 2}})
    ->ArgNames({"case", "threads"})
    ->Iterations(3)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(ambientOcclusion)->UseRealTime()->Unit(benchmark::kMillisecond);
