// SPDX-License-Identifier: MIT
// Exponential variance shadow maps (Lauritzen and McCool 2008, "Layered Variance Shadow Maps", section 5): a
// map's texel holds the mean of w and of w^2 over the filter, w = exp(c d) of the depth d that grows away
// from the light; with four moments also those of -exp(-k d), whose bound fails elsewhere. A planar
// receiver's own depths never shadow it: the mean of a convex function is no less than the function of the
// mean.
#ifndef MOMENTS_GLSL
#define MOMENTS_GLSL

#include "shaders/lib/contract.glsl"

// `depth`: as in the map, 1 towards the light. The result grows away from it, from `nearest` (0 or -1) to 1.
float depthAway(float depth, float nearest) { return blend(nearest, 1.0, 1.0 - shareOf(depth)); }

// The moments of one depth; the last two for feature_shadows = SHADOWS_EVSM4.
vec4 warpedMoments(float depth, float exponent, float negative, float nearest) {
    float away = depthAway(depth, nearest);
    float w = exp(exponent * away), n = -exp(-negative * away);
    return vec4(w, w * w, n, n * n);
}

// The largest share of a distribution that may lie `behind` or more above its mean, all three in one unit
// (Chebyshev's inequality, one-sided; Donnelly and Lauritzen 2006, "Variance Shadow Maps", equation 5).
float chebyshev(float behind, float variance) {
    return behind > 0.0 ? variance / (variance + behind * behind) : 1.0;
}

// The largest share of the filter that may lie at or behind `depth`, less what is taken for bled light. In
// units of the receiver's w, and of the mean of the other warp: so nothing leaves the range of float32.
float momentVisibility(vec4 moments, float depth, ShadowLight light) {
    const float MOST = 1e30;  // of a variance
    float away = depthAway(depth, light.nearest), range = 1.0 - light.nearest;
    float per_w = exp(-light.exponent * away), mean = moments.x * per_w, square = moments.y * per_w * per_w;
    // A variance of depth, as one of w: dw = c (1 - nearest) w dd.
    float slope = light.exponent * range;
    float variance = max(square - mean * mean, light.min_variance * slope * slope);
    float share = chebyshev(1.0 - mean, min(variance, MOST));
    if (feature_shadows == SHADOWS_EVSM4) {
        float per_mean = 1.0 / moments.z, n = -exp(-light.negative * away) * per_mean;
        slope = light.negative * range * n;
        variance = max(moments.w * per_mean * per_mean - 1.0, light.min_variance * slope * slope);
        share = min(share, chebyshev(1.0 - n, min(variance, MOST)));
    }
    return shareOf((share - light.bleed) / (1.0 - light.bleed));
}

#endif
