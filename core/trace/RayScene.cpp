#include "core/trace/RayScene.h"

#include "core/base/FreedMemory.h"
#include "core/job/ForkJoin.h"
#include "core/material/Material.h"
#include "core/math/Sampling.h"
#include "core/trace/BakeInputs.h"
#include "core/trace/Embree.h"

#include <atomic>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <new>
#include <utility>

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace patina {

namespace {

// A mesh that lets some rays through.
struct Sieve {
    const BakeGeometryMesh* mesh;
    Coverage coverage;
};

// Even in [0, 1), and always the same for the same ray through the same triangle of the same mesh.
// Of its origin, too: all rays to a light without extent that is far away have one direction.
float chanceOf(const glm::vec3& origin, const glm::vec3& direction, unsigned mesh,
               unsigned triangle) {
    std::uint32_t bits = hash32((triangle + 0x9e3779b9u) ^ hash32(mesh));
    for (const float c : {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z})
        bits = hash32(bits ^ std::bit_cast<std::uint32_t>(c));
    return detail::unitFloat(bits);
}

// Filters run on the thread that casts the ray.
thread_local bool t_chance = false;

// Embree's filter: of N hits keep those where the surface is solid.
void keepSolid(const RTCFilterFunctionNArguments* args) {
    const auto& sieve = *static_cast<const Sieve*>(args->geometryUserPtr);
    const Mesh& mesh = *sieve.mesh->mesh;
    const unsigned n = args->N;
    for (unsigned i = 0; i < n; ++i) {
        if (args->valid[i] == 0)
            continue;
        const unsigned triangle = RTCHitN_primID(args->hit, n, i);
        const unsigned number = RTCHitN_geomID(args->hit, n, i);
        const float u = RTCHitN_u(args->hit, n, i), v = RTCHitN_v(args->hit, n, i);
        const std::uint32_t* index = mesh.indices.data() + 3 * std::size_t{triangle};
        const glm::vec2 uv =
            (1.0f - u - v) * mesh.uvs[index[0]] + u * mesh.uvs[index[1]] + v * mesh.uvs[index[2]];
        const glm::vec3 origin(RTCRayN_org_x(args->ray, n, i), RTCRayN_org_y(args->ray, n, i),
                               RTCRayN_org_z(args->ray, n, i));
        const glm::vec3 direction(RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i),
                                  RTCRayN_dir_z(args->ray, n, i));
        const float share = sieve.coverage.solidShareAt(uv);
        t_chance = t_chance || (share > 0.0f && share < 1.0f);
        if (chanceOf(origin, direction, number, triangle) >= share)
            args->valid[i] = 0;
    }
}

} // namespace

struct RayScene::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::size_t maxBytes = 0, triangleCount = 0;
    std::atomic<std::ptrdiff_t> bytes{0};
    JobContext job;
    ForkJoin building; // Embree calls back from oneTBB's threads
    std::vector<std::unique_ptr<Sieve>> sieves;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
        returnFreedMemory(); // Embree builds in memory of malloc's
    }
};

namespace {

// Rays per triangle above which spatial splits pay: they take 0.6 µs per triangle to build and
// save up to 0.01 µs per ray (measured).
constexpr double kRaysForHigh = 300.0;

Error refused(const BakeGeometry& geometry, RTCDevice device) {
    const RTCError code = device ? rtcGetDeviceError(device) : rtcGetDeviceError(nullptr);
    return {
        ErrorKind::Internal,
        fmt::format("There is not enough memory to trace rays through {} triangles; close other "
                    "programs or hide meshes, then bake again.",
                    geometry.triangleCount()),
        {},
        fmt::format("Embree error {}", static_cast<int>(code))};
}

// Coordinates are within 2 of the origin by construction; anything far outside is a fault.
bool traceable(const OcclusionRay& ray) {
    constexpr float kFar = 1e6f;
    const auto within = [](const glm::vec3& v) {
        return std::abs(v.x) < kFar && std::abs(v.y) < kFar && std::abs(v.z) < kFar; // NaN: false
    };
    return within(ray.origin) && within(ray.direction) &&
           (ray.direction.x != 0.0f || ray.direction.y != 0.0f || ray.direction.z != 0.0f) &&
           ray.minDistance >= 0.0f && ray.maxDistance >= 0.0f;
}

} // namespace

