// SPDX-License-Identifier: MIT
// Shadow maps of the sun: the brightest directional light, which casts shadows. Light space has the camera as
// its origin, x and y across the light, z towards it; all three axes are unit vectors, so that distances are
// metres. A map's depth grows towards the light: 1 at the caster that is nearest to it, 0 where the
// scene ends, and where nothing casts.
#ifndef DIPTYCH_CONTRACT_SHADOW_H
#define DIPTYCH_CONTRACT_SHADOW_H

#include "types.h"

CONTRACT_BEGIN

// Values of FEATURE_shadows: how the sun's visibility is found.
CONTRACT_CONST(uint, SHADOWS_NONE, 0);
CONTRACT_CONST(uint, SHADOWS_PCF, 1);      // filtered comparisons with depth
CONTRACT_CONST(uint, SHADOWS_EVSM, 2);     // two moments of exponentially warped depth
CONTRACT_CONST(uint, SHADOWS_CLIPMAP, 3);  // filtered comparisons with the pages of clipmap.h
CONTRACT_CONST(uint, SHADOWS_EVSM4, 4);    // two moments of depth warped in both directions
CONTRACT_CONST(uint, SHADOWS_MSM4, 5);     // four moments of depth
CONTRACT_CONST(uint, SHADOWS_PCSS, 6);     // comparisons over as much as the sun's disc blurs

CONTRACT_CONST(uint, MAX_CASCADES, 4);

// What all cascades share.
struct ShadowLight {
    vec3 x;             // light space's axes, world
    float depth_scale;  // 1/m: depth = z * depth_scale + depth_offset
    vec3 y;
    float depth_offset;
    vec3 to_light;   // z
    float rounding;  // of positions: a share of their distance from the camera
    vec4 ends;       // view depth where each cascade ends, m; beyond the last nothing is shadowed
    vec4 fades;      // view depth where each begins to blend into the next, m
    vec3 forward;    // unit, in which the camera looks: view depth is along it
    uint light;      // number of the directional light that casts
    // Of moments.
    float exponent;      // of the warp, exp(exponent * depth), with depth growing away from the light
    float nearest;       // the least depth that is warped: 0 or -1; the farthest is 1
    float bleed;         // of the visibility this much is taken for light that bled through, 0 to 1
    float min_variance;  // of depth, a share of the range squared
    float negative;      // exponent of the other warp, -exp(-negative * depth)
    float moment_bias;   // of four moments this much is taken for those of a half at each end of the range
    // Of percentage-closer soft shadows.
    float disc;    // of the sun: the tangent of half its angle
    float widest;  // texels, of what is searched and filtered
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

// One layer of the map. Its texel (i, j) covers [i, i + 1) x [j, j + 1) of the coordinates
// (x, y) * texels_per_metre + offset of light space.
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

// Push constants of the kernels that make moments: one layer at a time.
struct MomentConstants {
    uint size;       // texels of a side
    uint down;       // blur: 0 across, 1 down
    float exponent;  // as in ShadowLight
    float negative;
    float nearest;
};
CONTRACT_CONST(uint, MOMENT_THREADS, 64);  // of a workgroup, side by side
CONTRACT_CONST(uint, BLUR_RUN, 8);         // texels that a thread blurs, one after the other

// What the kernel that finds the least and the largest depth of a picture leaves: reversed depths as the bits
// of floats, which order as the values do. Where nothing is drawn, DEEPEST_OF_NOTHING and 0.
struct DepthBounds {
    uint deepest;
    uint nearest;
};
CONTRACT_CONST(uint, DEEPEST_OF_NOTHING, 0xffffffffu);
CONTRACT_CONST(uint, DEPTH_BOUNDS_ROWS, 16);  // of the picture that one thread reads, two columns wide

CONTRACT_END

// What those kernels bind, as SET_MOMENTS and as SET_DEPTH_BOUNDS.
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
#define DIPTYCH_BINDING_NUMBER(number, name, kind, what) CONTRACT_CONST(uint, BINDING_##name, number);
MOMENT_BINDINGS(DIPTYCH_BINDING_NUMBER)
DEPTH_BOUNDS_BINDINGS(DIPTYCH_BINDING_NUMBER)
#undef DIPTYCH_BINDING_NUMBER
CONTRACT_END

#endif
