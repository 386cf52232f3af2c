// SPDX-License-Identifier: MIT
// Makes a Surface from the material's factors and textures at a fragment, for forward+ and for the G-buffer
// pass. Everything that needs screen-space derivatives (mip levels, the triangle's normal) happens here and
// nowhere later.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL

#include "shaders/lib/draw.glsl"
#include "shaders/lib/inputs.glsl"
#include "shaders/lib/material_factors.glsl"
#include "shaders/lib/object_lights.glsl"
#include "shaders/lib/position.glsl"
#include "shaders/lib/specular_aa.glsl"
#include "shaders/lib/surface.glsl"

layout(set = SET_MATERIAL, binding = SLOT_base_color) uniform sampler2D base_color_texture;
layout(set = SET_MATERIAL, binding = SLOT_metallic_roughness) uniform sampler2D metallic_roughness_texture;
layout(set = SET_MATERIAL, binding = SLOT_normal) uniform sampler2D normal_texture;
layout(set = SET_MATERIAL, binding = SLOT_occlusion) uniform sampler2D occlusion_texture;
layout(set = SET_MATERIAL, binding = SLOT_emissive) uniform sampler2D emissive_texture;
layout(set = SET_MATERIAL, binding = SLOT_specular) uniform sampler2D specular_texture;
layout(set = SET_MATERIAL, binding = SLOT_specular_color) uniform sampler2D specular_color_texture;
layout(set = SET_MATERIAL, binding = SLOT_lightmap) uniform sampler2D lightmap_texture;

// Texture coordinates of a slot, computed per vertex. They must not be computed here from the material
// buffer: in the pixels of a quad that the triangle does not cover lavapipe reads 0 from it, and derivatives,
// which choose the mip level, would be wrong.
vec2 slotTexcoord(uint slot) {
    if (on(feature_texture_transform) || on(feature_second_texcoord)) return SHADED(v_slot_texcoords[slot]);
    return shaded_texcoord;
}

// A slot's texture. With several samples a pixel the mip level is that of coordinates at the pixel's middle:
// where they are shaded, neighbouring pixels are not a pixel apart.
vec2 middleTexcoord(uint slot) {
    if (on(feature_texture_transform) || on(feature_second_texcoord)) return MIDDLE(v_slot_texcoords[slot]);
    return middle_texcoord;
}
vec4 sampledTexel(sampler2D map, uint slot) {
    if (!multisampled()) return texture(map, slotTexcoord(slot));
    vec2 middle = middleTexcoord(slot);
    return textureGrad(map, slotTexcoord(slot), dFdxFine(middle), dFdyFine(middle));
}

// The texel of a slot that has a sample of its own or an image of one colour; `texel` is its feature. In
// pixels that the triangle does not cover the latter may read 0: what takes differences to them samples the
// map.
vec4 slotTexel(sampler2D map, uint slot, uint texel) {
    return texel == TEXEL_CONSTANT ? material.texels[slot] : sampledTexel(map, slot);
}
// Where a slot's texel is that of another's sample, it is written as the same sample once more, which
// compilers take for one.
vec4 baseColorTexel() { return slotTexel(base_color_texture, SLOT_base_color, feature_base_color_texture); }
vec4 normalTexel() { return slotTexel(normal_texture, SLOT_normal, feature_normal_texture); }
// Roughness in green, metallic in blue.
vec4 metallicRoughnessTexel() {
    if (feature_metallic_roughness_texture == TEXEL_ALPHAS)
        return vec4(1.0, normalTexel().a, baseColorTexel().a, 1.0);
    return slotTexel(metallic_roughness_texture, SLOT_metallic_roughness, feature_metallic_roughness_texture);
}
vec4 occlusionTexel() {
    if (feature_occlusion_texture == TEXEL_SHARED) return metallicRoughnessTexel();
    return slotTexel(occlusion_texture, SLOT_occlusion, feature_occlusion_texture);
}
vec4 emissiveTexel() {
    if (feature_emissive_texture == TEXEL_SHARED) return baseColorTexel();
    return slotTexel(emissive_texture, SLOT_emissive, feature_emissive_texture);
}

vec4 baseColor() {
    vec4 color = material.base_color;
    if (on(feature_base_color_texture)) color *= baseColorTexel();
    if (on(feature_vertex_color)) color *= shaded_color;
    return color;
}

