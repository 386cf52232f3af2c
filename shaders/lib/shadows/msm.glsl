// SPDX-License-Identifier: MIT
// Moment shadow maps (Peters and Klein 2015, "Moment Shadow Mapping"). A texel stores the filtered means
// of d, d^2, d^3 and d^4; depth d grows away from the light from 0 to 1. The distribution with these
// moments that shadows least has a closed form.
#ifndef MSM_GLSL
#define MSM_GLSL

#include "shaders/lib/shadows/evsm.glsl"
#include "shaders/lib/shadows/hamburger.glsl"

// Section 4.3 of the paper: the affine map that uses 16 bits best, 0 to 1 for each moment; and its
// inverse.
vec4 quantisedMoments(const float depth) {
    const mat4 quantise = mat4(-2.07224649, 13.7948857237, 0.105877704, 9.7924062118,       //
                               32.23703778, -59.4683975703, -1.9077466311, -33.7652110555,  //
                               -68.571074599, 82.0359750338, 9.3496555107, 47.9456096605,   //
                               39.3703274134, -35.364903257, -6.6543490743, -23.9728048165);
    float d = depthAway(depth, 0.0), d2 = d * d;
    return quantise * vec4(d, d2, d * d2, d2 * d2) + vec4(0.035955884801, 0.0, 0.0, 0.0);
}
vec4 momentsOfQuantised(const vec4 q) {
    const mat4 back = mat4(0.2227744146, 0.1549679261, 0.1451988946, 0.163127443,    //
                           0.0771972861, 0.1394629426, 0.2120202157, 0.2591432266,   //
                           0.7926986636, 0.7963415838, 0.7258694464, 0.6539092497,   //
                           0.0319417555, -0.1722823173, -0.2758014811, -0.3376131734);
    return back * (q - vec4(0.035955884801, 0.0, 0.0, 0.0));
}

// Smallest fraction of the filter that may lie in front of `depth` (Peters and Klein, algorithm 3,
// "Hamburger 4MSM"). A distribution on three points attains it. `bias` moves the moments, by more than
// their rounding, towards a distribution whose Hankel matrix is far from singular. The result is in [0, 1]
// for any moments.
float min4MomentShadow(const vec4 moments, const float depth, const float bias) {
    return fractionOf(threeDepths(moments * (1.0 - bias) + vec4(0.5 * bias), depth, 1e-9).before);
}

// Visibility of a receiver at `depth` (as in the map), from the moments of feature_shadows.
float visibilityOfMoments(const vec4 moments, const float depth, const ShadowLight light) {
    if (feature_shadows != SHADOWS_MSM4) return momentVisibility(moments, depth, light);
    return 1.0 - min4MomentShadow(momentsOfQuantised(moments), depthAway(depth, 0.0), light.moment_bias);
}

#endif
