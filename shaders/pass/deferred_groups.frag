// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Which samples of a pixel deferred lighting shades as one: sample_edges. A sample joins the first group
// whose first sample it is like. The depth of every sample of the pixel says so (lib/sample_groups.glsl).
#define FLAT_VIEW
#define SAMPLES 1
#include "shaders/lib/gbuffer_read.glsl"
#include "shaders/lib/sample_groups.glsl"
#include "shaders/lib/similar.glsl"

struct Sample {
    GBufferTexel texel;
    float depth;  // reversed; 0: nothing was drawn
};

bool sameBits(Sample a, Sample b) {
    uvec4 differ = uvec4(0u);
    for (uint i = 0u; i < GBUFFER_ATTACHMENTS; ++i) differ |= a.texel.attachments[i] ^ b.texel.attachments[i];
    return differ == uvec4(0u);
}

bool shadedAlike(Sample a, Sample b) {
    if (feature_sample_edges == EDGES_ALL) return false;
    if (feature_sample_edges == EDGES_SIMILAR)
        return sameBits(a, b) || areSimilar(ivec2(gl_FragCoord.xy), a.texel, b.texel);
    return sameBits(a, b);
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    Sample samples[MAX_SAMPLES];
    uint labels[MAX_SAMPLES], count = 0u, i = 0u;
    bool covered = true;  // by each triangle that is seen, whole
    do {
        samples[i].texel = texelOfGBuffer(p, int(i));
        samples[i].depth = depthAt(p, int(i));
        uint left = leftOfShaded(samples[i].texel.attachments[GBUFFER_SHADED].xy);
        covered = covered && left == (1u << feature_samples) - 1u;
    } while (++i < feature_samples);
    i = 0u;
    do {
        uint label = count, j = 0u;
        bool drawn = samples[i].depth > 0.0;
        while (j < i) {
            bool alike = samples[j].depth > 0.0 &&
                         ((feature_sample_edges == EDGES_COVERAGE && covered) ||
                          shadedAlike(samples[i], samples[j]));
            label = alike ? min(label, labels[j]) : label;
            ++j;
        }
        labels[i] = drawn ? label : i + 1u;
        count += drawn && label == count ? 1u : 0u;
    } while (++i < feature_samples);
    gl_FragDepth = storedGroups(labels, count);
}
