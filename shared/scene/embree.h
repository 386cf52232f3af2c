// SPDX-License-Identifier: MIT
// One interface to ray queries with a hit filter for Embree 3 (Debian 12) and 4 (Debian 13, Ubuntu 24.04).
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace diptych {

#if RTC_VERSION_MAJOR >= 4

// Must be the first member of a query's data: Embree passes the filter a pointer to it.
using EmbreeContext = RTCRayQueryContext;
constexpr RTCSceneFlags embree_filter_flag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

// Writes the nearest hit that the filter accepts to `request`.
inline void embreeIntersect(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter,
                            RTCRayHit& request) {
    rtcInitRayQueryContext(&context);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
    arguments.context = &context;
    arguments.filter = filter;
    rtcIntersect1(scene, &request, &arguments);
}

// Whether the filter accepts any hit.
inline bool embreeOccluded(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter, RTCRay ray) {
    rtcInitRayQueryContext(&context);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
    arguments.context = &context;
    arguments.filter = filter;
    rtcOccluded1(scene, &ray, &arguments);
    return ray.tfar < 0;
}

#else

using EmbreeContext = RTCIntersectContext;
constexpr RTCSceneFlags embree_filter_flag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void embreeIntersect(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter,
                            RTCRayHit& request) {
    rtcInitIntersectContext(&context);
    context.filter = filter;
    rtcIntersect1(scene, &context, &request);
}

inline bool embreeOccluded(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter, RTCRay ray) {
    rtcInitIntersectContext(&context);
    context.filter = filter;
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0;
}

#endif

}  // namespace diptych