// The share of a pixel where alpha reaches the cutoff, as if it changed evenly across it (Golus 2017,
// "Anti-aliased Alpha Test: The Esoteric Alpha To Coverage"). `alpha` is that of the place which is shaded,
// and lies within the triangle: beyond its edge a texture that repeats begins anew. What it changes by is
// taken from pixel to pixel at their middles, along both axes together, the width over which an edge in any
// direction passes through a pixel, and before the factor, which reads as 0 where a quad leaves its triangle
// (slotTexcoord). It is 1 at most: pixels beside the triangle may lie where a texture begins anew, and a
// clear place then stays clear where the cutoff is above 3/8.
float sharpenedAlpha(float alpha) {
    float middle = 1.0;
    if (on(feature_base_color_texture))
        middle *= texture(base_color_texture, middleTexcoord(SLOT_base_color)).a;
    if (on(feature_vertex_color)) middle *= middle_color.a;
    float change = min(material.base_color.a * (abs(dFdxFine(middle)) + abs(dFdyFine(middle))), 1.0);
    float above = alpha - material.alpha_cutoff;
    return change > 0.0 ? clamp(above / change + 0.5, 0.0, 1.0) : above < 0.0 ? 0.0 : 1.0;
}

// Alpha mask. Every pass that draws the material calls this, so a pre-pass cuts the same holes as shading. A
// pixel in a hole goes on as a helper of its neighbours, whose mip levels and triangle normals are
// differences to it; after `discard` they would be undefined. Returns which of the samples that the triangle
// covers are left of it.
uint cutOut(vec4 base_color) {
    if (feature_alpha_mask == MASK_COVERS) {
        uint covered = coverageOf(sharpenedAlpha(base_color.a));
        gl_SampleMask[0] = int(covered);
        return covered & uint(gl_SampleMaskIn[0]);
    }
    if (on(feature_alpha_mask) && base_color.a < material.alpha_cutoff) demote;
    return uint(gl_SampleMaskIn[0]);
}

