// SPDX-License-Identifier: MIT
// --assign per_object: each draw has its own lights, a few per pixel, some per vertex, the rest as
// spherical harmonics.
#ifndef OBJECT_LIGHTS_GLSL
#define OBJECT_LIGHTS_GLSL

#include "shaders/lib/lights/light_lists.glsl"
#include "shaders/lib/lights/punctual_lights.glsl"

Incident weighted(Incident light, const float weight) {
    light.irradiance *= weight;
    return light;
}

vec3 lambert(const Incident light, const vec3 n) {
    return light.irradiance * max(dot(light.direction, n), 0.0);
}

// Irradiance from the draw's vertex lights at a vertex with the unit normal `n`, W/m^2.
vec3 vertexIrradiance(const vec3 position, const vec3 n) {
    ObjectLights object = object_lights[constants.draw];
    vec3 sum = vec3(0.0);
    for (uint i = object.area_end; i < object.vertex_directional_end; ++i) {
        ObjectLight entry = object_list[i];
        sum += lambert(weighted(fromDirectionalLight(lightAt(entry.light)), entry.weight), n);
    }
    for (uint i = object.vertex_directional_end; i < object.vertex_point_end; ++i) {
        ObjectLight entry = object_list[i];
        sum += lambert(weighted(fromPointLight(lightAt(entry.light), position), entry.weight), n);
    }
    for (uint i = object.vertex_point_end; i < object.vertex_end; ++i) {
        ObjectLight entry = object_list[i];
        Incident light = fromSpotLight(lightAt(entry.light), spotConeAt(entry.light), position);
        sum += lambert(weighted(light, entry.weight), n);
    }
    return sum;
}

// Irradiance from the draw's remaining lights, W/m^2. Clamped to 0, because three bands of harmonics can
// be negative.
vec3 harmonicIrradiance(const vec3 n) {
    ObjectIrradiance e = object_lights[constants.draw].irradiance;
    vec3 linear = e.linear_x * n.x + e.linear_y * n.y + e.linear_z * n.z;
    vec3 mixed = e.xy * (n.x * n.y) + e.yz * (n.y * n.z) + e.xz * (n.x * n.z);
    vec3 squares = e.xx * (n.x * n.x - n.z * n.z) + e.yy * (n.y * n.y - n.z * n.z);
    return max(e.constant + linear + squares + 2.0 * mixed, vec3(0.0));
}

#endif
