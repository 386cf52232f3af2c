// SPDX-License-Identifier: MIT
// Haze in front of a surface or the background. Each surface evaluates it once, at its own position.
#ifndef HAZE_GLSL
#define HAZE_GLSL

#include "shaders/lib/environment/air.glsl"
#include "shaders/lib/geometry/position.glsl"

layout(set = SET_FRAME, binding = BINDING_HAZE) uniform samplerBuffer haze_texels;

vec4 hazeTexel(const uint i) { return texelFetch(haze_texels, int(i)); }

// Only ambient light and ray marching use the last texel.
Haze readHaze() {
    vec4 a = hazeTexel(0), b = hazeTexel(1), c = hazeTexel(2), d = hazeTexel(3), e = vec4(0.0);
    if (on(feature_haze & (HAZE_AMBIENT | HAZE_MARCHED))) e = hazeTexel(4);
    return HAZE_OF_TEXELS(a, b, c, d, e);
}
HazeMarch readHazeMarch() {
    vec4 a = hazeTexel(HAZE_TEXELS), b = hazeTexel(HAZE_TEXELS + 1), c = hazeTexel(HAZE_TEXELS + 2);
    return HAZE_MARCH_OF_TEXELS(a, b, c);
}

// Haze between the camera and `position` (world axes, camera as origin, m).
Hazed hazeTo(const vec3 position) {
    Haze h = readHaze();
    float reach, height = h.camera_height, rise = position.y;
    vec3 away;
    if (on(feature_orthographic)) {
        away = -view.backward;
        reach = dot(position, away);
        rise = away.y * reach;
        height += position.y - rise;
    } else {
        reach = lengthOf(position);
        away = normalizedOfAnySize(position);
    }
    if (on(feature_haze & HAZE_MARCHED))
        return marchedHaze(h, readHazeMarch(), height, away, reach, false);
    return hazeOfAir(h, airAlong(height, rise, reach, h.inverse_height), away);
}

// Haze in front of the background along a ray from `origin` (camera as origin, m); `away`: unit.
Hazed hazeBeyond(const vec3 origin, const vec3 away) {
    Haze h = readHaze();
    float height = h.camera_height + origin.y;
    if (on(feature_haze & HAZE_MARCHED)) return marchedHaze(h, readHazeMarch(), height, away, 0.0, true);
    return hazeOfAir(h, airBeyond(height, away.y, h.inverse_height), away);
}

#endif
