// SPDX-License-Identifier: MIT
// Sample groups of a pixel, which deferred lighting shades as one, in the bits of a depth
// (shared/contract/samples.h). Sample i is in a group that one of samples 0 to i begins, or is empty.
// These i + 2 cases take as few bits as possible: 21 for 8 samples, the first sample in the lowest. Bits
// rather than digits: lavapipe divides integers lane by lane.
#ifndef SAMPLE_GROUPS_GLSL
#define SAMPLE_GROUPS_GLSL

#include "shaders/lib/contract.glsl"

struct SampleGroup {
    int first;  // index of the sample that is shaded
    uint mask;  // all samples of the group
};

// Bits in the label of sample i.
uint labelBits(const uint i) { return uint(findMSB(i + 1u)) + 1u; }

// Number of groups of a pixel that has at least one.
uint groupsOf(const float stored) {
    return (floatBitsToUint(stored) >> GROUP_MANTISSA_BITS) - GROUP_EXPONENT;
}

// Group k of a pixel from its stored groups; it must have more than k.
SampleGroup sampleGroup(const float stored, const uint k) {
    uint code = floatBitsToUint(stored);
    SampleGroup group = SampleGroup(0, 0u);
    bool found = false;
    uint i = 0u;
    do {
        uint label = code & ((1u << labelBits(i)) - 1u);
        code >>= labelBits(i);
        bool inside = label == k && label <= i;
        group.first = inside && !found ? int(i) : group.first;
        group.mask |= inside ? 1u << i : 0u;
        found = found || inside;
    } while (++i < feature_samples);
    return group;
}

// labels: group index of each sample i; i + 1 if it is empty. count: number of groups.
float storedGroups(const uint labels[MAX_SAMPLES], const uint count) {
    uint code = 0u, bits = 0u, i = 0u;
    do {
        code |= labels[i] << bits;
        bits += labelBits(i);
    } while (++i < feature_samples);
    return uintBitsToFloat((GROUP_EXPONENT + count) << GROUP_MANTISSA_BITS | code);
}

#endif
