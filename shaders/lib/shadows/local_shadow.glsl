// SPDX-License-Identifier: MIT
// Visibility of point and spot lights from the shadow atlas, read by local_face.glsl. A list's
// shadow-casting lights are evaluated first, one by one, so that the others cost no more than without
// shadows.
#ifndef LOCAL_SHADOW_GLSL
#define LOCAL_SHADOW_GLSL

#include "shaders/lib/lights/light_lists.glsl"
#include "shaders/lib/shadows/local_face.glsl"

layout(set = SET_FRAME, binding = BINDING_LOCAL_SHADOW_LIGHTS) uniform samplerBuffer local_shadow_texels;
layout(set = SET_FRAME, binding = BINDING_LOCAL_SHADOW_MAP) uniform sampler2DArray local_shadow_map;

LocalCasters localCasters() {
    vec4 a = texelFetch(local_shadow_texels, 0);
    return LOCAL_CASTERS_OF_TEXEL(a);
}

LocalShadow localShadowAt(const uint index) {
    int first = int(1u + LOCAL_SHADOW_TEXELS * index);
    vec4 a = texelFetch(local_shadow_texels, first), b = texelFetch(local_shadow_texels, first + 1),
         c = texelFetch(local_shadow_texels, first + 2);
    return LOCAL_SHADOW_OF_TEXELS(a, b, c);
}

LocalFace localFaceAt(const uint index, const uint face) {
    vec4 a = texelFetch(local_shadow_texels, int(1u + LOCAL_SHADOW_TEXELS * index + 3u + face));
    return LOCAL_FACE_OF_TEXEL(a);
}

// Visibility, 0 to 1, of the light of LocalShadow[index], at `light_position`. 0 if the triangle faces away
// from it.
float visibilityOf(Surface s, const uint index, const vec3 light_position) {
    LocalShadow light = localShadowAt(index);
    vec3 from_light = s.position - light_position;
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) s = facingLight(s, -from_light);
    vec3 p = inLight(light, from_light);
    uint face_index = faceOf(p);
    LocalFace face = localFaceAt(index, face_index);
    float rounding = LOCAL_ROUNDING * (lengthOf(from_light) + lengthOf(s.position));
    vec3 n = onFace(inLight(light, s.geometric_normal), face_index);
    ReceiverPlane r = localReceiverPlane(onFace(p, face_index), n, rounding, light, face);
    float visibility = face.texels > 0.0 ? pcfVisibility(local_shadow_map, r, vec2(0.0), 0u) : 1.0;
    return dot(s.geometric_normal, from_light) < 0.0 ? visibility : 0.0;
}

// Iterates one by one over the shadow-casting lights of a segment of a list: the first ones, with indices
// below `light_end`. Evaluating an entry's other lights as well would be too expensive.
struct CasterIterator {
    uint position, end;  // indices of lights in the list: entries times feature_list_width
    uint light;
    uint light_end;
    bool more;
};
void load(inout CasterIterator iterator) {
    uint position = min(iterator.position, max(iterator.end, 1u) - 1u);
    iterator.light = lightsOfEntry(position / feature_list_width)[position % feature_list_width];
    iterator.more = iterator.position < iterator.end && iterator.light < iterator.light_end;
}
CasterIterator casterIterator(const uvec2 entries, const uint light_end) {
    CasterIterator iterator =
        CasterIterator(entries.x * feature_list_width, entries.y * feature_list_width, 0u, light_end, false);
    load(iterator);
    return iterator;
}
void advance(inout CasterIterator iterator) {
    ++iterator.position;
    load(iterator);
}

// An entry without its shadow-casting lights.
uvec4 withoutCasters(const uvec4 lights, const uint light_end, const uint null_light) {
    return uvec4(lights.x < light_end ? null_light : lights.x, lights.y < light_end ? null_light : lights.y,
                 lights.z < light_end ? null_light : lights.z, lights.w < light_end ? null_light : lights.w);
}

#endif
