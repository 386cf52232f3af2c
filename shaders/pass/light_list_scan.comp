// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One workgroup: an exclusive prefix sum turns the number of entries of each group of four lists into its
// begin, after the list of all lights. Each thread sums a range of groups, then the workgroup sums the
// ranges (Hillis and Steele 1986, "Data parallel algorithms").
#include "shaders/lib/lights/light_list_buffers.glsl"

layout(local_size_x = LIST_GROUP) in;

shared uint sums[LIST_GROUP];

void main() {
    uint thread = gl_LocalInvocationIndex, fours = grid.list_stride / 4u;
    uint run = (fours + LIST_GROUP - 1u) / LIST_GROUP;
    uint first = min(thread * run, fours), end = min(first + run, fours);
    uint sum = 0u;
    for (uint i = first; i < end; ++i) sum += four_begins[i];
    sums[thread] = sum;
    barrier();
    for (uint step = 1u; step < LIST_GROUP; step *= 2u) {
        uint before = thread >= step ? sums[thread - step] : 0u;
        barrier();
        sums[thread] += before;
        barrier();
    }
    uint begin = grid.all_end + sums[thread] - sum;
    for (uint i = first; i < end; ++i) {
        uint entries = four_begins[i];
        four_begins[i] = begin;
        begin += entries;
    }
}