RayScene::RayScene(std::unique_ptr<Impl> impl)
    : m_impl(std::move(impl)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

Result<RayScene> RayScene::build(const BakeGeometry& geometry, const JobContext& job,
                                 std::size_t maxBytes, double expectedRays) {
    const RTCBuildQuality quality =
        expectedRays >= kRaysForHigh * static_cast<double>(geometry.triangleCount())
            ? RTC_BUILD_QUALITY_HIGH
            : RTC_BUILD_QUALITY_MEDIUM;
    auto impl = std::make_unique<Impl>();
    impl->maxBytes = maxBytes;
    impl->triangleCount = geometry.triangleCount();
    impl->job = job;
    impl->building.fork();
    impl->device = rtcNewDevice(nullptr);
    if (!impl->device)
        return refused(geometry, nullptr);
    rtcSetDeviceMemoryMonitorFunction(
        impl->device,
        [](void* user, ssize_t bytes, bool) {
            auto* self = static_cast<Impl*>(user);
            const ForkJoin::Branch branch(self->building);
            const std::ptrdiff_t total = self->bytes.fetch_add(bytes) + bytes;
            // Embree reports what it takes and what it gives back; only taking can be refused.
            return bytes <= 0 || self->maxBytes == 0 ||
                   total <= static_cast<std::ptrdiff_t>(self->maxBytes);
        },
        impl.get());
    impl->scene = rtcNewScene(impl->device);
    if (!impl->scene)
        return refused(geometry, impl->device);
    rtcSetSceneBuildQuality(impl->scene, quality);
    rtcSetSceneProgressMonitorFunction(
        impl->scene,
        [](void* user, double) {
            auto* self = static_cast<Impl*>(user);
            const ForkJoin::Branch branch(self->building);
            return !self->job.cancelled();
        },
        impl.get());

    for (const BakeGeometryMesh& mesh : geometry.meshes) {
        RTCGeometry triangles = rtcNewGeometry(impl->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        if (!triangles)
            return refused(geometry, impl->device);
        rtcSetGeometryBuildQuality(triangles, quality);
        rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   mesh.positions.data(), 0, sizeof(glm::vec3),
                                   mesh.positions.size());
        rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.mesh->indices.data(), 0, 3 * sizeof(std::uint32_t),
                                   mesh.mesh->triangleCount());
        if (mesh.surface.alphaMode != AlphaMode::Opaque) {
            impl->sieves.push_back(std::make_unique<Sieve>(Sieve{&mesh, Coverage(mesh.surface)}));
            rtcSetGeometryUserData(triangles, impl->sieves.back().get());
            rtcSetGeometryOccludedFilterFunction(triangles, keepSolid);
            rtcSetGeometryIntersectFilterFunction(triangles, keepSolid);
        }
        rtcCommitGeometry(triangles);
        rtcAttachGeometry(impl->scene, triangles);
        rtcReleaseGeometry(triangles);
    }
    rtcCommitScene(impl->scene);
    impl->building.join();
    if (job.cancelled())
        return bakeCancelled();
    const RTCError code = rtcGetDeviceError(impl->device);
    if (code == RTC_ERROR_CANCELLED)
        return bakeCancelled();
    if (code != RTC_ERROR_NONE)
        return Error{ErrorKind::Internal,
                     refused(geometry, impl->device).message,
                     {},
                     fmt::format("Embree error {}", static_cast<int>(code))};
    returnFreedMemory();
    return RayScene(std::move(impl));
}

std::size_t RayScene::occlude(std::span<OcclusionRay> rays) const {
    std::size_t leftOut = 0;
    for (OcclusionRay& ray : rays) {
        if (traceable(ray))
            continue;
        // A ray whose end lies before its start is valid for Embree and hits nothing.
        ray = OcclusionRay{};
        ray.maxDistance = -1.0f;
        ++leftOut;
    }
    occludeFinite(rays);
    return leftOut;
}

void RayScene::occludeFinite(std::span<OcclusionRay> rays) const {
    embree::occluded(m_impl->scene, rays);
}

std::size_t RayScene::intersect(std::span<ClosestRay> rays) const {
    std::size_t leftOut = 0;
    for (ClosestRay& closest : rays) {
        if (!traceable(closest.ray)) {
            closest = ClosestRay{};
            closest.ray.maxDistance = -1.0f;
            ++leftOut;
        }
        closest.mesh = closest.triangle = closest.instance = ClosestRay::kNothing;
    }
    embree::intersect(m_impl->scene, rays);
    return leftOut;
}

bool RayScene::takeChance() {
    return std::exchange(t_chance, false);
}

std::size_t RayScene::triangleCount() const {
    return m_impl->triangleCount;
}

std::size_t RayScene::memoryBytes() const {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(m_impl->bytes.load(), 0));
}

#if defined(__SSE2__)
FlushDenormals::FlushDenormals()
    : m_previous(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}
FlushDenormals::~FlushDenormals() {
    _mm_setcsr(m_previous);
}
#else
FlushDenormals::FlushDenormals()
    : m_previous(0) {}
FlushDenormals::~FlushDenormals() = default;
#endif

} // namespace patina
