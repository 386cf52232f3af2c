// SPDX-License-Identifier: MIT
// Selects the samples of a pixel that deferred lighting shades as one (sample_edges). A sample joins the
// first group that has a sample like it.
#ifndef SAMPLE_PAIRS_GLSL
#define SAMPLE_PAIRS_GLSL

#include "shaders/lib/surface/gbuffer_read.glsl"
#include "shaders/lib/samples/sample_groups.glsl"
#include "shaders/lib/samples/similar.glsl"

// A set of sample pairs is a bit mask: the pairs of sample i with earlier ones begin at bit i (i - 1) / 2.
// Inner loops have a constant count. A loop around one with a variable count is not unrolled, and its
// arrays stay in memory, which took three times as long on lavapipe.
uint pair(const uint i, const uint j) { return 1u << (i * (i - 1u) / 2u + j); }

// Pairs whose bits differ in an attachment.
uint differingPairs(const utexture2DMS attachment, const ivec2 p) {
    uvec4 texels[MAX_SAMPLES];
    uint differ = 0u, i = 0u;
    do {
        texels[i] = texelFetch(attachment, p, int(i));
        for (uint j = 0u; j < feature_samples; ++j)
            differ |= j < i && texels[i] != texels[j] ? pair(i, j) : 0u;
    } while (++i < feature_samples);
    return differ;
}

// Pairs whose bits differ in any attachment of the frame.
uint differingPairs(const ivec2 p) {
    uint differ = 0u;
#define ADD_DIFFERING(number, name, kind, what) \
    if (hasAttachment(number)) differ |= differingPairs(gbuffer_##name##_samples, p);
    GBUFFER_BINDINGS(ADD_DIFFERING)
    return differ;
}

// Pairs of a set that are not similar either.
uint dissimilarPairs(const uint pairs, const ivec2 p) {
    GBufferTexel texels[MAX_SAMPLES];
    uint dissimilar = 0u, i = 0u;
    do {
        texels[i] = texelOfGBuffer(p, int(i));
        for (uint j = 0u; j < i; ++j) dissimilar |= areSimilar(p, texels[i], texels[j]) ? 0u : pair(i, j);
    } while (++i < feature_samples);
    return pairs & dissimilar;
}

// Whether every triangle visible in the pixel covers all of it.
bool covered(const ivec2 p) {
    bool whole = true;
    uint i = 0u;
    do {
        uint left = leftOfShaded(texelFetch(gbuffer_SHADED_samples, p, int(i)).xy);
        whole = whole && left == (1u << feature_samples) - 1u;
    } while (++i < feature_samples);
    return whole;
}

// Pairs that are not shaded as one.
uint pairsApart(const ivec2 p) {
    if (feature_sample_edges == EDGES_ALL) return ~0u;
    uint differ = differingPairs(p);
    if (feature_sample_edges == EDGES_SIMILAR) return dissimilarPairs(differ, p);
    if (feature_sample_edges == EDGES_COVERAGE) return covered(p) ? 0u : differ;
    return differ;
}

// Groups of a pixel in the format of storedGroups(). count: number of groups.
float groupsAt(const ivec2 p, out uint count) {
    uint apart = pairsApart(p);
    uint labels[MAX_SAMPLES], i = 0u;
    count = 0u;
    do {
        uint label = count;
        bool drawn = depthAt(p, int(i)) > 0.0;
        for (uint j = 0u; j < feature_samples; ++j) {
            bool alike = j < i && labels[j] != j + 1u && (apart & pair(i, j)) == 0u;
            label = alike ? min(label, labels[j]) : label;
        }
        labels[i] = drawn ? label : i + 1u;
        count += drawn && label == count ? 1u : 0u;
    } while (++i < feature_samples);
    return storedGroups(labels, count);
}

#endif
