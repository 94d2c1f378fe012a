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

/// What callbacks are told beside ray and hit: the base of what a query hands them.
#if WEND_EMBREE == 4
using EmbreeContext = RTCRayQueryContext;
#else
using EmbreeContext = RTCIntersectContext;
#endif

inline void embree_start(EmbreeContext& context) {
#if WEND_EMBREE == 4
    rtcInitRayQueryContext(&context);
#else
    rtcInitIntersectContext(&context);
#endif
}

/// The nearest hit.
inline void embree_intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& query) {
#if WEND_EMBREE == 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &query, &arguments);
#else
    rtcIntersect1(scene, &context, &query);
#endif
}

/// Any hit: the ray's tfar becomes negative.
inline void embree_occluded(RTCScene scene, EmbreeContext& context, RTCRay& query) {
#if WEND_EMBREE == 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &query, &arguments);
#else
    rtcOccluded1(scene, &context, &query);
#endif
}

}  // namespace wend
