// SPDX-License-Identifier: MIT
// The outputs of a capture pass: one channel an attachment; which one is a specialization constant.
// ATTACHMENTS is how many there are. SHADES: 0 in the modules for channels that no light changes; a pipeline
// would prune the code of lighting, but only after a compiler has read it.
#ifndef CAPTURE_GLSL
#define CAPTURE_GLSL

#ifndef SHADES
#define SHADES 1
#endif

#include "shaders/lib/debug.glsl"
#if SHADES
#include "shaders/lib/shade.glsl"
#endif

layout(location = 0) out vec4 out_channels[ATTACHMENTS];

uint captureMode(uint attachment) {
    uint modes[CAPTURE_ATTACHMENTS] =
        uint[](feature_capture_0, feature_capture_1, feature_capture_2, feature_capture_3, feature_capture_4,
               feature_capture_5, feature_capture_6, feature_capture_7);
    return modes[attachment];
}

// shaded: Surfaces that are shaded at the pixel, where it has several samples.
void capture(Surface s, float z, uint shaded) {
    PixelLights lights = lightsAt(gl_FragCoord.xy, z);
#if SHADES
    Radiance radiance = shade(s, lights);
    // Which an earlier batch has shaded with.
    if (feature_light_batch == BATCH_LATER) radiance.sun_visibility = sunVisibility(s);
#else
    Radiance radiance = noRadiance();
#endif
    for (uint i = 0; i < ATTACHMENTS; ++i)
        out_channels[i] = debugValue(captureMode(i), s, lights, radiance, z, shaded);
}

#endif
