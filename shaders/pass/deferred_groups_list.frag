// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// As deferred_groups.frag, and lists each pixel's secondary sample groups. Their order in the list varies
// from run to run; the shaded values do not depend on it.
#define FLAT_VIEW
#include "shaders/lib/samples/further_groups.glsl"
#include "shaders/lib/samples/sample_pairs.glsl"

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    uint count;
    gl_FragDepth = groupsAt(p, count);
    // A device may clip the full-screen triangle into two that share pixels, as lavapipe does.
    bool once = (gl_SampleMaskIn[0] & 1) != 0;
    if (once && count > 1u) {
        uint first = imageAtomicAdd(further_count, ivec2(0), count - 1u), k = 1u;
        do {
            if (k < count) imageStore(further_list, indexInList(first + k - 1u), uvec4(listedGroup(p, k)));
        } while (++k < feature_samples);
    }
}
