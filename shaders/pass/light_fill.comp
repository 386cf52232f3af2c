// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// A thread a list and segment: the numbers of its lights, in order, each kind from a new group on; the first segment's
// also writes the list's head and fills its groups up.
#include "shaders/lib/light_kernel.glsl"

layout(local_size_x = 64) in;

void fillUp(uint from, uint end) {
    for (uint i = from; i < end; ++i) indices[i] = grid.null_light;
}

void main() {
    uint list = gl_GlobalInvocationID.x, segment = gl_GlobalInvocationID.y;
    if (list >= grid.lists) return;
    LightListCount count = countOf(list);
    LightListHead head = headOf(count);
    bool fits = head.end <= grid.capacity;
    // Where the next light of each kind goes; earlier segments' lights come before it.
    uint point = head.begin * grid.width, spot = head.point_end * grid.width, area = head.spot_end * grid.width;
    if (segment == 0u) {
        if (!fits) atomicAdd(overflowed_lists, 1u);
        heads[list] = fits ? head : LightListHead(0u, grid.all_point_end, grid.all_spot_end, grid.all_end);
        listed[list] = fits ? count.all : grid.local_lights;
        if (fits) {
            fillUp(point + count.points, spot);
            fillUp(spot + count.points_and_spots - count.points, area);
            fillUp(area + count.all - count.points_and_spots, head.end * grid.width);
        }
    }
    for (uint i = list * grid.segments; i < list * grid.segments + segment; ++i) {
        point += counts[i].points;
        spot += counts[i].points_and_spots - counts[i].points;
        area += counts[i].all - counts[i].points_and_spots;
    }
    uint word = segment * SEGMENT_WORDS, end = fits ? min(word + SEGMENT_WORDS, grid.words) : word;
    uint mask = 0u, next = word;
    // One loop for words and bits: nested ones would each run a body too many.
    while (next < end || mask != 0u) {
        if (mask == 0u) {
            word = next++;
            mask = masks[maskWord(word, list)];
        }
        if (mask != 0u) {
            uint light = word * 32u + uint(findLSB(mask));
            mask &= mask - 1u;
            uint to = light < grid.point_end ? point++ : light < grid.spot_end ? spot++ : area++;
            indices[to] = grid.first_local + light;
        }
    }
}
