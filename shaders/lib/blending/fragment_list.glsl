// SPDX-License-Identifier: MIT
// The nearest `layers` (BlendedConstants) fragments of each pixel, sorted by depth whatever their arrival
// order.
//
// Insertion sort with one atomic minimum per step. Entry i keeps the smallest key and passes the others on
// to entry i + 1, so that in the end it contains the key of rank i. A second pass draws the fragments
// again and finds each entry by its key. Fragments without an entry are added to integer sums of the
// pixel, which do not depend on the order.
//
// uint64 fragment_keys[]: [layers][pixels] keys; [FRAGMENT_SUMS][pixels] sums; [FRAGMENT_COUNTERS].
#ifndef FRAGMENT_LIST_GLSL
#define FRAGMENT_LIST_GLSL

#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "shaders/lib/geometry/draw.glsl"

layout(set = SET_GBUFFER, binding = BINDING_FRAGMENT_KEYS, scalar) buffer FragmentKeys {
    uint64_t fragment_keys[];
};
layout(set = SET_GBUFFER, binding = BINDING_FRAGMENTS, scalar) buffer Fragments { vec4 fragments[]; };

const uint64_t NO_FRAGMENT = ~uint64_t(0);

BlendedConstants list_of = constants.blended;

uint listedPixels() { return list_of.width * list_of.rows; }

// Whether the buffers cover the pixel.
bool isListed(const uvec2 pixel) {
    return pixel.y >= list_of.first_row && pixel.y - list_of.first_row < list_of.rows;
}

uint listedPixel(const uvec2 pixel) { return (pixel.y - list_of.first_row) * list_of.width + pixel.x; }

// Sort key that grows with distance. At equal depth, the fragment later in the scene is in front. `z`:
// reversed depth, 0 to 1. `triangle`: index among all blended triangles.
uint64_t fragmentKey(const float z, const uint triangle) {
    return (uint64_t(~floatBitsToUint(max(z, 0.0))) << 32) | uint64_t(~(triangle + 1u));
}

// A key greater than the last entry's overflows the list. Entries only decrease, so a stale read never
// rejects a key that fits.
void insertKey(const uint pixel, uint64_t key) {
    if (key > fragment_keys[(list_of.layers - 1u) * listedPixels() + pixel]) return;
    for (uint i = 0; i < list_of.layers && key != NO_FRAGMENT; ++i) {
        uint64_t there = atomicMin(fragment_keys[i * listedPixels() + pixel], key);
        key = max(there, key);
    }
}

// List index of an inserted key; `layers` if it overflowed.
uint indexOfFragment(const uint pixel, const uint64_t key) {
    uint i = 0;
    while (i < list_of.layers && fragment_keys[i * listedPixels() + pixel] < key) ++i;
    if (i < list_of.layers && fragment_keys[i * listedPixels() + pixel] != key) i = list_of.layers;
    return i;
}

uint sumOf(const uint pixel, const uint sum) { return (list_of.layers + sum) * listedPixels() + pixel; }
uint counter(const uint number) { return (list_of.layers + FRAGMENT_SUMS) * listedPixels() + number; }

void addToSum(const uint pixel, const uint sum, const float value) {
    float limited = clamp(value, -FRAGMENT_SUM_MAX, FRAGMENT_SUM_MAX);
    atomicAdd(fragment_keys[sumOf(pixel, sum)], uint64_t(int64_t(limited / FRAGMENT_SUM_UNIT)));
}

float sumAt(const uint pixel, const uint sum) {
    return float(int64_t(fragment_keys[sumOf(pixel, sum)])) * FRAGMENT_SUM_UNIT;
}

#endif
