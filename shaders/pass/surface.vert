// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/geometry/inputs.glsl"
#include "shaders/lib/surface/material_factors.glsl"
#include "shaders/lib/lights/object_lights.glsl"
#include "shaders/lib/geometry/vertex.glsl"

layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 texcoords;  // first and second set
layout(location = 4) in vec4 color;
layout(location = 9) in vec3 normal_from_object_x;
layout(location = 10) in vec3 normal_from_object_y;
layout(location = 11) in vec4 normal_from_object_z;  // w: handedness
layout(location = 12) in mat3 world_from_object;
layout(location = 15) in vec3 world_from_object_origin;

// Attributes from the buffers, or deformed by the instance's pose.
struct Vertex {
    vec3 position, normal;
    vec4 tangent, texcoords, color;
};

Vertex vertexAt() {
    Vertex v = Vertex(position, normal, tangent, texcoords, color);
    if (on(feature_vertex_posing)) {
        PosedInstance i = instanceOfDraw();
        uint number = numberIn(i);
        PosedVertex posed = posedVertex(i, number, feature_vertex_posing == VERTEX_POSING_JOINTS);
        v.position = posed.position;
        v.normal = posed.normal;
        v.tangent = vec4(posed.tangent, v.tangent.w * i.bitangents);
        v.texcoords = vec4(morphedTexcoord0(i, number), morphedTexcoord1(i, number));
        v.color = morphedColor(i, number);
    }
    return v;
}

vec2 bounded(const vec2 uv) { return clamp(uv, vec2(-MAX_TEXCOORD), vec2(MAX_TEXCOORD)); }

// Applies KHR_texture_transform and selects the UV set.
vec2 slotTexcoord(const uint slot, const vec4 texcoords) {
    vec2 uv = bounded((material.second_texcoord & (1u << slot)) != 0 ? texcoords.zw : texcoords.xy);
    TextureTransform t = material.transforms[slot];
    return bounded(vec2(dot(t.u, vec3(uv, 1.0)), dot(t.v, vec3(uv, 1.0))));
}

// The rotation is decoded in object axes, where it was made, and becomes one in world axes.
void rotateTangent(const Vertex v, const float sign_of_bitangent) {
    float coded = abs(v.tangent.w) - 1.0;
    vec2 turn = normalized(4.0 * abs(fract(coded + vec2(0.0, 0.75)) - 0.5) - 1.0);
    vec3 across = sign_of_bitangent * crossProduct(v.normal, v.tangent.xyz);
    vec3 turned = unitVector(world_from_object * (v.tangent.xyz * turn.x + across * turn.y));
    float size = coded >= 1.0 ? MIRRORED_ROTATION : 1.0;
    v_rotation_cosine = size * dot(turned, v_tangent.xyz);
    v_rotation_sine = size * dot(turned, v_tangent.w * crossProduct(v_normal, v_tangent.xyz));
}

void main() {
    Vertex v = vertexAt();
    gl_Position = clipFrom(v.position);
    // A node scale of zero makes vectors zero; the fragment shader then uses the triangle's normal.
    v_normal = unitVector(normal_from_object_x * v.normal.x + normal_from_object_y * v.normal.y +
                          normal_from_object_z.xyz * v.normal.z);
    vec2 first_texcoord = bounded(v.texcoords.xy);
    v_texcoord_u = first_texcoord.x;
    v_texcoord_v = first_texcoord.y;
    mat4x3 affine = mat4x3(world_from_object[0], world_from_object[1], world_from_object[2],
                           world_from_object_origin);
    vec3 world = affine * vec4(v.position, 1.0);
    float sign_of_bitangent = v.tangent.w < 0.0 ? -1.0 : 1.0;
    v_tangent = vec4(unitVector(world_from_object * v.tangent.xyz),
                     sign_of_bitangent * normal_from_object_z.w);
    if (feature_turned_maps != 0u) rotateTangent(v, sign_of_bitangent);
    v_world = world;
    v_color = v.color;
    if ((feature_object_lights & OBJECT_LIGHTS_VERTEX) != 0) {
        v_irradiance = vertexIrradiance(world, v_normal);
        if (on(feature_double_sided)) v_irradiance_behind = vertexIrradiance(world, -v_normal);
    }
    if (on(feature_texture_transform) || on(feature_second_texcoord))
        for (uint slot = 0; slot < SLOT_COUNT; slot += 2)
            v_slot_texcoords[slot / 2] =
                vec4(slotTexcoord(slot, v.texcoords), slotTexcoord(slot + 1, v.texcoords));
}
