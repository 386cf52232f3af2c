// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Environment and infinite haze of pixels without geometry.
#define FLAT_VIEW
#include "shaders/lib/environment/haze.glsl"
#include "shaders/lib/environment/sky.glsl"

layout(location = 0) out vec4 out_lit;

void main() {
    vec3 away = -view.backward;
    if (!on(feature_orthographic))
        away = normalized(view.direction_0 + view.direction_x * gl_FragCoord.x +
                          view.direction_y * gl_FragCoord.y);
    vec3 radiance = vec3(0.0);
    if (on(feature_environment)) radiance = skyRadiance(environmentFromWorld(away)) * environmentFactor();
    if (on(feature_haze)) {
        Hazed hazed = hazeBeyond(rayOrigin(gl_FragCoord.xy), away);
        radiance = radiance * hazed.transmittance + hazed.scattered;
    }
    out_lit = vec4(radiance, 1.0);
}
