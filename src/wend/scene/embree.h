#pragma once

/// Embree 3 or 4, whichever CMake found: what differs between them is here. Both may lie in one include folder and name
/// their functions alike, so the build says which one it links.
#if WEND_EMBREE == 4
#include <embree4/rtcore.h>
#elif WEND_EMBREE == 3
#include <embree3/rtcore.h>
#else
#error "WEND_EMBREE must be Embree's major version, 3 or 4 (CMakeLists.txt sets it for the files that include this)"
#endif

namespace wend {

/// The nearest hit.
inline void embree_intersect(RTCScene scene, RTCRayHit& query) {
#if WEND_EMBREE == 4
    rtcIntersect1(scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
#endif
}

/// Any hit: the ray's tfar becomes negative.
inline void embree_occluded(RTCScene scene, RTCRay& query) {
#if WEND_EMBREE == 4
    rtcOccluded1(scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &query);
#endif
}

}  // namespace wend
