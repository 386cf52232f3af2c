// SPDX-License-Identifier: MIT
// The outputs of a surface's vertex shader that its fragment shaders read. lavapipe sets up every declared
// input of every triangle (48 bytes and 5 to 10 ns each), whether or not a variant reads it; a pipeline has
// those alone that its variant reads (shared/vulkan/specialize.h).
// With several samples a pixel inputs are interpolated where the fragment is shaded, so that nothing is
// extrapolated beyond its triangle's edge: shaded_normal and the others. The position is not,
// because only its derivatives are used, and the shaded places of neighbouring pixels are not a pixel apart.
#ifndef INPUTS_GLSL
#define INPUTS_GLSL

#include "shaders/lib/surface.glsl"

#ifdef STAGE_vert
#define INPUT(at) layout(location = at) out
#else
#include "shaders/lib/reversed_depth.glsl"
#include "shaders/lib/samples.glsl"
#define INPUT(at) layout(location = at) in
#endif

INPUT(0) vec3 v_normal;
INPUT(1) vec2 v_texcoord;
INPUT(2) vec4 v_tangent;
INPUT(3) vec3 v_world;  // world axes, camera as origin, m: for the triangle's normal alone
INPUT(4) vec4 v_color;
INPUT(5) vec3 v_irradiance;         // of the vertex lights, W/m^2
INPUT(6) vec3 v_irradiance_behind;  // and on the back of a double-sided material
INPUT(7) vec2 v_slot_texcoords[SLOT_COUNT];
#undef INPUT

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
#define shaded_texcoord SHADED(v_texcoord)
#define middle_texcoord MIDDLE(v_texcoord)
#define shaded_tangent SHADED(v_tangent)
#define middle_tangent MIDDLE(v_tangent)
#define shaded_color SHADED(v_color)
#define middle_color MIDDLE(v_color)
#define shaded_irradiance SHADED(v_irradiance)
#define shaded_irradiance_behind SHADED(v_irradiance_behind)

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
