// SPDX-License-Identifier: MIT
// KHR_materials_sheen: fibres that stand above the material (Estevez and Kulla 2017, "Production Friendly
// Microfacet Sheen BRDF"): colour x D V, without a Fresnel term. The largest component of the colour times
// E(n.v), the lobe's directional albedo, dims everything below. The extension allows this form, which
// depends on the view alone.
#ifndef SHEEN_GLSL
#define SHEEN_GLSL

#include "shaders/lib/shading/ambient.glsl"

// Values that do not depend on the light. `color` is 0 without a sheen.
struct Sheen {
    vec3 color;
    float exponent;   // 1 / alpha
    float fit[5];     // of Lambda's logarithm
    float middle;     // twice that logarithm at 0.5
    float n_dot_v;
    float lambda_v;
    float albedo;     // E(n.v); above 1 at grazing views of smooth sheens
};

// The fit's logarithm of Lambda for cosines up to 0.5.
float lambdaFit(const Sheen s, const float x) {
    float power = exp(s.fit[2] * log(max(x, 1e-37)));
    return s.fit[0] / (1.0 + s.fit[1] * power) + s.fit[3] * x + s.fit[4];
}

float sheenLambda(const Sheen s, const float cosine) {
    bool steep = cosine < 0.5;
    float fitted = lambdaFit(s, steep ? cosine : 1.0 - cosine);
    return exp(steep ? fitted : s.middle - fitted);
}

float sheenRow(const uint first, const vec4 w) {
    vec4 samples = texelFetch(albedo_pairs, int(SHEEN_TABLE_FIRST + first));
    return dot(samples, w);
}

// E(n.v) from the table of shared/contract/albedo.h.
float tabledSheen(const float roughness, const float n_dot_v, const float lambda_v) {
    float k = SHEEN_TABLE_WIDENS * roughness, smallest = sqrt(sqrt(MIN_PERCEPTUAL_ROUGHNESS));
    float x = 0.5 * (sqrt(n_dot_v * (1.0 + k) / (n_dot_v + k)) + sqrt(n_dot_v));
    float y = (sqrt(sqrt(roughness)) - smallest) / (1.0 - smallest);
    float tx, ty;
    uint column = cubicFirst(x, SHEEN_TABLE_SIZE, tx), row = cubicFirst(y, SHEEN_TABLE_SIZE, ty);
    vec4 across = cubicWeights(tx), down = cubicWeights(ty);
    uint first = row * SHEEN_TABLE_SIZE + column;
    vec4 rows = vec4(sheenRow(first, across), sheenRow(first + SHEEN_TABLE_SIZE, across),
                     sheenRow(first + 2u * SHEEN_TABLE_SIZE, across),
                     sheenRow(first + 3u * SHEEN_TABLE_SIZE, across));
    return max(dot(rows, down), 0.0) / ((1.0 + lambda_v) * 4.0 * n_dot_v);
}

Sheen makeSheen(const Surface surface, const vec3 v) {
    Sheen s;
    float roughness = max(surface.sheen_roughness, MIN_PERCEPTUAL_ROUGHNESS), alpha = roughness * roughness;
    float t = (1.0 - alpha) * (1.0 - alpha);
    s.color = surface.sheen_color;
    s.exponent = 1.0 / alpha;
    s.fit[0] = blend(21.5473, 25.3245, t);
    s.fit[1] = blend(3.82987, 3.32435, t);
    s.fit[2] = blend(0.19823, 0.16801, t);
    s.fit[3] = blend(-1.97760, -1.27393, t);
    s.fit[4] = blend(-4.32054, -4.85967, t);
    s.middle = 2.0 * lambdaFit(s, 0.5);
    s.n_dot_v = clamp(dot(surface.normal, v), MIN_N_DOT_V, 1.0);
    s.lambda_v = sheenLambda(s, s.n_dot_v);
    s.albedo = tabledSheen(roughness, s.n_dot_v, s.lambda_v);
    return s;
}

// Fraction of light that reaches what lies below.
float belowSheen(const Sheen s) {
    return max(1.0 - max(s.color.r, max(s.color.g, s.color.b)) * s.albedo, 0.0);
}

// D V n.l, 1/sr. The sine of the half vector's angle is raised to `exponent`, up to 494, so its logarithm
// must be exact near the horizon.
float sheenLobe(const Sheen s, const vec3 n, const vec3 v, const vec3 l, const float n_dot_l) {
    vec3 sum = l + v, across = crossProduct(n, sum);
    float sum2 = dot(sum, sum), up = dot(n, sum), per = 1.0 / max(sum2, 1e-20);
    float cos2 = up * up * per, sin2 = dot(across, across) * per;
    float series = 0.33333333 + cos2 * (0.25 + cos2 * (0.2 + cos2 * 0.16666667));
    series = 1.0 + cos2 * (0.5 + cos2 * series);
    float log_sin2 = cos2 < 0.1 ? -cos2 * series : log(max(sin2, 1e-30));
    float d = (2.0 + s.exponent) * exp(0.5 * s.exponent * log_sin2) * (0.5 * INVERSE_PI);
    float lobe = d / ((1.0 + s.lambda_v + sheenLambda(s, n_dot_l)) * 4.0 * s.n_dot_v);
    return n_dot_l > 0.0 && sum2 > 1e-12 ? lobe : 0.0;
}

// Radiance towards the viewer from light of the unit direction `l`. `irradiance`: W/m^2, perpendicular to
// `l`.
vec3 sheenReflected(const Sheen s, const vec3 n, const vec3 v, const vec3 l, const vec3 irradiance) {
    float n_dot_l = clamp(dot(n, l), 0.0, 1.0);
    return s.color * (sheenLobe(s, n, v, l, n_dot_l) * irradiance);
}

#endif