float largestOf(vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

// Along the triangle's normal, of any length but 0 and on either side. The derivatives are scaled first,
// because in a tiny scene the square of their cross product's length would underflow. For a triangle seen
// edge-on or without area it is the direction to the viewer, `towards` (of any length).
vec3 alongTriangleNormal(vec3 towards) {
    vec3 dx = dFdxFine(v_world), dy = dFdyFine(v_world);
    vec3 n = crossProduct(dx * (1.0 / max(largestOf(dx), 1e-37)),
                          dy * (1.0 / max(largestOf(dy), 1e-37)));
    return dot(n, n) > 0.0 ? n : towards * (1.0 / largestOf(towards));
}
// The triangle's unit normal, on the viewer's side.
vec3 triangleNormal(vec3 towards) {
    vec3 along = alongTriangleNormal(towards);
    vec3 unit = along * inversesqrt(dot(along, along));
    return dot(unit, towards) < 0.0 ? -unit : unit;
}

// Of a texel: in tangent space, scaled, not of unit length.
vec3 mappedNormal(vec4 texel, float scale) {
    vec3 t = texel.xyz * 2.0 - 1.0;
    t.xy *= scale;
    return t;
}
vec3 mappedNormal() {
    return mappedNormal(normalTexel(), material.normal_scale);
}

// `v` as a unit vector, or 0 where it has no direction.
vec3 directionOf(vec3 v) {
    float length2 = dot(v, v);
    return length2 > 0.0 ? v * inversesqrt(length2) : vec3(0.0);
}

// `t` of tangent space, which is (T, w cross(N, T), N) of the interpolated, unnormalised vectors, as
// MikkTSpace defines it (glTF 2.0).
vec3 fromTangentSpace(vec3 t, vec3 n, vec4 tangent) {
    vec3 bitangent = tangent.w * crossProduct(n, tangent.xyz);
    return t.x * tangent.xyz + t.y * bitangent + t.z * n;
}

// On the back face of a double-sided material the result is negated. The triangle's normal replaces a normal
// that vanished, flattened by the node's scale or by interpolation; only variants where that can happen check
// for it. Either is made a unit vector by the same operations, which are then done once.
vec3 shadingNormal(vec3 towards) {
    vec3 n = shaded_normal;
    if (on(feature_normal_texture)) n = fromTangentSpace(mappedNormal(), n, shaded_tangent);
    float length2 = dot(n, n);
    bool negated = on(feature_double_sided) && !gl_FrontFacing;
    if (on(feature_vanishing_normals)) {
        vec3 along = alongTriangleNormal(towards);
        bool vanished = !(length2 > 0.0);
        n = vanished ? along : n;
        vec3 unit = n * inversesqrt(dot(n, n));
        return (vanished ? dot(unit, towards) < 0.0 : negated) ? -unit : unit;
    }
    vec3 unit = n * inversesqrt(length2);
    return negated ? -unit : unit;
}

// The value in the pixels of a quad that the triangle covers, in all four. The others, whose differences make
// derivatives, read 0 from the material buffer on lavapipe: there it is taken from a neighbour.
float overQuad(float value) {
    uvec2 odd = uvec2(gl_FragCoord.xy) & 1u;
    float dx = dFdxFine(value);
    float in_row = value != 0.0 ? value : (odd.x != 0 ? -dx : dx);
    float dy = dFdyFine(in_row);
    return in_row != 0.0 ? in_row : (odd.y != 0 ? -dy : dy);
}

// Specular anti-aliasing by what the normal does from pixel to pixel: at their middles, because the places
// where they are shaded are not a pixel apart. Which face is seen makes no difference to its changes.
float filteredRoughness(float roughness) {
    vec3 n = middle_normal;
    if ((feature_specular_aa & SPECULAR_AA_MAPPED) != 0 && on(feature_normal_texture)) {
        vec2 at = middleTexcoord(SLOT_normal);
        float scale = overQuad(material.normal_scale);
        n = fromTangentSpace(mappedNormal(texture(normal_texture, at), scale), n, middle_tangent);
    }
    vec3 unit = directionOf(n);
    float w = gl_FragCoord.w;
    float rounded = roundedChange(w, gl_FragCoord.xy, dFdxFine(w), dFdyFine(w));
    if ((feature_specular_aa & SPECULAR_AA_SLOPE) != 0) {
        vec3 right = on(feature_orthographic) ? view.origin_x : view.direction_x;
        vec3 down = on(feature_orthographic) ? view.origin_y : view.direction_y;
        right *= inversesqrt(dot(right, right));
        down *= inversesqrt(dot(down, down));
        return steepenedRoughness(roughness, dFdxFine(unit), dFdyFine(unit), right, down, rounded);
    }
    return filteredRoughness(roughness, dFdxFine(unit), dFdyFine(unit), rounded);
}

Surface surfaceFromMaterial(vec4 base_color) {
    Material m = material;
    Surface s;
    s.position = positionFromDepth(shadedPixel(), fragmentDepth());
    vec3 towards = on(feature_orthographic) ? view.backward : -v_world;
    s.geometric_normal = needsGeometricNormal() ? triangleNormal(towards) : vec3(0.0);
    s.triangle_normal = s.geometric_normal;
    s.normal = shadingNormal(towards);
    s.material_id = constants.material;
    s.texcoord = shaded_texcoord;
    s.tangent = s.tangent_normal = vec3(0.0);
    s.handedness = 0.0;
    if (on(feature_captured) && on(feature_normal_texture)) {
        s.tangent = directionOf(shaded_tangent.xyz);
        s.handedness = shaded_tangent.w < 0.0 ? -1.0 : 1.0;  // which interpolation rounds
        s.tangent_normal = directionOf(mappedNormal());
    }
    s.lightmap = vec3(0.0);
    s.lightmapped = on(feature_lightmap_texture);
    s.object_irradiance = vec3(0.0);
    s.transmission = on(feature_transmission) ? m.transmission : 0.0;
    if ((feature_object_lights & OBJECT_LIGHTS_VERTEX) != 0)
        s.object_irradiance +=
            on(feature_double_sided) && !gl_FrontFacing ? shaded_irradiance_behind : shaded_irradiance;
    if ((feature_object_lights & OBJECT_LIGHTS_SH) != 0) s.object_irradiance += harmonicIrradiance(s.normal);
    if (on(feature_unlit)) {  // see contract/material.h
        s.albedo = vec3(0.0);
        s.metallic = 0.0;
        s.roughness = 1.0;
        s.occlusion = 1.0;
        s.emission = base_color.rgb;
        s.dielectric_f0 = vec3(0.0);
        s.dielectric_f90 = 0.0;
        return s;
    }
    s.albedo = base_color.rgb;
    s.metallic = m.metallic;
    s.roughness = m.roughness;
    if (on(feature_metallic_roughness_texture)) {
        vec4 texel = metallicRoughnessTexel();
        s.roughness *= texel.g;
        s.metallic *= texel.b;
    }
    if (on(feature_specular_aa)) s.roughness = filteredRoughness(s.roughness);
    s.occlusion = 1.0;
    if (on(feature_occlusion_texture)) {
        float texel = occlusionTexel().r;
        s.occlusion = 1.0 + m.occlusion_strength * (texel - 1.0);
    }
    s.emission = vec3(0.0);
    if (on(feature_emission)) {
        s.emission = m.emission;
        if (on(feature_emissive_texture)) s.emission *= emissiveTexel().rgb;
    }
    if (on(feature_lightmap_texture)) {
        vec4 texel = slotTexel(lightmap_texture, SLOT_lightmap, feature_lightmap_texture);
        s.lightmap = m.lightmap_intensity * texel.rgb;
    }
    s.dielectric_f0 = vec3(DEFAULT_DIELECTRIC_F0);
    s.dielectric_f90 = 1.0;
    if (on(feature_dielectric_specular)) {
        s.dielectric_f0 = m.dielectric_f0;
        s.dielectric_f90 = m.specular;
        if (on(feature_specular_color_texture))
            s.dielectric_f0 *= slotTexel(specular_color_texture, SLOT_specular_color,
                                         feature_specular_color_texture).rgb;
        if (on(feature_specular_texture))
            s.dielectric_f90 *= slotTexel(specular_texture, SLOT_specular, feature_specular_texture).a;
        s.dielectric_f0 = min(s.dielectric_f0, vec3(1.0)) * s.dielectric_f90;
    }
    return s;
}

#endif
