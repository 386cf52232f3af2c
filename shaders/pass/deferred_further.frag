// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Shades the groups that deferred_groups_list.frag has listed, one per fragment, and stores their samples.
// A fragment's own position only selects the list entry; it is not at the shaded pixel.
#define FLAT_VIEW
#include "shaders/lib/samples/further_groups.glsl"
#include "shaders/lib/surface/gbuffer_read.glsl"
#include "shaders/lib/samples/sample_groups.glsl"
#include "shaders/lib/shading/shade.glsl"

layout(set = SET_GBUFFER, binding = BINDING_LIT_TARGET, rgba32f) writeonly uniform image2DMS lit_samples;

void main() {
    uint entry = entryAt(uvec2(gl_FragCoord.xy), constants.group);
    bool listed = entry < imageLoad(further_count, ivec2(0)).r;
    uint word = imageLoad(further_list, indexInList(listed ? entry : 0u)).r;
    ivec2 p = pixelOfListed(word);
    SampleGroup group = sampleGroup(depthAt(p), groupOfListed(word));
    float z;
    Surface s = surfaceFromGBuffer(p, group.first, z);
    vec4 radiance = vec4(lit(shade(s, lightsAt(vec2(p) + 0.5, z))), 1.0);
    uint i = 0u;
    do {
        if (listed && (group.mask >> i & 1u) != 0u) imageStore(lit_samples, p, int(i), radiance);
    } while (++i < feature_samples);
}
