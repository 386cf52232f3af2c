// SPDX-License-Identifier: MIT
// The outputs of a surface's vertex shader that its fragment shaders read. lavapipe sets up every declared
// input of every triangle (48 bytes and 5 to 10 ns each), whether or not a variant reads it. So the modules
// that draw scenes exist for several sets of inputs, and shared/vulkan/pipelines.cpp picks the smallest that
// has what the variant reads.
//   INPUTS 0  the normal
//          1  and the first texture coordinates
//          2  and what a normal map needs
//          3  everything
// With several samples a pixel inputs are interpolated where the fragment is shaded, so that nothing is
// extrapolated beyond its triangle's edge: shaded_normal and the others. The position is not,
// because only its derivatives are used, and the shaded places of neighbouring pixels are not a pixel apart.
#ifndef INPUTS_GLSL
#define INPUTS_GLSL

#include "shaders/lib/surface.glsl"

#ifdef STAGE_vert
#define INPUT(at, type, name) layout(location = at) out type name;
#define UNREAD(type, name)
#else
#include "shaders/lib/reversed_depth.glsl"
#include "shaders/lib/samples.glsl"
#define INPUT(at, type, name) layout(location = at) in type name;
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
INPUT(3, vec3, v_world)  // world axes, camera as origin, m: for the triangle's normal alone
#else
UNREAD(vec4, v_tangent)
UNREAD(vec3, v_world)
#endif
#if INPUTS >= 3
INPUT(4, vec4, v_color)
INPUT(5, vec3, v_irradiance)         // of the vertex lights, W/m^2
INPUT(6, vec3, v_irradiance_behind)  // and on the back of a double-sided material
#ifdef STAGE_vert
layout(location = 7) out vec2 v_slot_texcoords[SLOT_COUNT];
#else
layout(location = 7) in vec2 v_slot_texcoords[SLOT_COUNT];
#endif
#else
UNREAD(vec4, v_color)
UNREAD(vec3, v_irradiance)
UNREAD(vec3, v_irradiance_behind)
#endif

#undef INPUT
#undef UNREAD

#ifdef STAGE_frag
// From the pixel's middle.
vec2 shadedOffset() { return placeOf(uint(gl_SampleMaskIn[0])) - 0.5; }
// Inputs where the fragment is shaded, and at the pixel's middle, for differences from pixel to pixel. With
// several samples an input is never read but at an offset: Mesa 22.3 gives a plain read that follows one at
// an offset what that one got.
#define SHADED(name) (multisampled() ? interpolateAtOffset(name, shadedOffset()) : name)
#define MIDDLE(name) (multisampled() ? interpolateAtOffset(name, vec2(0.0)) : name)
#define shaded_normal SHADED(v_normal)
#define middle_normal MIDDLE(v_normal)
#if INPUTS >= 1
#define shaded_texcoord SHADED(v_texcoord)
#define middle_texcoord MIDDLE(v_texcoord)
#else
#define shaded_texcoord v_texcoord
#define middle_texcoord v_texcoord
#endif
#if INPUTS >= 2
#define shaded_tangent SHADED(v_tangent)
#define middle_tangent MIDDLE(v_tangent)
#else
#define shaded_tangent v_tangent
#endif
#if INPUTS >= 3
#define shaded_color SHADED(v_color)
#define middle_color MIDDLE(v_color)
#define shaded_irradiance SHADED(v_irradiance)
#define shaded_irradiance_behind SHADED(v_irradiance_behind)
#else
#define shaded_color v_color
#define middle_color v_color
#define shaded_irradiance v_irradiance
#define shaded_irradiance_behind v_irradiance_behind
#endif

// In pixels, like gl_FragCoord.xy, and the reversed depth there. gl_FragCoord is at the pixel's middle, or at
// the sample where each has a fragment of its own; depth is linear over a triangle.
vec2 shadedPixel() {
    return multisampled() ? floor(gl_FragCoord.xy) + placeOf(uint(gl_SampleMaskIn[0])) : gl_FragCoord.xy;
}
// At the pixel's middle.
float middleDepth() { return reversedDepth(gl_FragCoord.z); }
float fragmentDepth() {
    if (!multisampled()) return middleDepth();
    vec2 from = shadedPixel() - gl_FragCoord.xy;
    float z = gl_FragCoord.z + from.x * dFdxFine(gl_FragCoord.z) + from.y * dFdyFine(gl_FragCoord.z);
    return clamp(z, 0.0, 1.0);
}
#endif

#endif
