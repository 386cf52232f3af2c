// SPDX-License-Identifier: MIT
// The outputs of a capture pass: the images of CAPTURES that feature_captures names, without a gap.
#ifndef CAPTURE_GLSL
#define CAPTURE_GLSL

#include "shaders/lib/debug.glsl"
#include "shaders/lib/shade.glsl"

layout(location = 0) out vec4 out_0;
layout(location = 1) out vec4 out_1;
layout(location = 2) out vec4 out_2;
layout(location = 3) out vec4 out_3;
layout(location = 4) out vec4 out_4;
layout(location = 5) out vec4 out_5;
layout(location = 6) out vec4 out_6;
layout(location = 7) out vec4 out_7;

bool isCaptured(uint image) { return (feature_captures >> image & 1u) != 0u; }

// Writes an image that the pass draws to the first location that is free.
void write(uint image, vec4 texel, inout uint free) {
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

// shaded: Surfaces that are shaded at the pixel, where it has several samples.
void capture(Surface s, float z, uint shaded) {
    PixelLights lights = lightsAt(gl_FragCoord.xy, z);
    Radiance radiance = noRadiance();
    if ((feature_captures >> FIRST_LIT_IMAGE) != 0u) {
        radiance = shade(s, lights);
        // An earlier batch has shaded with it.
        if (feature_light_batch == BATCH_LATER) radiance.sun_visibility = sunVisibility(s);
    }
    vec4 images[CAPTURE_IMAGES];
    // The channel at component 0 fills its image, later ones take a component each.
#define CAPTURE(name, image, component)                                                      \
    if (isCaptured(image)) {                                                                 \
        vec4 value = debugValue(DEBUG_##name, s, lights, radiance, z, shaded);               \
        if (component == 0) images[image] = value;                                           \
        else images[image][component] = value.x;                                             \
    }
    CAPTURES(CAPTURE)
#undef CAPTURE
    // Without a loop, so that a module with its constants given stores at the locations alone that are drawn.
    uint free = 0u;
#define WRITE(name, image, component) \
    if (component == 0) write(image, images[image], free);
    CAPTURES(WRITE)
#undef WRITE
}

#endif
