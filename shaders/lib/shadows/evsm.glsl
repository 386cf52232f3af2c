// SPDX-License-Identifier: MIT
// Exponential variance shadow maps (Lauritzen and McCool 2008, "Layered Variance Shadow Maps", section 5).
// A texel stores the filtered means of w and w^2, where w = exp(c d) and depth d grows away from the
// light. Four moments add those of -exp(-k d), whose bound fails in other places. A planar receiver never
// shadows itself: the mean of a convex function is at least the function of the mean.
#ifndef EVSM_GLSL
#define EVSM_GLSL

#include "shaders/lib/contract.glsl"

// `depth`: as in the map, 1 towards the light. The result grows away from the light, from `nearest` (0 or
// -1) to 1.
float depthAway(const float depth, const float nearest) {
    return blend(nearest, 1.0, 1.0 - fractionOf(depth));
}

// Moments of one depth; the last two are for feature_shadows = SHADOWS_EVSM4.
vec4 warpedMoments(const float depth, const float exponent, const float negative, const float nearest) {
    float away = depthAway(depth, nearest);
    float w = exp(exponent * away), n = -exp(-negative * away);
    return vec4(w, w * w, n, n * n);
}

// Largest fraction of a distribution that may lie `behind` or more above its mean; all in one unit
// (one-sided Chebyshev inequality; Donnelly and Lauritzen 2006, "Variance Shadow Maps", equation 5).
float chebyshev(const float behind, const float variance) {
    return behind > 0.0 ? variance / (variance + behind * behind) : 1.0;
}

// Largest fraction of the filter that may lie at or behind `depth`, after light-bleeding reduction. In
// units of the receiver's w, or of the other warp's mean, so that no value leaves the range of float32.
float momentVisibility(const vec4 moments, const float depth, const ShadowLight light) {
    const float LARGEST = 1e30;  // of a variance
    float away = depthAway(depth, light.nearest), range = 1.0 - light.nearest;
    float per_w = exp(-light.exponent * away), mean = moments.x * per_w, square = moments.y * per_w * per_w;
    // Converts a variance of depth to one of w: dw = c (1 - nearest) w dd.
    float slope = light.exponent * range;
    float variance = max(square - mean * mean, light.min_variance * slope * slope);
    float fraction = chebyshev(1.0 - mean, min(variance, LARGEST));
    if (feature_shadows == SHADOWS_EVSM4) {
        float per_mean = 1.0 / moments.z, n = -exp(-light.negative * away) * per_mean;
        slope = light.negative * range * n;
        variance = max(moments.w * per_mean * per_mean - 1.0, light.min_variance * slope * slope);
        fraction = min(fraction, chebyshev(1.0 - n, min(variance, LARGEST)));
    }
    return fractionOf((fraction - light.bleed) / (1.0 - light.bleed));
}

#endif
