// SPDX-License-Identifier: MIT
// Outputs of a light batch: sums for the next batch (partial_sums.glsl).
#ifndef PARTIAL_OUTPUTS_GLSL
#define PARTIAL_OUTPUTS_GLSL

#include "shaders/lib/shading/radiance.glsl"
#include "shaders/lib/surface/gbuffer.glsl"

layout(location = 0) out vec4 out_diffuse;
layout(location = 1) out vec4 out_specular;
// Parts of layers that the scene has, without gaps.
layout(location = 2) out vec4 out_layer_0;
layout(location = 3) out vec4 out_layer_1;
layout(location = 4) out vec4 out_layer_2;

void writeLayer(const uint layer, const vec3 part, inout uint free) {
    if (!storesLayer(layer)) return;
    if (free == 0u) out_layer_0 = vec4(part, 0.0);
    if (free == 1u) out_layer_1 = vec4(part, 0.0);
    if (free == 2u) out_layer_2 = vec4(part, 0.0);
    ++free;
}

void writeSums(const Radiance radiance) {
    out_diffuse = vec4(radiance.diffuse, radiance.local_seen);
    out_specular = vec4(radiance.specular, radiance.local_light);
    uint free = 0u;
    writeLayer(LAYER_CLEARCOAT, radiance.clearcoat, free);
    writeLayer(LAYER_SHEEN, radiance.sheen, free);
    writeLayer(LAYER_DIFFUSE_TRANSMISSION, radiance.transmission, free);
}

#endif
