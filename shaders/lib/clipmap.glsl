// SPDX-License-Identifier: MIT
// Which page of the sun's clipmap a position is read from, by shared/contract/clipmap.h. What marks pages and
// what reads them ask the same functions.
#ifndef CLIPMAP_GLSL
#define CLIPMAP_GLSL

#include "shaders/lib/shadow_light.glsl"

Clipmap clipmap() {
    vec4 a = texelFetch(shadow_texels, int(SHADOW_LIGHT_TEXELS)),
         b = texelFetch(shadow_texels, int(SHADOW_LIGHT_TEXELS) + 1);
    return CLIPMAP_OF_TEXELS(a, b);
}

Cascade clipmapLevel(uint level) {
    vec4 a = texelFetch(shadow_texels, int(SHADOW_LIGHT_TEXELS + CLIPMAP_TEXELS + level));
    return CASCADE_OF_TEXEL(a);
}

// The finest level that serves so far, the whole scene's where none with a window does. Read from the
// exponent, rounded up: the same on every device.
uint levelAt(Clipmap map, vec3 position) {
    uint bits = floatBitsToUint(lengthOf(position - map.centre) * map.levels_from);
    int exponent = int(bits >> 23) - 127 + ((bits & 0x7fffffu) != 0u ? 1 : 0);
    return uint(clamp(exponent, 0, int(map.levels)));
}

// The number of the page that holds a position in a level, among all ClipmapPages.
uint pageAt(Clipmap map, ShadowLight light, uint level, vec3 position) {
    Cascade c = clipmapLevel(level);
    vec2 texel = vec2(dot(position, light.x), dot(position, light.y)) * c.texels_per_metre + c.offset;
    // What rounding has put beside the window lies within the filter's margin around its pages.
    uint last = level < map.levels ? map.width - 1u : 0u;
    uvec2 page = uvec2(clamp(floor(texel / map.page), vec2(0.0), vec2(float(last))));
    return (level * map.width + page.y) * map.width + page.x;
}

ClipmapPage clipmapPage(Clipmap map, uint page) {
    uint first = SHADOW_LIGHT_TEXELS + CLIPMAP_TEXELS + map.levels + 1u;
    vec4 a = texelFetch(shadow_texels, int(first + page));
    return CLIPMAP_PAGE_OF_TEXEL(a);
}

// The page that a position is read from.
ClipmapPage servingPage(ShadowLight light, vec3 position) {
    Clipmap map = clipmap();
    return clipmapPage(map, pageAt(map, light, levelAt(map, position), position));
}

#endif
