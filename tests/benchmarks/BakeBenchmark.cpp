// Bakes against the bare limit: the same rays through the same hierarchy in a loop that only
// counts. The only other file that sees Embree, so that RayScene's own cost shows.
#include "core/bake/Bake.h"
#include "core/bake/BakePoints.h"
#include "core/bake/HemisphereSamples.h"
#include "core/job/Parallel.h"
#include "core/library/Meshes.h"

#include <atomic>
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

using namespace patina;

namespace {

constexpr int kSamples = 256;

// 102,400 triangles.
const BakeInputs& knot() {
    static const BakeInputs inputs = [] {
        Mesh mesh = library::makeTorusKnot(1600, 32);
        (void)sanitizeMesh(mesh);
        BakeInputs result;
        result.meshes.push_back(
            {1, 1, std::make_shared<const Mesh>(std::move(mesh)), glm::mat4(1.0f), false});
        return result;
    }();
    return inputs;
}

void report(benchmark::State& state, std::size_t vertices, double openFraction) {
    state.counters["Mrays/s"] =
        benchmark::Counter(double(vertices) * kSamples * 1e-6 * double(state.iterations()),
                           benchmark::Counter::kIsRate);
    state.counters["open"] = openFraction;
}

void bareLoop(benchmark::State& state) {
    const BakeGeometry geometry = *makeBakeGeometry(knot(), {});
    const std::vector<BakePoint> points = vertexPoints(geometry, {});
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    RTCGeometry triangles = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const BakeGeometryMesh& mesh = geometry.meshes.front();
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               mesh.positions.data(), 0, sizeof(glm::vec3), mesh.positions.size());
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.mesh->indices.data(), 0, 12, mesh.mesh->triangleCount());
    rtcCommitGeometry(triangles);
    rtcAttachGeometry(scene, triangles);
    rtcReleaseGeometry(triangles);
    rtcCommitScene(scene);
    const HemisphereSamples samples(0, 0, kSamples);
    std::atomic<std::size_t> open = 0;
    for (auto _ : state) {
        open = 0;
        parallelFor({}, points.size(), 64, [&](std::size_t begin, std::size_t end) {
            _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
            _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
            constexpr std::size_t kVertices = 4; // 1024 rays a call
            alignas(16) RTCRay rays[kVertices * kSamples];
            std::size_t count = 0;
            std::vector<glm::vec3> scratch;
            for (std::size_t first = begin; first < end; first += kVertices) {
                std::size_t n = 0;
                for (std::size_t p = first; p < std::min(first + kVertices, end); ++p) {
                    const std::uint32_t seed = seedFor(0, std::uint32_t(p));
                    const glm::mat3 frame = HemisphereSamples::frame(points[p].normal, seed);
                    for (const glm::vec3& local : samples.directions(seed, scratch)) {
                        const glm::vec3 d = frame * local, o = points[p].origin;
                        rays[n++] = {o.x,  o.y,  o.z,
                                     0.0f, d.x,  d.y,
                                     d.z,  0.0f, std::numeric_limits<float>::infinity(),
                                     ~0u,  0,    0};
                    }
                }
                RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                rtcOccluded1M(scene, &context, rays, unsigned(n), sizeof(RTCRay));
                for (std::size_t i = 0; i < n; ++i)
                    count += rays[i].tfar >= 0.0f ? 1 : 0;
            }
            open += count;
        });
    }
    report(state, points.size(), double(open) / double(points.size()) / kSamples);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}

double meanOfBandZero(const BakeArtifact& artifact) {
    double sum = 0.0;
    const VertexBake& bake = artifact.vertices.front();
    for (std::size_t i = 0; i < bake.values.size(); i += std::size_t(bake.stride))
        sum += bake.values[i];
    return sum / double(bake.values.size() / std::size_t(bake.stride));
}

void ambientOcclusion(benchmark::State& state) {
    TileSink sink;
    double open = 0.0;
    for (auto _ : state)
        open = meanOfBandZero(*bakeAoVertex(knot(), {.samples = kSamples}, sink, {}));
    report(state, knot().meshes.front().mesh->vertexCount(), open);
}

void transfer(benchmark::State& state) {
    TileSink sink;
    double open = 0.0;
    for (auto _ : state)
        open = meanOfBandZero(*bakePrtVertex(
                   knot(), {.order = int(state.range(0)), .samples = kSamples}, sink, {})) /
               0.282094791773878;
    report(state, knot().meshes.front().mesh->vertexCount(), open);
}

} // namespace

BENCHMARK(bareLoop)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(ambientOcclusion)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(transfer)->Arg(3)->Arg(5)->UseRealTime()->Unit(benchmark::kMillisecond);
