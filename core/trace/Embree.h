// Embree 3 and 4 as one: the calls that differ between them. Only RayScene.cpp includes this.
//
// Embree 3 has streams of rays, and puts an intersect context beside each call; Embree 4 knows rays
// one by one (and packets), takes incoherent ones unless told otherwise, and its hits are larger
// when it is built with arrays of instances.
#pragma once

#include "core/trace/RayScene.h"

#include <cstddef>
#include <span>

#if PATINA_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace patina::embree {

static_assert(sizeof(OcclusionRay) == sizeof(RTCRay) && alignof(OcclusionRay) == alignof(RTCRay));
static_assert(offsetof(OcclusionRay, minDistance) == offsetof(RTCRay, tnear));
static_assert(offsetof(OcclusionRay, direction) == offsetof(RTCRay, dir_x));
static_assert(offsetof(OcclusionRay, maxDistance) == offsetof(RTCRay, tfar));
static_assert(offsetof(OcclusionRay, flags) == offsetof(RTCRay, flags));
static_assert(ClosestRay::kNothing == RTC_INVALID_GEOMETRY_ID);

inline RTCRay* asEmbree(OcclusionRay* ray) {
    return reinterpret_cast<RTCRay*>(ray);
}

#if PATINA_EMBREE == 4

inline void occluded(RTCScene scene, std::span<OcclusionRay> rays) {
    for (OcclusionRay& ray : rays)
        rtcOccluded1(scene, asEmbree(&ray));
}

inline void intersect(RTCScene scene, std::span<ClosestRay> rays) {
    for (ClosestRay& closest : rays) {
        RTCRayHit traced{};
        traced.ray = *asEmbree(&closest.ray);
        traced.hit.geomID = traced.hit.primID = traced.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &traced);
        *asEmbree(&closest.ray) = traced.ray;
        closest.geometricNormal = {traced.hit.Ng_x, traced.hit.Ng_y, traced.hit.Ng_z};
        closest.u = traced.hit.u;
        closest.v = traced.hit.v;
        closest.triangle = traced.hit.primID;
        closest.mesh = traced.hit.geomID;
    }
}

#else

static_assert(sizeof(ClosestRay) == sizeof(RTCRayHit) && alignof(ClosestRay) == alignof(RTCRayHit));
static_assert(offsetof(ClosestRay, geometricNormal) == offsetof(RTCRayHit, hit.Ng_x));
static_assert(offsetof(ClosestRay, u) == offsetof(RTCRayHit, hit.u));
static_assert(offsetof(ClosestRay, triangle) == offsetof(RTCRayHit, hit.primID));
static_assert(offsetof(ClosestRay, mesh) == offsetof(RTCRayHit, hit.geomID));

// Below this many rays Embree's stream code costs more than it saves (measured).
inline constexpr std::size_t kMinStream = 32;

inline RTCIntersectContext incoherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

inline void occluded(RTCScene scene, std::span<OcclusionRay> rays) {
    RTCIntersectContext context = incoherent();
    RTCRay* first = asEmbree(rays.data());
    if (rays.size() >= kMinStream)
        rtcOccluded1M(scene, &context, first, static_cast<unsigned>(rays.size()), sizeof(RTCRay));
    else
        for (std::size_t i = 0; i < rays.size(); ++i)
            rtcOccluded1(scene, &context, first + i);
}

inline void intersect(RTCScene scene, std::span<ClosestRay> rays) {
    RTCIntersectContext context = incoherent();
    auto* first = reinterpret_cast<RTCRayHit*>(rays.data());
    if (rays.size() >= kMinStream)
        rtcIntersect1M(scene, &context, first, static_cast<unsigned>(rays.size()),
                       sizeof(RTCRayHit));
    else
        for (std::size_t i = 0; i < rays.size(); ++i)
            rtcIntersect1(scene, &context, first + i);
}

#endif

} // namespace patina::embree
