// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Terms whose sum is the lit of deferred_channels.frag, one per attachment, before blending. The first two
// have shadow_visibility and local_visibility in alpha, as in captures.
#define FLAT_VIEW
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/geometry/stored_depth.glsl"
#include "shaders/lib/surface/surface_channels.glsl"

layout(location = 0) out vec4 out_diffuse;
layout(location = 1) out vec4 out_specular;
layout(location = 2) out vec4 out_ambient;
layout(location = 3) out vec4 out_haze;
layout(location = 4) out vec4 out_transmittance;
layout(location = 5) out vec4 out_environment;

void main() {
    Surface s = surfaceFromChannels(ivec2(gl_FragCoord.xy));
    Radiance radiance = shade(s, lightsAt(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))));
    out_diffuse = vec4(radiance.diffuse, radiance.sun_visibility);
    out_specular = vec4(radiance.specular, localVisibility(radiance));
    out_ambient = vec4(radiance.ambient, 1.0);
    out_haze = vec4(radiance.haze, 1.0);
    out_transmittance = vec4(radiance.transmittance, 1.0);
    out_environment = vec4(radiance.environment, 1.0);
}
