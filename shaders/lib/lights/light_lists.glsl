// SPDX-License-Identifier: MIT
// The lights that a pixel evaluates, in the order of the light buffer for every assignment method. Lights
// and lists are texel buffers: on lavapipe a fetch of four components costs less than one gathered load
// from a storage buffer.
#ifndef LIGHT_LISTS_GLSL
#define LIGHT_LISTS_GLSL

#include "shaders/lib/lights/addressed_texels.glsl"
#include "shaders/lib/geometry/draw.glsl"
#include "shaders/lib/lights/light_grid.glsl"
#include "shaders/lib/geometry/position.glsl"

layout(set = SET_FRAME, binding = BINDING_LIGHTS) uniform samplerBuffer light_texels;
layout(set = SET_FRAME, binding = BINDING_SPOT_CONES) uniform samplerBuffer spot_cone_texels;
layout(set = SET_FRAME, binding = BINDING_AREA_LIGHTS) uniform samplerBuffer area_light_texels;
layout(set = SET_FRAME, binding = BINDING_LIST_HEADS) uniform usamplerBuffer list_heads;
layout(set = SET_FRAME, binding = BINDING_LIST_INDICES) uniform usamplerBuffer list_indices;
layout(set = SET_FRAME, binding = BINDING_LIST_COUNTS, scalar) readonly buffer Listed { uint listed[]; };
layout(set = SET_FRAME, binding = BINDING_OBJECT_LIST, scalar) readonly buffer ObjectList {
    ObjectLight object_list[];
};
layout(set = SET_FRAME, binding = BINDING_OBJECTS, scalar) readonly buffer Objects {
    ObjectLights object_lights[];
};

vec4 lightTexel(const uint i) {
    if (on(feature_addressed_lights)) return FloatTexels(view_block.lights).at[i];
    return texelFetch(light_texels, int(i));
}
vec4 spotConeTexel(const uint i) {
    if (on(feature_addressed_lights)) return FloatTexels(view_block.spot_cones).at[i];
    return texelFetch(spot_cone_texels, int(i));
}
vec4 areaLightTexel(const uint i) {
    if (on(feature_addressed_lights)) return FloatTexels(view_block.area_lights).at[i];
    return texelFetch(area_light_texels, int(i));
}
uvec4 headTexel(const uint i) {
    if (on(feature_addressed_lights)) return WordTexels(grid_block.heads).at[i];
    return texelFetch(list_heads, int(i));
}
uvec4 entryTexel(const uint i) {
    if (on(feature_addressed_lights)) {
        if (feature_list_width == 1u) return uvec4(SingleWords(grid_block.indices).at[i], 0u, 0u, 1u);
        return WordTexels(grid_block.indices).at[i];
    }
    return texelFetch(list_indices, int(i));
}

Light lightAt(const uint i) {
    vec4 a = lightTexel(2u * i), b = lightTexel(2u * i + 1u);
    return LIGHT_OF_TEXELS(a, b);
}

SpotCone spotConeAt(const uint i) {
    // The null light uses the last cone.
    uint cone = min(i - view.directional_light_count - view.point_light_count, view.spot_light_count);
    vec4 a = spotConeTexel(2u * cone), b = spotConeTexel(2u * cone + 1u);
    return SPOT_CONE_OF_TEXELS(a, b);
}

uint areaCount() { return view.area_ends[AREA_KIND_COUNT - 1u]; }
AreaLight areaLightAt(const uint area) {
    vec4 a = areaLightTexel(3u * area), b = areaLightTexel(3u * area + 1u),
         c = areaLightTexel(3u * area + 2u);
    return AREA_LIGHT_OF_TEXELS(a, b, c);
}

// A pixel's light list as entries of feature_list_width lights, one or four. Without lists (LISTS_NONE)
// an entry is one light and the list contains all local lights. With object_lights it is the draw's own
// list.
struct PixelLights {
    uint list;
    LightListHead entries;
};

// The list of a pixel at a view depth, m. Under MSAA, a triangle that is hidden in some samples may be
// shaded beyond the farthest surface that is visible in the tile. It then uses the list of all lights,
// which follows the tiles' lists.
uint listAt(const vec2 pixel, const float depth, const bool blended) {
    uint list = cellOf(pixel, depth);
    if (feature_light_lists == LISTS_TILED && blended) list = listInFront(list);
    if (feature_light_lists == LISTS_TILED && feature_samples > 1)
        list = depth > uintBitsToFloat(listed[grid.lists + 1u + list]) ? grid.lists : list;
    return list;
}

