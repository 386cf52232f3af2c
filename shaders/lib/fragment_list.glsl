// SPDX-License-Identifier: MIT
// The nearest fragments of each pixel, in order, as many as `layers` of BlendedConstants; whatever the order
// in which they arrive.
//
// Places for keys are sorted by an insertion whose every step is one atomic minimum: place i keeps the least
// of the keys that come to it and hands each other one on to place i + 1, so that when all have come it holds
// the one of rank i. What is drawn again in a second pass finds its place by its key, and is added to sums of
// the pixel where it has none, which are integers and thus the same in any order.
//
// uint64 fragment_keys[]: [layers][pixels] keys; [FRAGMENT_SUMS][pixels] sums; [FRAGMENT_COUNTERS].
#ifndef FRAGMENT_LIST_GLSL
#define FRAGMENT_LIST_GLSL

#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "shaders/lib/draw.glsl"

layout(set = SET_GBUFFER, binding = BINDING_FRAGMENT_KEYS, scalar) buffer FragmentKeys {
    uint64_t fragment_keys[];
};
layout(set = SET_GBUFFER, binding = BINDING_FRAGMENTS, scalar) buffer Fragments { vec4 fragments[]; };

const uint64_t NO_FRAGMENT = ~uint64_t(0);

BlendedConstants list_of = constants.blended;

uint listedPixels() { return list_of.width * list_of.rows; }

// Whether the buffers hold the pixel.
bool isListed(uvec2 pixel) {
    return pixel.y >= list_of.first_row && pixel.y - list_of.first_row < list_of.rows;
}

uint listedPixel(uvec2 pixel) { return (pixel.y - list_of.first_row) * list_of.width + pixel.x; }

// Grows with the distance; of two at the same depth the one that comes later in the scene is in front. `z`:
// reversed depth, 0 to 1. `triangle`: its number among all blended triangles.
uint64_t fragmentKey(float z, uint triangle) {
    return (uint64_t(~floatBitsToUint(max(z, 0.0))) << 32) | uint64_t(~(triangle + 1u));
}

// A key beyond that of the last place finds no room: places only ever get smaller keys, so one that is read
// too early is no less.
void insertKey(uint pixel, uint64_t key) {
    if (key > fragment_keys[(list_of.layers - 1u) * listedPixels() + pixel]) return;
    for (uint i = 0; i < list_of.layers && key != NO_FRAGMENT; ++i) {
        uint64_t there = atomicMin(fragment_keys[i * listedPixels() + pixel], key);
        key = max(there, key);
    }
}

// The place of a key that was inserted; `layers`: it found no room.
uint placeOf(uint pixel, uint64_t key) {
    uint i = 0;
    while (i < list_of.layers && fragment_keys[i * listedPixels() + pixel] < key) ++i;
    if (i < list_of.layers && fragment_keys[i * listedPixels() + pixel] != key) i = list_of.layers;
    return i;
}

uint sumOf(uint pixel, uint sum) { return (list_of.layers + sum) * listedPixels() + pixel; }
uint counter(uint number) { return (list_of.layers + FRAGMENT_SUMS) * listedPixels() + number; }

void addToSum(uint pixel, uint sum, float value) {
    float limited = clamp(value, -FRAGMENT_SUM_MOST, FRAGMENT_SUM_MOST);
    atomicAdd(fragment_keys[sumOf(pixel, sum)], uint64_t(int64_t(limited / FRAGMENT_SUM_UNIT)));
}

float sumAt(uint pixel, uint sum) {
    return float(int64_t(fragment_keys[sumOf(pixel, sum)])) * FRAGMENT_SUM_UNIT;
}

#endif
