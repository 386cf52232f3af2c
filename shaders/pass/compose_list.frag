// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Composites a pixel's fragment list near to far, then the mean of the overflowed fragments as one layer
// behind it. Writes radiance, and in alpha the transmittance of all layers.
#include "shaders/lib/blending/fragment_list.glsl"

layout(location = 0) out vec4 out_lit;

void main() {
    uvec2 p = uvec2(gl_FragCoord.xy);
    out_lit = vec4(vec3(0.0), 1.0);  // a pixel without fragments
    if (!isListed(p)) return;
    uint pixel = listedPixel(p), layer = 0;
    vec3 radiance = vec3(0.0);
    float transmittance = 1.0;
    while (layer < list_of.layers && fragment_keys[layer * listedPixels() + pixel] != NO_FRAGMENT) {
        vec4 f = fragments[layer * listedPixels() + pixel];
        radiance += f.rgb * transmittance;
        transmittance *= 1.0 - f.a;
        ++layer;
    }
    float opacity = layer == list_of.layers ? sumAt(pixel, 3) : 0.0;
    if (opacity > 0.0) {
        float through = exp(-sumAt(pixel, 4));
        vec3 rest = vec3(sumAt(pixel, 0), sumAt(pixel, 1), sumAt(pixel, 2));
        radiance += rest * ((1.0 - through) / opacity) * transmittance;
        transmittance *= through;
        atomicAdd(fragment_keys[counter(1)], uint64_t(1));
    }
    out_lit = vec4(radiance, transmittance);
}