// `pixel`: gl_FragCoord.xy; z: reversed depth; `blended`: the surface is blended over opaque ones.
PixelLights lightsAt(const vec2 pixel, const float z, const bool blended) {
    if (on(feature_object_lights)) {
        ObjectLights object = object_lights[constants.draw];
        return PixelLights(
            0u, LightListHead(object.local_begin, object.point_end, object.spot_end, object.area_end));
    }
    if (feature_light_lists != LISTS_NONE) {
        uint list = listAt(pixel, viewDepth(z), blended);
        uvec4 head = headTexel(list);
        return PixelLights(list, LIGHT_LIST_HEAD_OF_TEXEL(head));
    }
    uint points = view.point_light_count, spots = points + view.spot_light_count;
    return PixelLights(0u, LightListHead(0u, points, spots, spots + areaCount()));
}

PixelLights lightsAt(const vec2 pixel, const float z) { return lightsAt(pixel, z, false); }

// Number of lights evaluated at the pixel, including directional ones.
uint lightCount(const PixelLights lights) {
    if (on(feature_object_lights)) return lights.entries.end - object_lights[constants.draw].begin;
    uint local = feature_light_lists != LISTS_NONE ? listed[lights.list] : lights.entries.end;
    return view.directional_light_count + local;
}
// Whether the pixel's list overflowed.
bool listOverflowed(const PixelLights lights) {
    bool tooFar = feature_light_lists == LISTS_TILED && feature_samples > 1 &&
                  lights.list == grid.lists;
    return feature_light_lists != LISTS_NONE && lights.entries.begin == 0u && lights.entries.end > 0u &&
           !tooFar;
}

// Entries of [begin, end) that this draw evaluates: all, or those of its light batch.
uvec2 batchEntries(const PixelLights lights, const uint begin, const uint end) {
    if (feature_light_batch == BATCH_WHOLE) return uvec2(begin, end);
    uint first = lights.entries.begin;
    return clamp(uvec2(begin, end), first + constants.light_first, first + constants.light_end);
}

// Weight of the light that lightsOfEntry() returned last; 1 without object_lights.
float entry_weight = 1.0;
Light withEntryWeight(Light light) {
    if (on(feature_object_lights)) light.intensity *= entry_weight;
    return light;
}

// Light indices of an entry; without lists only the first component is used.
uvec4 lightsOfEntry(const uint entry) {
    if (on(feature_object_lights)) {
        ObjectLight object_light = object_list[entry];
        entry_weight = object_light.weight;
        return uvec4(object_light.light);
    }
    if (feature_light_lists == LISTS_NONE) return uvec4(view.directional_light_count + entry);
    return entryTexel(entry);
}

// Range [x, y) of directional lights for directionalAt(); constant over a draw.
uvec2 directionalEntries() {
    if (!on(feature_object_lights)) return uvec2(0u, view.directional_light_count);
    ObjectLights object = object_lights[constants.draw];
    return uvec2(object.begin, object.local_begin);
}
// Index among the directional lights.
uint directionalOf(const uint entry) {
    return on(feature_object_lights) ? lightsOfEntry(entry).x : entry;
}
Light directionalAt(const uint entry) {
    return withEntryWeight(lightAt(directionalOf(entry)));
}

// Iterates over a list's area lights one by one, because evaluating the padding of the last entry would
// be too expensive.
struct AreaLightIterator {
    uint position, end;  // indices of lights in the list: entries times feature_list_width
    uint light;          // index in the light buffer
    uint area_index;     // index among the area lights; areaCount() for the null light
    bool more;
};
void load(inout AreaLightIterator iterator) {
    uint position = min(iterator.position, max(iterator.end, 1u) - 1u);
    iterator.light = lightsOfEntry(position / feature_list_width)[position % feature_list_width];
    uint first = view.directional_light_count + view.point_light_count + view.spot_light_count;
    iterator.area_index = iterator.light - first;
    iterator.more = iterator.position < iterator.end && iterator.area_index < areaCount();
}
AreaLightIterator areaLightIterator(const uvec2 entries) {
    AreaLightIterator iterator =
        AreaLightIterator(entries.x * feature_list_width, entries.y * feature_list_width, 0u, 0u, false);
    load(iterator);
    return iterator;
}
void advance(inout AreaLightIterator iterator) {
    ++iterator.position;
    load(iterator);
}

#endif
