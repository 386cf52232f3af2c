// SPDX-License-Identifier: MIT
// The outputs of a surface's vertex shader that its fragment shaders read. lavapipe sets up every declared
// input of every triangle (48 bytes and 5 to 10 ns each), whether or not a variant reads it. So the modules
// that draw scenes exist for several sets of inputs, and shared/vulkan/pipelines.cpp picks the smallest that
// has what the variant reads.
//   INPUTS 0  the normal
//          1  and the first texture coordinates
//          2  and what a normal map needs
//          3  everything
// Inputs are interpolated at the centroid, so that with several samples a pixel nothing is extrapolated
// beyond its triangle's edge. The position is not, because only its derivatives are used, and the centroids
// of neighbouring pixels are not a pixel apart.
#ifndef INPUTS_GLSL
#define INPUTS_GLSL

#include "shaders/lib/surface.glsl"

#ifdef STAGE_vert
#define INPUT(at, type, name) layout(location = at) centroid out type name;
#define DERIVED(at, type, name) layout(location = at) out type name;
#define UNREAD(type, name)
#else
#define INPUT(at, type, name) layout(location = at) centroid in type name;
#define DERIVED(at, type, name) layout(location = at) in type name;
#define UNREAD(type, name) const type name = type(0.0);
#endif

INPUT(0, vec3, v_normal)
#if INPUTS >= 1
INPUT(1, vec2, v_texcoord)
#else
UNREAD(vec2, v_texcoord)
#endif
#if INPUTS >= 2
INPUT(2, vec4, v_tangent)
DERIVED(3, vec3, v_world)  // world axes, camera as origin, m: for the triangle's normal alone
#else
UNREAD(vec4, v_tangent)
UNREAD(vec3, v_world)
#endif
#if INPUTS >= 3
INPUT(4, vec4, v_color)
INPUT(5, vec3, v_irradiance)         // of the vertex lights, W/m^2
INPUT(6, vec3, v_irradiance_behind)  // and on the back of a double-sided material
#ifdef STAGE_vert
layout(location = 7) centroid out vec2 v_slot_texcoords[SLOT_COUNT];
#else
layout(location = 7) centroid in vec2 v_slot_texcoords[SLOT_COUNT];
#endif
#else
UNREAD(vec4, v_color)
UNREAD(vec3, v_irradiance)
UNREAD(vec3, v_irradiance_behind)
#endif

#undef INPUT
#undef DERIVED
#undef UNREAD

#endif
