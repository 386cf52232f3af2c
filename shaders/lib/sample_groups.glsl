// SPDX-License-Identifier: MIT
// Samples of a pixel that deferred lighting shades as one, as a number that fits into a depth
// (shared/contract/samples.h): sample i is in one of the groups that samples 0 to i begin, or nothing is
// drawn there, which are i + 2 cases: digits of a number, the last sample's the least.
#ifndef SAMPLE_GROUPS_GLSL
#define SAMPLE_GROUPS_GLSL

#include "shaders/lib/contract.glsl"

struct SampleGroup {
    int first;  // the sample that is shaded
    uint mask;  // of all that are in the group
};

// How many groups the pixel has.
uint groupsOf(float stored) { return uint(stored * float(1u << GROUP_BITS)) >> GROUP_CODE_BITS; }

// Group k of the pixel whose groups are stored so. The pixel has more than k of them.
SampleGroup sampleGroup(float stored, uint k) {
    uint code = uint(stored * float(1u << GROUP_BITS)) & ((1u << GROUP_CODE_BITS) - 1u);
    SampleGroup group = SampleGroup(0, 0u);
    uint i = feature_samples;
    do {
        --i;
        uint label = code % (i + 2u);
        code /= i + 2u;
        if (label == k && label <= i) {
            group.first = int(i);
            group.mask |= 1u << i;
        }
    } while (i > 0u);
    return group;
}

// labels: of sample i the number of its group, or i + 1 where nothing is drawn. count: of groups.
float storedGroups(uint labels[MAX_SAMPLES], uint count) {
    uint code = 0u, i = 0u;
    do {
        code = code * (i + 2u) + labels[i];
    } while (++i < feature_samples);
    return float((count << GROUP_CODE_BITS) | code) / float(1u << GROUP_BITS);
}

#endif
