// SPDX-License-Identifier: MIT
// Interpolants from a surface's vertex shader to its fragment shaders. lavapipe sets up every declared
// input of every triangle (48 bytes and 5 to 10 ns each), even if a variant does not read it.
// Specialization therefore removes inputs that the variant does not read (shared/vulkan/spirv/specialize.h).
// Under MSAA, shaded_normal and the others are interpolated at the shaded sample location, so that no
// input is extrapolated beyond its triangle. v_world is not: only its derivatives are used, and the shaded
// locations of neighbouring pixels are not one pixel apart.
// Vulkan guarantees 16 locations of four components. All inputs together use these, so the first UV set
// and the rotation of maps take the fourth components of others.
#ifndef INPUTS_GLSL
#define INPUTS_GLSL

#include "shaders/lib/surface/surface.glsl"

#ifdef STAGE_vert
#define DIRECTION out
#else
#include "shaders/lib/geometry/reversed_depth.glsl"
#include "shaders/lib/samples/samples.glsl"
#define DIRECTION in
#endif
const float MIRRORED_ROTATION = 1024.0;

#define INPUT(at) layout(location = at) DIRECTION
#define FOURTH(at) layout(location = at, component = 3) DIRECTION

INPUT(0) vec3 v_normal;
// For layers in feature_turned_maps: the tangent of their maps, along tangent and bitangent. Times
// MIRRORED_ROTATION if their bitangent has the other sign, so that interpolation keeps the two apart.
FOURTH(0) float v_rotation_cosine;
INPUT(1) vec4 v_tangent;
INPUT(2) vec3 v_world;  // world axes, camera as origin, m; only for the triangle's normal
FOURTH(2) float v_rotation_sine;
INPUT(3) vec4 v_color;
INPUT(4) vec3 v_irradiance;  // of vertex lights, W/m^2
FOURTH(4) float v_texcoord_u;
INPUT(5) vec3 v_irradiance_behind;  // the same on the back of a double-sided material
FOURTH(5) float v_texcoord_v;
INPUT(6) vec4 v_slot_texcoords[SLOT_COUNT / 2];  // of two slots each
#undef FOURTH
#undef INPUT
#undef DIRECTION

#ifdef STAGE_frag
// Offset of the shaded location from the pixel's centre, pixels.
vec2 shaded_offset = locationOf(uint(gl_SampleMaskIn[0])) - 0.5;
// Inputs at the shaded location, and at the pixel's centre for differences between pixels. Under MSAA
// every read gives an offset: in Mesa 22.3 a plain read after a read at an offset returns the value at
// that offset.
#define SHADED(name) (multisampled() ? interpolateAtOffset(name, shaded_offset) : name)
#define MIDDLE(name) (multisampled() ? interpolateAtOffset(name, vec2(0.0)) : name)
#define shaded_normal SHADED(v_normal)
#define middle_normal MIDDLE(v_normal)
#define shaded_texcoord vec2(SHADED(v_texcoord_u), SHADED(v_texcoord_v))
#define middle_texcoord vec2(MIDDLE(v_texcoord_u), MIDDLE(v_texcoord_v))
#define shaded_tangent SHADED(v_tangent)
#define middle_tangent MIDDLE(v_tangent)
#define shaded_rotation vec2(SHADED(v_rotation_cosine), SHADED(v_rotation_sine))
#define middle_rotation vec2(MIDDLE(v_rotation_cosine), MIDDLE(v_rotation_sine))
#define shaded_color SHADED(v_color)
#define middle_color MIDDLE(v_color)
#define shaded_irradiance SHADED(v_irradiance)
#define shaded_irradiance_behind SHADED(v_irradiance_behind)

// A vector of the layer's map, in the normal map's tangent space. `rotation`: shaded_rotation
// or middle_rotation.
vec3 rotatedFrom(const vec3 t, const uint layer, const vec2 rotation) {
    if ((feature_turned_maps & layer) == 0u) return t;
    bool mirrored = dot(rotation, rotation) > MIRRORED_ROTATION;
    vec2 unit = mirrored ? rotation / MIRRORED_ROTATION : rotation;
    float y = mirrored ? -t.y : t.y;
    return vec3(t.x * unit.x - y * unit.y, t.x * unit.y + y * unit.x, t.z);
}

// Shaded location in pixels, like gl_FragCoord.xy. gl_FragCoord is at the pixel's centre, or at the sample
// if each sample has its own fragment.
vec2 shadedPixel() {
    return multisampled() ? floor(gl_FragCoord.xy) + locationOf(uint(gl_SampleMaskIn[0])) : gl_FragCoord.xy;
}
// Reversed depth at the pixel's centre.
float middleDepth() { return reversedDepth(gl_FragCoord.z); }
// Reversed depth at the shaded location; depth is linear over a triangle.
float fragmentDepth() {
    if (!multisampled()) return middleDepth();
    vec2 from = shadedPixel() - gl_FragCoord.xy;
    float z = gl_FragCoord.z + from.x * dFdxFine(gl_FragCoord.z) + from.y * dFdyFine(gl_FragCoord.z);
    return clamp(z, 0.0, 1.0);
}
#endif

#endif
