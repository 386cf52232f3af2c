// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/object_lights.glsl"
#include "shaders/lib/vertex.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 texcoord0;
layout(location = 4) in vec2 texcoord1;
layout(location = 5) in vec4 color;

layout(location = 0) out vec3 out_world;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec2 out_texcoord0;
layout(location = 4) out vec2 out_texcoord1;
layout(location = 5) out vec4 out_color;
layout(location = 6) out vec2 out_slot_texcoords[SLOT_COUNT];
layout(location = 6 + SLOT_COUNT) out vec3 out_irradiance;
layout(location = 7 + SLOT_COUNT) out vec3 out_irradiance_behind;

vec2 bounded(vec2 uv) { return clamp(uv, vec2(-MAX_TEXCOORD), vec2(MAX_TEXCOORD)); }

// KHR_texture_transform and the choice of the UV set.
vec2 slotTexcoord(Material m, uint slot) {
    vec2 uv = bounded((m.second_texcoord & (1u << slot)) != 0 ? texcoord1 : texcoord0);
    TextureTransform t = m.transforms[slot];
    return bounded(vec2(dot(t.u, vec3(uv, 1.0)), dot(t.v, vec3(uv, 1.0))));
}

// A node's scale of zero flattens vectors to nothing; the fragment shader then takes the triangle's normal.
vec3 unitOrZero(vec3 v) {
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

void main() {
    Draw draw = draws[constants.draw];
    out_world = worldFromVertex(draw, position);
    gl_Position = clipFromVertex(out_world);
    out_normal = unitOrZero(draw.normal_from_object * normal);
    out_tangent = vec4(unitOrZero(mat3(draw.world_from_object) * tangent.xyz), tangent.w * draw.handedness);
    out_texcoord0 = bounded(texcoord0);
    out_texcoord1 = texcoord1;
    out_color = color;
    if ((feature_object_lights & OBJECT_LIGHTS_VERTEX) != 0) {
        out_irradiance = vertexIrradiance(out_world, out_normal);
        if (on(feature_double_sided)) out_irradiance_behind = vertexIrradiance(out_world, -out_normal);
    }
    if (on(feature_texture_transform) || on(feature_second_texcoord))
        for (uint slot = 0; slot < SLOT_COUNT; ++slot)
            out_slot_texcoords[slot] = slotTexcoord(materials[constants.material], slot);
}
