// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/forward.glsl"
#include "shaders/lib/shading/shade.glsl"

layout(location = 0) out vec4 out_diffuse;
layout(location = 1) out vec4 out_specular;
layout(location = 2) out vec4 out_layer;  // parts of layers that the scene has
layout(location = 3) out vec4 out_next_layer;

void main() {
    Radiance radiance = shade(forwardSurface(), lightsAt(gl_FragCoord.xy, shadedDepth()));
    out_diffuse = vec4(radiance.diffuse, radiance.local_seen);
    out_specular = vec4(radiance.specular, radiance.local_light);
    if (storesLayer(LAYER_CLEARCOAT)) {
        out_layer = vec4(radiance.clearcoat, 0.0);
        if (storesLayer(LAYER_SHEEN)) out_next_layer = vec4(radiance.sheen, 0.0);
    } else if (storesLayer(LAYER_SHEEN)) {
        out_layer = vec4(radiance.sheen, 0.0);
    }
}
