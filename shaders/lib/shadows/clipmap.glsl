// SPDX-License-Identifier: MIT
// Finds the page of the directional light's clipmap for a position (shared/contract/clipmap.h). Marking
// and sampling pages share these functions.
#ifndef CLIPMAP_GLSL
#define CLIPMAP_GLSL

#include "shaders/lib/shadows/shadow_light.glsl"

Clipmap clipmap() {
    vec4 a = texelFetch(shadow_texels, int(SHADOW_LIGHT_TEXELS)),
         b = texelFetch(shadow_texels, int(SHADOW_LIGHT_TEXELS) + 1);
    return CLIPMAP_OF_TEXELS(a, b);
}

Cascade clipmapLevel(const uint level) {
    vec4 a = texelFetch(shadow_texels, int(SHADOW_LIGHT_TEXELS + CLIPMAP_TEXELS + level));
    return CASCADE_OF_TEXEL(a);
}

// Finest level that covers the position; the whole-scene level if no window covers it. Computed from the
// float's exponent, rounded up, so that all devices agree.
uint levelAt(const Clipmap map, const vec3 position) {
    uint bits = floatBitsToUint(lengthOf(position - map.centre) * map.levels_from);
    int exponent = int(bits >> 23) - 127 + ((bits & 0x7fffffu) != 0u ? 1 : 0);
    return uint(clamp(exponent, 0, int(map.levels)));
}

// Index of the page that contains a position in a level, among all ClipmapPages.
uint pageAt(const Clipmap map, const ShadowLight light, const uint level, const vec3 position) {
    Cascade c = clipmapLevel(level);
    vec2 texel = vec2(dot(position, light.x), dot(position, light.y)) * c.texels_per_metre + c.offset;
    // A position that rounding moves out of the window is within the filter's margin around the pages.
    uint last = level < map.levels ? map.width - 1u : 0u;
    uvec2 page = uvec2(clamp(floor(texel / map.page), vec2(0.0), vec2(float(last))));
    return (level * map.width + page.y) * map.width + page.x;
}

ClipmapPage clipmapPage(const Clipmap map, const uint page) {
    uint first = SHADOW_LIGHT_TEXELS + CLIPMAP_TEXELS + map.levels + 1u;
    vec4 a = texelFetch(shadow_texels, int(first + page));
    return CLIPMAP_PAGE_OF_TEXEL(a);
}

// The page to sample at a position.
ClipmapPage residentPage(const ShadowLight light, const vec3 position) {
    Clipmap map = clipmap();
    return clipmapPage(map, pageAt(map, light, levelAt(map, position), position));
}

#endif
