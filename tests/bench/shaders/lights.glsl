// SPDX-License-Identifier: MIT
// Entry point of bench_kernels around shade(): a full-screen target of 16 x 16 pixel tiles, each with its
// own list of point lights. By default the lights are in the paths' texel buffer. LIGHTS_UNIFORM or
// LIGHTS_STORAGE moves them to a buffer of that kind. LIGHTS_UNIFORM_BASE declares that all lanes read one
// list.
#ifndef KERNEL_LIGHTS_GLSL
#define KERNEL_LIGHTS_GLSL

#include "shaders/lib/lights/light_lists.glsl"

// SET_MATERIAL is free: no material is read.
#if defined(LIGHTS_UNIFORM)
layout(set = SET_MATERIAL, binding = 0, scalar) uniform UniformLights { Light kernel_lights[512]; };
#elif defined(LIGHTS_STORAGE)
layout(set = SET_MATERIAL, binding = 1, scalar) readonly buffer StorageLights { Light kernel_lights[]; };
#endif
#if defined(LIGHTS_UNIFORM) || defined(LIGHTS_STORAGE)
Light kernelLightAt(const uint i) { return kernel_lights[i]; }
#define lightAt kernelLightAt
#endif

#include "shaders/lib/shading/shade.glsl"

layout(location = 0) out vec4 out_lit;

// A curved sheet in front of the camera. Its arithmetic is the same in every language; kernel_avx2.cpp
// repeats it.
Surface kernelSurface(const vec2 pixel) {
    float u = pixel.x * (1.0 / 1024.0), v = pixel.y * (1.0 / 1024.0);
    vec3 slope = vec3(0.4 * (u - 0.3), 0.6 * (v - 0.2), 1.0);
    Surface s;
    s.position = vec3(8.0 * (u - 0.3), 8.0 * (v - 0.2), -6.0 - u * v);
    s.normal = slope * inversesqrt(dot(slope, slope));
    s.geometric_normal = s.normal;
    s.albedo = vec3(0.5, 0.6, 0.7);
    s.metallic = 0.25;
    s.roughness = 0.3 + 0.5 * u;
    s.occlusion = 1.0;
    s.emission = vec3(0.0);
    s.dielectric_f0 = vec3(0.04);
    s.dielectric_f90 = 1.0;
    s.material_id = 0u;
    s.texcoord = vec2(0.0);
    return s;
}

// Push constants: `draw` is the number of tiles across; `material` is the number of list entries of a
// tile, four lights each; `light_end` is the number of entries to evaluate.
void main() {
    uvec2 tile = uvec2(gl_FragCoord.xy) >> 4;
    uint begin = (tile.y * constants.draw + tile.x) * constants.material;
#ifdef LIGHTS_UNIFORM_BASE
    begin = subgroupBroadcastFirst(begin);
#endif
    uint end = begin + constants.light_end;
    PixelLights lights = PixelLights(0u, LightListHead(begin, end, end, end));
    out_lit = vec4(lit(shade(kernelSurface(gl_FragCoord.xy), lights)), 1.0);
}

#endif
