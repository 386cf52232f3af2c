// SPDX-License-Identifier: MIT
// KHR_materials_transmission, _volume and _dispersion: light from opaque surfaces behind this one. A surface
// without thickness shows what is straight behind it. One with thickness stands for a slab (slab.glsl), and
// shows what the camera sees where the ray leaves it. Roughness blurs by the image's mip chain, as in
// three.js and the Khronos sample viewer.
#ifndef TRANSMISSION_GLSL
#define TRANSMISSION_GLSL

#include "shaders/lib/blending/backdrop.glsl"
#include "shaders/lib/shading/brdf.glsl"
#include "shaders/lib/shading/clearcoat.glsl"
#include "shaders/lib/shading/radiance.glsl"
#include "shaders/lib/shading/sheen.glsl"
#include "shaders/lib/shading/slab.glsl"
#include "shaders/lib/geometry/position.glsl"

// Fraction of light from behind that the specular layer does not reflect and the base neither scatters nor
// absorbs, for each component.
vec3 transmittedFraction(const Surface s, const vec3 v) {
    Brdf b = makeBrdf(s, v);
    if (hasLayer(LAYER_IRIDESCENCE)) addFilm(b, s);
    vec3 fraction = s.albedo * layeredAt(b, b.n_dot_v).base;
    if (hasLayer(LAYER_SHEEN)) fraction *= belowSheen(makeSheen(s, v));
    if (hasLayer(LAYER_CLEARCOAT)) fraction *= 1.0 - clearcoatWeight(s, v);
    return clamp(fraction * (s.transmission * (1.0 - s.metallic)), vec3(0.0), vec3(1.0));
}

// The pixel that shows a position; `here` for one behind the camera. The inverse of positionFromDepth().
vec2 pixelOf(vec3 position, const vec2 here) {
    vec3 right = view.direction_x, down = view.direction_y, from = view.direction_0;
    if (on(feature_orthographic)) {
        right = view.origin_x, down = view.origin_y, from = view.origin_0;
    } else {
        vec3 ahead = crossProduct(right, down);
        float depth = dot(position, ahead) / dot(from, ahead);
        if (!(depth > 0.0)) return here;
        position /= depth;
    }
    vec3 offset = position - from;
    return vec2(dot(offset, right) / dot(right, right), dot(offset, down) / dot(down, down));
}

// The pixel where the ray that enters a surface shows the light behind. `pixel`: of the surface.
vec2 pixelBehind(const Surface s, const vec3 v, const float ior, const vec2 pixel) {
    vec2 shifted = pixelOf(s.position + slabShift(s, v, ior), pixel);
    return s.thickness > 0.0 ? shifted : pixel;
}

// Radiance behind the surface, W/(sr m^2). `pixel`: of the surface. No branch depends on the material alone,
// because lavapipe would compile such a shader again at every draw.
vec3 lightBehind(const Surface s, const vec3 v, const vec2 pixel) {
    bool spreads = s.dispersion > 0.0 && s.ior > 0.0;
    float level = s.roughness * (log(float(textureSize(backdrop, 0).x)) * 1.44269504);
    level *= s.ior > 0.0 ? clamp(2.0 * s.ior - 2.0, 0.0, 1.0) : 1.0;
    // The F line's index exceeds the C line's by (ior - 1) / Abbe number; dispersion is 20 / Abbe number.
    float half_spread = spreads ? (s.ior - 1.0) * 0.025 * s.dispersion : 0.0;
    float smallest = spreads ? max(s.ior - half_spread, 1.0) : s.ior;
    vec2 red = pixelBehind(s, v, smallest, pixel), green = pixelBehind(s, v, s.ior, pixel);
    vec2 blue = pixelBehind(s, v, s.ior + half_spread, pixel);
    vec3 behind = backdropAt(green, level);
    if (red != blue) behind = vec3(backdropAt(red, level).r, behind.g, backdropAt(blue, level).b);
    return behind;
}

// Adds the light behind to a surface's own. The light behind has its own haze, so that the haze in front
// counts for the fraction that the surface hides.
Radiance withTransmission(const Surface s, Radiance radiance, const vec2 pixel) {
    float covers = s.coverage;
    vec3 v = viewVector(s.position);
    vec3 through = transmittedFraction(s, v) * crossing(s);
    radiance.behind = through * lightBehind(s, v, pixel) * covers;
    radiance.transmission = radiance.behind;
    radiance.diffuse *= covers;
    radiance.specular *= covers;
    radiance.ambient *= covers;
    radiance.emission *= covers;
    radiance.haze *= (1.0 - through) * covers;
    radiance.behind += texelFetch(backdrop, ivec2(pixel), 0).rgb * (1.0 - covers);
    return radiance;
}

#endif
