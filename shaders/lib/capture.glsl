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
    // Written out, so that each constant picks its channel before a driver sees the others.
#define CAPTURE(attachment, mode) out_channels[attachment] = debugValue(mode, s, lights, radiance, z, shaded);
    CAPTURE(0, feature_capture_0)
#if ATTACHMENTS > 1
    CAPTURE(1, feature_capture_1)
#endif
#if ATTACHMENTS > 2
    CAPTURE(2, feature_capture_2)
#endif
#if ATTACHMENTS > 3
    CAPTURE(3, feature_capture_3)
#endif
#if ATTACHMENTS > 4
    CAPTURE(4, feature_capture_4)
#endif
#if ATTACHMENTS > 5
    CAPTURE(5, feature_capture_5)
#endif
#if ATTACHMENTS > 6
    CAPTURE(6, feature_capture_6)
#endif
#if ATTACHMENTS > 7
    CAPTURE(7, feature_capture_7)
#endif
#undef CAPTURE
}

#endif
