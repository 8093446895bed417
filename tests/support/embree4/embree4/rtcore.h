// What Patina uses of Embree 4, as its documentation declares it: where only Embree 3 is installed,
// core/trace is compiled against this as well, so that an edit cannot break the other. Nothing here
// is linked or run.
#pragma once

#include <cstddef>
#include <sys/types.h>

using RTCDevice = struct RTCDeviceTy*;
using RTCScene = struct RTCSceneTy*;
using RTCGeometry = struct RTCGeometryTy*;

enum RTCError { RTC_ERROR_NONE = 0, RTC_ERROR_CANCELLED = 6 };
enum RTCFormat { RTC_FORMAT_UINT3 = 0x5003, RTC_FORMAT_FLOAT3 = 0x9003 };
enum RTCBuildQuality { RTC_BUILD_QUALITY_MEDIUM = 1, RTC_BUILD_QUALITY_HIGH = 2 };
enum RTCBufferType { RTC_BUFFER_TYPE_INDEX = 0, RTC_BUFFER_TYPE_VERTEX = 1 };
enum RTCGeometryType { RTC_GEOMETRY_TYPE_TRIANGLE = 0 };

constexpr unsigned RTC_INVALID_GEOMETRY_ID = ~0u;

struct alignas(16) RTCRay {
    float org_x, org_y, org_z, tnear;
    float dir_x, dir_y, dir_z, time;
    float tfar;
    unsigned mask, id, flags;
};
struct alignas(16) RTCHit {
    float Ng_x, Ng_y, Ng_z, u, v;
    unsigned primID, geomID, instID[1], instPrimID[1];
};
struct RTCRayHit {
    RTCRay ray;
    RTCHit hit;
};
struct RTCRayN;
struct RTCHitN;
struct RTCRayQueryContext;
struct RTCFilterFunctionNArguments {
    int* valid;
    void* geometryUserPtr;
    RTCRayQueryContext* context;
    RTCRayN* ray;
    RTCHitN* hit;
    unsigned N;
};
struct RTCIntersectArguments;
struct RTCOccludedArguments;

using RTCMemoryMonitorFunction = bool (*)(void*, ssize_t, bool);
using RTCProgressMonitorFunction = bool (*)(void*, double);
using RTCFilterFunctionN = void (*)(const RTCFilterFunctionNArguments*);

RTCDevice rtcNewDevice(const char* config);
void rtcReleaseDevice(RTCDevice device);
RTCError rtcGetDeviceError(RTCDevice device);
void rtcSetDeviceMemoryMonitorFunction(RTCDevice device, RTCMemoryMonitorFunction function,
                                       void* user);

RTCScene rtcNewScene(RTCDevice device);
void rtcReleaseScene(RTCScene scene);
void rtcSetSceneBuildQuality(RTCScene scene, RTCBuildQuality quality);
void rtcSetSceneProgressMonitorFunction(RTCScene scene, RTCProgressMonitorFunction function,
                                        void* user);
void rtcCommitScene(RTCScene scene);

RTCGeometry rtcNewGeometry(RTCDevice device, RTCGeometryType type);
void rtcReleaseGeometry(RTCGeometry geometry);
void rtcSetGeometryBuildQuality(RTCGeometry geometry, RTCBuildQuality quality);
void rtcSetSharedGeometryBuffer(RTCGeometry geometry, RTCBufferType type, unsigned slot,
                                RTCFormat format, const void* data, std::size_t offset,
                                std::size_t stride, std::size_t count);
void rtcSetGeometryUserData(RTCGeometry geometry, void* user);
void rtcSetGeometryOccludedFilterFunction(RTCGeometry geometry, RTCFilterFunctionN filter);
void rtcSetGeometryIntersectFilterFunction(RTCGeometry geometry, RTCFilterFunctionN filter);
void rtcCommitGeometry(RTCGeometry geometry);
unsigned rtcAttachGeometry(RTCScene scene, RTCGeometry geometry);

float& RTCRayN_org_x(RTCRayN* ray, unsigned n, unsigned i);
float& RTCRayN_org_y(RTCRayN* ray, unsigned n, unsigned i);
float& RTCRayN_org_z(RTCRayN* ray, unsigned n, unsigned i);
float& RTCRayN_dir_x(RTCRayN* ray, unsigned n, unsigned i);
float& RTCRayN_dir_y(RTCRayN* ray, unsigned n, unsigned i);
float& RTCRayN_dir_z(RTCRayN* ray, unsigned n, unsigned i);
unsigned& RTCHitN_primID(RTCHitN* hit, unsigned n, unsigned i);
unsigned& RTCHitN_geomID(RTCHitN* hit, unsigned n, unsigned i);
float& RTCHitN_u(RTCHitN* hit, unsigned n, unsigned i);
float& RTCHitN_v(RTCHitN* hit, unsigned n, unsigned i);

void rtcIntersect1(RTCScene scene, RTCRayHit* ray, RTCIntersectArguments* arguments = nullptr);
void rtcOccluded1(RTCScene scene, RTCRay* ray, RTCOccludedArguments* arguments = nullptr);
