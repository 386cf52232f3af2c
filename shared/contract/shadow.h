// SPDX-License-Identifier: MIT
// Shadow maps of the sun: the brightest shadow-casting directional light. Light space has the camera as
// origin, x and y across the light, and z towards it. Its axes are unit vectors, so distances are in
// metres. A map's depth grows towards the light: 1 at the nearest caster, 0 at the scene's far end and
// where nothing casts.
#ifndef DIPTYCH_CONTRACT_SHADOW_H
#define DIPTYCH_CONTRACT_SHADOW_H

#include "types.h"

CONTRACT_BEGIN

// Values of FEATURE_shadows: how visibility of the sun is computed.
CONTRACT_CONST(uint, SHADOWS_NONE, 0);
CONTRACT_CONST(uint, SHADOWS_PCF, 1);      // filtered depth comparisons
CONTRACT_CONST(uint, SHADOWS_EVSM, 2);     // two moments of exponentially warped depth
CONTRACT_CONST(uint, SHADOWS_CLIPMAP, 3);  // filtered comparisons with the pages of clipmap.h
CONTRACT_CONST(uint, SHADOWS_EVSM4, 4);    // two moments of depth warped in both directions
CONTRACT_CONST(uint, SHADOWS_MSM4, 5);     // four moments of depth
CONTRACT_CONST(uint, SHADOWS_PCSS, 6);     // filter radius from the size of the sun's disc

CONTRACT_CONST(uint, MAX_CASCADES, 4);

// Shared by all cascades.
struct ShadowLight {
    vec3 x;             // axes of light space, world
    float depth_scale;  // 1/m: depth = z * depth_scale + depth_offset
    vec3 y;
    float depth_offset;
    vec3 to_light;   // z
    float rounding;  // rounding error of positions relative to their distance from the camera
    vec4 ends;       // view depth where each cascade ends, m; no shadow beyond the last
    vec4 fades;      // view depth where each cascade begins to blend into the next, m
    vec3 forward;    // unit; view direction, along which view depth is measured
    uint light;      // index of the shadow-casting directional light
    // Moments:
    float exponent;      // of the warp exp(exponent * depth), with depth growing away from the light
    float nearest;       // smallest warped depth: 0 or -1; the largest is 1
    float bleed;         // visibility that is attributed to light bleeding and removed, 0 to 1
    float min_variance;  // of depth, relative to the range squared
    float negative;      // exponent of the second warp, -exp(-negative * depth)
    float moment_bias;   // blend weight towards the moments of two halves at the ends of the range, for
                         // four moments
    // Percentage-closer soft shadows:
    float disc;    // tangent of half the sun's angular diameter
    float widest;  // texels; largest search and filter size
};

#define SHADOW_LIGHT_OF_TEXELS(a, b, c, d, e, f, g, h)                                                     \
    ShadowLight(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, d, e, f.xyz, floatBitsToUint(f.w), g.x, g.y, g.z, g.w, \
                h.x, h.y, h.z, h.w)
CONTRACT_LANE(ShadowLight, x, 0, 0);
CONTRACT_LANE(ShadowLight, y, 1, 0);
CONTRACT_LANE(ShadowLight, to_light, 2, 0);
CONTRACT_LANE(ShadowLight, ends, 3, 0);
CONTRACT_LANE(ShadowLight, fades, 4, 0);
CONTRACT_LANE(ShadowLight, forward, 5, 0);
CONTRACT_LANE(ShadowLight, light, 5, 3);
CONTRACT_LANE(ShadowLight, exponent, 6, 0);
CONTRACT_LANE(ShadowLight, negative, 7, 0);
CONTRACT_TEXELS(ShadowLight, 8);
CONTRACT_CONST(uint, SHADOW_LIGHT_TEXELS, 8);

// One layer of the map. Texel (i, j) covers [i, i + 1) x [j, j + 1) in the coordinates (x, y) *
// texels_per_metre + offset of light space.
struct Cascade {
    vec2 offset;  // texels
    float texels_per_metre;
    float bias;  // texels, along the geometric normal
};
#define CASCADE_OF_TEXEL(a) Cascade(a.xy, a.z, a.w)
CONTRACT_LANE(Cascade, offset, 0, 0);
CONTRACT_LANE(Cascade, texels_per_metre, 0, 2);
CONTRACT_LANE(Cascade, bias, 0, 3);
CONTRACT_TEXELS(Cascade, 1);

// Push constants of the compute shaders that generate moments, one layer per dispatch.
struct MomentConstants {
    uint size;       // texels along a side
    uint down;       // blur direction: 0 horizontal, 1 vertical
    float exponent;  // as in ShadowLight
    float negative;
    float nearest;
};
CONTRACT_CONST(uint, MOMENT_THREADS, 64);  // threads of a workgroup, along a row
CONTRACT_CONST(uint, BLUR_RUN, 8);         // consecutive texels that one thread blurs

// Smallest and largest reversed depth of an image, as the bits of floats, whose order is that of the
// values. DEEPEST_OF_NOTHING and 0 if nothing is drawn.
struct DepthBounds {
    uint deepest;
    uint nearest;
};
CONTRACT_CONST(uint, DEEPEST_OF_NOTHING, 0xffffffffu);
CONTRACT_CONST(uint, DEPTH_BOUNDS_ROWS, 16);  // rows of the image that one thread reads, two columns wide

CONTRACT_END

// SET_MOMENTS and SET_DEPTH_BOUNDS of those compute shaders.
// clang-format off
#define MOMENT_BINDINGS(X)                                                       \
    X(0, MOMENT_SOURCE, image,         "depth, or moments: an array of one layer") \
    X(1, MOMENT_TARGET, storage_image, "moments: an array of one layer")

#define DEPTH_BOUNDS_BINDINGS(X)                                                 \
    X(0, BOUNDED_DEPTH, image,          "reversed depth of the picture")         \
    X(1, DEPTH_BOUNDS,  storage_buffer, "DepthBounds")
// clang-format on

CONTRACT_BEGIN
CONTRACT_CONST(uint, SET_MOMENTS, 0);
CONTRACT_CONST(uint, SET_DEPTH_BOUNDS, 0);
MOMENT_BINDINGS(CONTRACT_BINDING)
DEPTH_BOUNDS_BINDINGS(CONTRACT_BINDING)
CONTRACT_END

#endif
