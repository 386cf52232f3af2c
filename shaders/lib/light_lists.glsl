// SPDX-License-Identifier: MIT
// Which lights a pixel evaluates, in the buffer's order whatever chose them. Lights and lists are texel buffers: on
// lavapipe a fetch of four costs less than one gathered load from a storage buffer (README, "Many lights").
#ifndef LIGHT_LISTS_GLSL
#define LIGHT_LISTS_GLSL

#include "shaders/lib/draw.glsl"
#include "shaders/lib/light_grid.glsl"
#include "shaders/lib/position.glsl"

layout(set = SET_FRAME, binding = BINDING_LIGHTS) uniform samplerBuffer light_texels;
layout(set = SET_FRAME, binding = BINDING_SPOT_CONES) uniform samplerBuffer spot_cone_texels;
layout(set = SET_FRAME, binding = BINDING_AREA_LIGHTS) uniform samplerBuffer area_light_texels;
layout(set = SET_FRAME, binding = BINDING_LIST_HEADS) uniform usamplerBuffer list_heads;
layout(set = SET_FRAME, binding = BINDING_LIST_INDICES) uniform usamplerBuffer list_indices;
layout(set = SET_FRAME, binding = BINDING_LIST_COUNTS, scalar) readonly buffer Listed { uint listed[]; };
layout(set = SET_FRAME, binding = BINDING_OBJECT_LIST, scalar) readonly buffer ObjectList { ObjectLight object_list[]; };
layout(set = SET_FRAME, binding = BINDING_OBJECTS, scalar) readonly buffer Objects { ObjectLights object_lights[]; };

Light lightAt(uint i) {
    vec4 a = texelFetch(light_texels, int(2u * i)), b = texelFetch(light_texels, int(2u * i + 1u));
    return Light(a.xyz, a.w, b.xyz, b.w);
}

SpotCone spotConeAt(uint i) {
    uint cone = min(i - view.directional_light_count - view.point_light_count, view.spot_light_count);  // the null light's last
    vec4 a = texelFetch(spot_cone_texels, int(2u * cone)), b = texelFetch(spot_cone_texels, int(2u * cone + 1u));
    return SpotCone(a.xyz, a.w, b.x, b.yzw);
}

// Numbers among the area lights: rectangles, discs, tubes.
uint firstDisc() { return view.rect_light_count; }
uint firstTube() { return view.rect_light_count + view.disc_light_count; }
uint areaCount() { return firstTube() + view.tube_light_count; }
AreaLight areaLightAt(uint area) {
    vec4 a = texelFetch(area_light_texels, int(3u * area)), b = texelFetch(area_light_texels, int(3u * area + 1u)),
         c = texelFetch(area_light_texels, int(3u * area + 2u));
    return AreaLight(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w);
}

// A pixel's lights as groups of its list. Without lists (LISTS_NONE) a group is a light and the list all local ones;
// with object_lights it is the draw's own list.
struct PixelLights {
    uint list;
    LightListHead groups;
};

// `pixel`: gl_FragCoord.xy; z: the reversed depth.
PixelLights lightsAt(vec2 pixel, float z) {
    if (on(feature_object_lights)) {
        ObjectLights object = object_lights[constants.draw];
        return PixelLights(0u, LightListHead(object.local_begin, object.point_end, object.spot_end, object.area_end));
    }
    if (feature_light_lists != LISTS_NONE) {
        uint list = cellOf(pixel, viewDepth(z));
        uvec4 head = texelFetch(list_heads, int(list));
        return PixelLights(list, LightListHead(head.x, head.y, head.z, head.w));
    }
    uint points = view.point_light_count, spots = points + view.spot_light_count;
    uint areas = view.rect_light_count + view.disc_light_count + view.tube_light_count;
    return PixelLights(0u, LightListHead(0u, points, spots, spots + areas));
}

// Lights that were evaluated at the pixel, the directional ones too; whether its list found no room.
uint lightCount(PixelLights lights) {
    if (on(feature_object_lights)) return lights.groups.end - object_lights[constants.draw].begin;
    uint local = feature_light_lists != LISTS_NONE ? listed[lights.list] : lights.groups.end;
    return view.directional_light_count + local;
}
bool listOverflowed(PixelLights lights) {
    return feature_light_lists != LISTS_NONE && lights.groups.begin == 0u && lights.groups.end > 0u;
}

// Of groups [begin, end) of a list those that this draw walks.
uvec2 walked(PixelLights lights, uint begin, uint end) {
    if (feature_light_chunk == CHUNK_WHOLE) return uvec2(begin, end);
    uint first = lights.groups.begin;
    return clamp(uvec2(begin, end), first + constants.light_first, first + constants.light_end);
}

// Of the light of the group that lightsOfGroup() gave last: all of it but with object_lights.
float group_share = 1.0;
Light withShare(Light light) {
    if (on(feature_object_lights)) light.intensity *= group_share;
    return light;
}

// The lights of a group; without lists there is one.
uvec4 lightsOfGroup(uint group) {
    if (on(feature_object_lights)) {
        ObjectLight entry = object_list[group];
        group_share = entry.weight;
        return uvec4(entry.light);
    }
    if (feature_light_lists == LISTS_NONE) return uvec4(view.directional_light_count + group);
    return texelFetch(list_indices, int(group));
}

// The directional lights, the same for a whole draw: groups [x, y) of directionalAt().
uvec2 directionalGroups() {
    if (!on(feature_object_lights)) return uvec2(0u, view.directional_light_count);
    ObjectLights object = object_lights[constants.draw];
    return uvec2(object.begin, object.local_begin);
}
Light directionalAt(uint group) {
    return withShare(lightAt(on(feature_object_lights) ? lightsOfGroup(group).x : group));
}

// The area lights of a list one by one: what fills the last group up would be dear.
struct AreaWalk {
    uint place, end;  // of groups, list_width each
    uint light;       // in the buffer
    uint number;      // among the area lights; the null light's is areaCount()
    bool more;
};
void look(inout AreaWalk walk) {
    uint place = min(walk.place, max(walk.end, 1u) - 1u);
    walk.light = lightsOfGroup(place / feature_list_width)[place % feature_list_width];
    uint first = view.directional_light_count + view.point_light_count + view.spot_light_count;
    walk.number = min(walk.light - first, areaCount());
    walk.more = walk.place < walk.end && walk.number < areaCount();
}
AreaWalk areaWalk(uvec2 groups) {
    AreaWalk walk = AreaWalk(groups.x * feature_list_width, groups.y * feature_list_width, 0u, 0u, false);
    look(walk);
    return walk;
}
void step(inout AreaWalk walk) {
    ++walk.place;
    look(walk);
}

#endif
