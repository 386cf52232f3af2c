// SPDX-License-Identifier: MIT
// Outputs of a capture pass: the images of CAPTURES in feature_captures, at consecutive locations.
#ifndef CAPTURE_GLSL
#define CAPTURE_GLSL

#include "shaders/lib/lights/light_lists.glsl"
#include "shaders/lib/shading/brdf.glsl"
#include "shaders/lib/shading/radiance.glsl"
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/shading/transmission.glsl"
#include "shaders/lib/shadows/sun_shadow.glsl"

#define LOCATIONS(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7)
#define OUTPUT(at) layout(location = at) out vec4 out_##at;
LOCATIONS(OUTPUT)

bool isCaptured(const uint image) { return (feature_captures >> image & 1u) != 0u; }

// Writes an image of the pass to the next free location.
void write(const uint image, const vec4 texel, inout uint free) {
    if (!isCaptured(image)) return;
#define WRITE_TO(at) \
    if (free == at) out_##at = texel;
    LOCATIONS(WRITE_TO)
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
