// SPDX-License-Identifier: MIT
// Outputs of a capture pass: the images of CAPTURES in feature_captures, at consecutive locations.
#ifndef CAPTURE_GLSL
#define CAPTURE_GLSL

#include "shaders/lib/lights/light_lists.glsl"
#include "shaders/lib/shading/brdf.glsl"
#include "shaders/lib/shading/radiance.glsl"
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/shading/transmission.glsl"
#include "shaders/lib/shadows/shadow.glsl"

layout(location = 0) out vec4 out_0;
layout(location = 1) out vec4 out_1;
layout(location = 2) out vec4 out_2;
layout(location = 3) out vec4 out_3;
layout(location = 4) out vec4 out_4;
layout(location = 5) out vec4 out_5;
layout(location = 6) out vec4 out_6;
layout(location = 7) out vec4 out_7;

bool isCaptured(const uint image) { return (feature_captures >> image & 1u) != 0u; }

// Writes an image of the pass to the next free location.
void write(const uint image, const vec4 texel, inout uint free) {
    if (!isCaptured(image)) return;
    if (free == 0u) out_0 = texel;
    if (free == 1u) out_1 = texel;
    if (free == 2u) out_2 = texel;
    if (free == 3u) out_3 = texel;
    if (free == 4u) out_4 = texel;
    if (free == 5u) out_5 = texel;
    if (free == 6u) out_6 = texel;
    if (free == 7u) out_7 = texel;
    ++free;
}

vec4 captured(const float x) { return vec4(x); }
vec4 captured(const vec2 v) { return vec4(v, 0.0, 1.0); }
vec4 captured(const vec3 v) { return vec4(v, 1.0); }

// s: the Surface; z: its reversed depth; shaded: number of Surfaces shaded at the pixel under MSAA.
void capture(const Surface s, const float z, const uint shaded) {
    PixelLights lights = lightsAt(gl_FragCoord.xy, z, on(feature_transmission));
    Radiance radiance = noRadiance();
    if ((feature_captures >> FIRST_LIT_IMAGE) != 0u) radiance.sun_visibility = sunVisibility(s);
    if ((feature_captures >> FIRST_LIT_IMAGE) != 0u && !on(feature_captures & CAPTURES_UNLIT)) {
        radiance = shade(s, lights, radiance.sun_visibility);
        if (on(feature_transmission)) radiance = withTransmission(s, radiance, gl_FragCoord.xy);
    }
    vec4 images[CAPTURE_IMAGES];
    // The channel at component 0 fills its image; later channels take one component each.
#define CAPTURE(name, image, component, value)                  \
    if (isCaptured(image)) {                                    \
        if (component == 0) images[image] = captured(value);    \
        else images[image][component] = captured(value).x;      \
    }
    CAPTURES(CAPTURE)
#undef CAPTURE
    // Unrolled, so that a specialized module stores only to the locations of the pass.
    uint free = 0u;
#define WRITE(name, image, component, value) \
    if (component == 0) write(image, images[image], free);
    CAPTURES(WRITE)
#undef WRITE
}

#endif
