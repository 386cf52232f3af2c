// SPDX-License-Identifier: MIT
// Samples of a pixel that deferred lighting shades as one, in the bits of a depth
// (shared/contract/samples.h): sample i is in one of the groups that samples 0 to i begin, or nothing is
// drawn there, which are i + 2 cases in as many bits as they take: 21 of 8 samples, the first the lowest.
// Bits rather than digits: lavapipe divides integers lane by lane.
#ifndef SAMPLE_GROUPS_GLSL
#define SAMPLE_GROUPS_GLSL

#include "shaders/lib/contract.glsl"

struct SampleGroup {
    int first;  // the sample that is shaded
    uint mask;  // of all that are in the group
};

// Bits that the label of sample i takes.
uint labelBits(uint i) { return uint(findMSB(i + 1u)) + 1u; }

// How many groups the pixel has, which has one at least.
uint groupsOf(float stored) { return (floatBitsToUint(stored) >> GROUP_MANTISSA_BITS) - GROUP_EXPONENT; }

// Group k of the pixel whose groups are stored so. The pixel has more than k of them.
SampleGroup sampleGroup(float stored, uint k) {
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

// labels: of sample i the number of its group, or i + 1 where nothing is drawn. count: of groups.
float storedGroups(uint labels[MAX_SAMPLES], uint count) {
    uint code = 0u, bits = 0u, i = 0u;
    do {
        code |= labels[i] << bits;
        bits += labelBits(i);
    } while (++i < feature_samples);
    return uintBitsToFloat((GROUP_EXPONENT + count) << GROUP_MANTISSA_BITS | code);
}

#endif
