// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One workgroup: how many groups each list takes becomes where it begins, after the list of all lights. A thread sums
// a run of lists, the workgroup the runs (Hillis and Steele 1986, "Data parallel algorithms").
#include "shaders/lib/light_kernel.glsl"

layout(local_size_x = LIST_GROUP) in;

shared uint sums[LIST_GROUP];

void main() {
    uint thread = gl_LocalInvocationIndex;
    uint run = (grid.lists + LIST_GROUP - 1u) / LIST_GROUP;
    uint first = min(thread * run, grid.lists), end = min(first + run, grid.lists);
    uint sum = 0u;
    for (uint list = first; list < end; ++list) {
        LightListCount count = countOf(list);
        count.begin = 0u;
        sum += headOf(count).end;
    }
    sums[thread] = sum;
    barrier();
    for (uint step = 1u; step < LIST_GROUP; step *= 2u) {
        uint before = thread >= step ? sums[thread - step] : 0u;
        barrier();
        sums[thread] += before;
        barrier();
    }
    uint begin = grid.all_end + sums[thread] - sum;
    for (uint list = first; list < end; ++list) {
        LightListCount count = countOf(list);
        count.begin = begin;
        counts[list * grid.segments].begin = begin;
        begin = headOf(count).end;
    }
}
