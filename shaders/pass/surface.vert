// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/inputs.glsl"
#include "shaders/lib/material_factors.glsl"
#include "shaders/lib/object_lights.glsl"
#include "shaders/lib/vertex.glsl"

// INPUTS: 0 to 3
layout(location = 1) in vec3 normal;
layout(location = 9) in vec3 normal_from_object_x;
layout(location = 10) in vec3 normal_from_object_y;
layout(location = 11) in vec4 normal_from_object_z;  // w: handedness
#if INPUTS >= 1
layout(location = 3) in vec4 texcoords;  // first and second set
#endif
#if INPUTS >= 2
layout(location = 2) in vec4 tangent;
layout(location = 12) in mat4x3 world_from_object;
#endif
#if INPUTS >= 3
layout(location = 4) in vec4 color;
#endif

vec2 bounded(vec2 uv) { return clamp(uv, vec2(-MAX_TEXCOORD), vec2(MAX_TEXCOORD)); }

#if INPUTS >= 3
// KHR_texture_transform and the choice of the UV set.
vec2 slotTexcoord(uint slot) {
    vec2 uv = bounded((material.second_texcoord & (1u << slot)) != 0 ? texcoords.zw : texcoords.xy);
    TextureTransform t = material.transforms[slot];
    return bounded(vec2(dot(t.u, vec3(uv, 1.0)), dot(t.v, vec3(uv, 1.0))));
}
#endif

// A node's scale of zero flattens vectors to nothing; the fragment shader then takes the triangle's normal.
vec3 unitOrZero(vec3 v) {
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return largest > 0.0 ? normalized(v / largest) : vec3(0.0);
}

void main() {
    gl_Position = clipFromVertex();
    v_normal = unitOrZero(normal_from_object_x * normal.x + normal_from_object_y * normal.y +
                          normal_from_object_z.xyz * normal.z);
#if INPUTS >= 1
    v_texcoord = bounded(texcoords.xy);
#endif
#if INPUTS >= 2
    vec3 world = world_from_object * vec4(position, 1.0);
    v_tangent = vec4(unitOrZero(mat3(world_from_object) * tangent.xyz), tangent.w * normal_from_object_z.w);
    v_world = world;
#endif
#if INPUTS >= 3
    v_color = color;
    if ((feature_object_lights & OBJECT_LIGHTS_VERTEX) != 0) {
        v_irradiance = vertexIrradiance(world, v_normal);
        if (on(feature_double_sided)) v_irradiance_behind = vertexIrradiance(world, -v_normal);
    }
    if (on(feature_texture_transform) || on(feature_second_texcoord))
        for (uint slot = 0; slot < SLOT_COUNT; ++slot)
            v_slot_texcoords[slot] = slotTexcoord(slot);
#endif
}
