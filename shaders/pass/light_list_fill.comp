// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One thread per list and segment: writes the light indices in order, each light type in new entries. The
// first segment's thread also writes the list's head and pads its entries.
#include "shaders/lib/lights/light_list_buffers.glsl"

layout(local_size_x = 64) in;

// Pads the last entry of a light type with the null light, starting after its lights.
void pad(const uint from, const uint end) {
    for (uint i = 0u; i < feature_list_width; ++i)
        if (from + i < end) indices[from + i] = grid.null_light;
}

LightListHead listOfAll() { return LightListHead(0u, grid.all_point_end, grid.all_spot_end, grid.all_end); }

void main() {
    uint list = gl_GlobalInvocationID.x, segment = gl_GlobalInvocationID.y;
    if (list >= grid.lists) return;
    LightListCount count = countOf(list);
    LightListHead head = headOf(count);
    bool fits = head.end <= grid.capacity;
    // Index of the next light of each type, after the lights of earlier segments.
    uint point = head.begin * grid.width, spot = head.point_end * grid.width,
         area = head.spot_end * grid.width;
    if (segment == 0u) {
        if (!fits) atomicAdd(overflowed_lists, 1u);
        heads[list] = fits ? head : listOfAll();
        listed[list] = fits ? count.all : grid.local_lights;
        if (feature_light_lists == LISTS_TILED && feature_samples > 1) {
            listed[grid.lists + 1u + list] = floatBitsToUint(tile_depths[list].y);
            if (list == 0u) {
                heads[grid.lists] = listOfAll();
                listed[grid.lists] = grid.local_lights;
            }
        }
        if (fits) {
            pad(point + count.points, spot);
            if (on(feature_spot_lights)) pad(spot + count.points_and_spots - count.points, area);
            if (on(feature_area_lights))
                pad(area + count.all - count.points_and_spots, head.end * grid.width);
        }
    }
    uint index = list * grid.segments;
    for (uint i = index; i < index + segment; ++i) {
        point += counts[i].points;
        spot += counts[i].points_and_spots - counts[i].points;
        area += counts[i].all - counts[i].points_and_spots;
    }
    uint left = fits ? counts[index + segment].all : 0u;
    uint mask = 0u, word = 0u, used = 0u, next = segment * (SEGMENT_WORDS / 32u), first = 0u;
    // A single loop over words and bits, because nested loops would each run one iteration too many on
    // lavapipe. Each iteration writes a light, unless it skips 32 empty words.
    while (left > 0u) {
        if (mask == 0u && used == 0u) {
            used = used_words[maskWord(next, list)];
            first = 32u * next++;
        }
        if (mask == 0u && used != 0u) {
            word = first + uint(findLSB(used));
            used &= used - 1u;
            mask = masks[maskWord(word, list)];
        }
        if (mask != 0u) {
            uint light = word * 32u + uint(findLSB(mask));
            mask &= mask - 1u;
            uint to = light < grid.point_end ? point++ : light < grid.spot_end ? spot++ : area++;
            indices[to] = grid.first_local + light;
            --left;
        }
    }
}
