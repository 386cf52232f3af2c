// SPDX-License-Identifier: MIT
// Makes a Surface from the material's factors and textures, for forward+ and for the G-buffer pass.
// Everything that needs screen-space derivatives (mip levels, the triangle's normal) happens here and
// nowhere later.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL

#include "shaders/lib/geometry/draw.glsl"
#include "shaders/lib/geometry/inputs.glsl"
#include "shaders/lib/surface/material_factors.glsl"
#include "shaders/lib/lights/object_lights.glsl"
#include "shaders/lib/geometry/position.glsl"
#include "shaders/lib/shading/slab.glsl"
#include "shaders/lib/surface/specular_aa.glsl"
#include "shaders/lib/surface/surface.glsl"

#define SLOT_TEXTURE(number, name, colors, reads, layer, factor, words) \
    layout(set = SET_MATERIAL, binding = number) uniform sampler2D name##_texture;
MATERIAL_SLOTS(SLOT_TEXTURE)
#undef SLOT_TEXTURE

// Texture coordinates of a slot, computed per vertex. Computing them here from the material buffer would
// break derivatives and thus mip levels: lavapipe reads 0 from it in quad pixels that the triangle does
// not cover.
vec2 slotTexcoord(const uint slot) {
    if (on(feature_texture_transform) || on(feature_second_texcoord)) {
        vec4 two = SHADED(v_slot_texcoords[slot / 2]);
        return slot % 2 == 0 ? two.xy : two.zw;
    }
    return shaded_texcoord;
}

// Samples a slot's texture. Under MSAA, coordinates at the pixel's centre select the mip level: the shaded
// locations of neighbouring pixels are not one pixel apart.
vec2 middleTexcoord(const uint slot) {
    if (on(feature_texture_transform) || on(feature_second_texcoord)) {
        vec4 two = MIDDLE(v_slot_texcoords[slot / 2]);
        return slot % 2 == 0 ? two.xy : two.zw;
    }
    return middle_texcoord;
}
vec4 sampledTexel(const sampler2D map, const uint slot) {
    vec2 at = slotTexcoord(slot);
    if (!multisampled()) return texture(map, at);
    vec2 middle = middleTexcoord(slot);
    return textureGrad(map, at, dFdxFine(middle), dFdyFine(middle));
}

// Texel of a slot: sampled, or constant for images of one colour; `texel` is the slot's feature. In pixels
// that the triangle does not cover the constant may read 0, so code that takes differences samples the
// map.
vec4 slotTexel(const sampler2D map, const uint slot, const uint texel) {
    return texel == TEXEL_CONSTANT ? material.texels[slot] : sampledTexel(map, slot);
}
#define TEXEL(name) slotTexel(name##_texture, SLOT_##name, feature_##name##_texture)
// `other`: the slot whose sample it may share. Both repeat the sample, which compilers merge.
#define TEXEL_OR(name, other)                                                                        \
    (feature_##name##_texture == TEXEL_SHARED ? sampledTexel(other##_texture, SLOT_##other) : TEXEL(name))

// Roughness in green, metallic in blue.
vec4 metallicRoughnessTexel() {
    if (feature_metallic_roughness_texture == TEXEL_ALPHAS)
        return vec4(1.0, TEXEL(normal).a, TEXEL(base_color).a, 1.0);
    return TEXEL(metallic_roughness);
}

vec4 baseColor() {
    vec4 color = material.base_color;
    if (on(feature_base_color_texture)) color *= TEXEL(base_color);
    if (on(feature_vertex_color)) color *= shaded_color;
    return color;
}

// Fraction of a pixel where alpha reaches the cutoff, if alpha changes linearly across it (Golus 2017,
// "Anti-aliased Alpha Test: The Esoteric Alpha To Coverage"). `alpha` is at the shaded location, inside
// the triangle: beyond the edge a repeating texture starts again. The change of alpha sums the differences
// between pixel centres along both axes: the width over which an edge in any direction crosses a pixel. It
// excludes the factor, which reads as 0 where a quad leaves its triangle (slotTexcoord). It is at most 1,
// because pixels beside the triangle may lie where the texture repeats; transparent locations then stay
// transparent for cutoffs above 3/8.
float sharpenedAlpha(const float alpha) {
    float middle = 1.0;
    if (on(feature_base_color_texture))
        middle *= texture(base_color_texture, middleTexcoord(SLOT_base_color)).a;
    if (on(feature_vertex_color)) middle *= middle_color.a;
    float change = min(material.base_color.a * (abs(dFdxFine(middle)) + abs(dFdyFine(middle))), 1.0);
    float above = alpha - material.alpha_cutoff;
    return change > 0.0 ? clamp(above / change + 0.5, 0.0, 1.0) : above < 0.0 ? 0.0 : 1.0;
}

// Alpha mask. Every pass that draws the material calls this, so a pre-pass cuts the same holes as shading.
// A masked pixel continues as a helper invocation: its neighbours' mip levels and triangle normals are
// differences to it and would be undefined after `discard`. Returns the remaining samples of the
// triangle's coverage.
uint cutOut(const vec4 base_color) {
    if (feature_alpha_mask == MASK_COVERS) {
        uint covered = coverageOf(sharpenedAlpha(base_color.a));
        gl_SampleMask[0] = int(covered);
        return covered & uint(gl_SampleMaskIn[0]);
    }
    if (on(feature_alpha_mask) && base_color.a < material.alpha_cutoff) demote;
    return uint(gl_SampleMaskIn[0]);
}

float largestOf(const vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

// A vector along the triangle's normal, of any non-zero length and either sign. The derivatives are scaled
// first: in a tiny scene the squared length of their cross product would underflow. A triangle seen
// edge-on or without area gives the direction to the viewer, `towards` (of any length).
vec3 alongTriangleNormal(const vec3 towards) {
    vec3 dx = dFdxFine(v_world), dy = dFdyFine(v_world);
    vec3 n = crossProduct(dx * (1.0 / max(largestOf(dx), 1e-37)),
                          dy * (1.0 / max(largestOf(dy), 1e-37)));
    return dot(n, n) > 0.0 ? n : towards * (1.0 / largestOf(towards));
}
// The triangle's unit normal, facing the viewer.
vec3 triangleNormal(const vec3 towards) {
    vec3 along = alongTriangleNormal(towards);
    vec3 unit = along * inversesqrt(dot(along, along));
    return dot(unit, towards) < 0.0 ? -unit : unit;
}

// Tangent-space normal of a texel, scaled and not normalised.
vec3 mappedNormal(const vec4 texel, const float scale) {
    vec3 t = texel.xyz * 2.0 - 1.0;
    t.xy *= scale;
    return t;
}
vec3 mappedNormal() { return mappedNormal(TEXEL(normal), material.normal_scale); }

// Unit vector along `v`; 0 for the zero vector.
vec3 directionOf(const vec3 v) {
    float length2 = dot(v, v);
    return length2 > 0.0 ? v * inversesqrt(length2) : vec3(0.0);
}

// Transforms `t` from tangent space, (T, w cross(N, T), N) of the interpolated, unnormalised vectors, as
// MikkTSpace defines it (glTF 2.0).
vec3 fromTangentSpace(const vec3 t, const vec3 n, const vec4 tangent) {
    vec3 bitangent = tangent.w * crossProduct(n, tangent.xyz);
    return t.x * tangent.xyz + t.y * bitangent + t.z * n;
}

// Negated on the back of a double-sided material. The triangle's normal replaces a normal that vanished,
// by the node's scale or by interpolation; only variants where that can happen check for it. Both cases
// share one normalisation.
// `n`: of any length.
vec3 shadingNormal(vec3 n, const vec3 towards) {
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

vec3 shadingNormal(const vec3 towards) {
    vec3 n = shaded_normal;
    if (on(feature_normal_texture)) n = fromTangentSpace(mappedNormal(), n, shaded_tangent);
    return shadingNormal(n, towards);
}

// Without a map of its own the coat is smooth, whatever the base's map.
vec3 clearcoatNormal(const vec3 towards) {
    vec3 n = shaded_normal;
    if (on(feature_clearcoat_normal_texture)) {
        vec3 t = mappedNormal(TEXEL(clearcoat_normal), material.clearcoat_normal_scale);
        t = rotatedFrom(t, LAYER_CLEARCOAT, shaded_rotation);
        n = fromTangentSpace(t, n, shaded_tangent);
    }
    return shadingNormal(n, towards);
}

// Gives all four pixels of a quad the value of the covered ones. On lavapipe the others, which derivatives
// use, read 0 from the material buffer, so they take a neighbour's value.
float overQuad(const float value) {
    uvec2 odd = uvec2(gl_FragCoord.xy) & 1u;
    float dx = dFdxFine(value);
    float in_row = value != 0.0 ? value : (odd.x != 0 ? -dx : dx);
    float dy = dFdyFine(in_row);
    return in_row != 0.0 ? in_row : (odd.y != 0 ? -dy : dy);
}

// Specular anti-aliasing by the normal's change between pixel centres; shaded locations are not one pixel
// apart. The change is the same for front and back faces.
// `n`: the normal at the pixel's centre, of any length.
float filteredRoughness(const float roughness, const vec3 n) {
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
    return filteredRoughness(roughness, dFdxFine(unit), dFdyFine(unit), rounded, view.specular_aa_limit);
}

float filteredRoughness(const float roughness) {
    vec3 n = middle_normal;
    if ((feature_specular_aa & SPECULAR_AA_MAPPED) != 0 && on(feature_normal_texture)) {
        vec2 at = middleTexcoord(SLOT_normal);
        float scale = overQuad(material.normal_scale);
        n = fromTangentSpace(mappedNormal(texture(normal_texture, at), scale), n, middle_tangent);
    }
    return filteredRoughness(roughness, n);
}

float filteredClearcoatRoughness(const float roughness) {
    vec3 n = middle_normal;
    if ((feature_specular_aa & SPECULAR_AA_MAPPED) != 0 && on(feature_clearcoat_normal_texture)) {
        vec2 at = middleTexcoord(SLOT_clearcoat_normal);
        float scale = overQuad(material.clearcoat_normal_scale);
        vec3 t = mappedNormal(texture(clearcoat_normal_texture, at), scale);
        t = rotatedFrom(t, LAYER_CLEARCOAT, middle_rotation);
        n = fromTangentSpace(t, n, middle_tangent);
    }
    return filteredRoughness(roughness, n);
}

void addClearcoat(const Material m, const vec3 towards, inout Surface s) {
    float weight = m.clearcoat, roughness = m.clearcoat_roughness;
    if (on(feature_clearcoat_texture)) weight *= TEXEL(clearcoat).r;
    if (on(feature_clearcoat_roughness_texture)) roughness *= TEXEL(clearcoat_roughness).g;
    if (on(feature_specular_aa)) roughness = filteredClearcoatRoughness(roughness);
    vec3 n = clearcoatNormal(towards);
    bool there = weight > 0.0;
    s.clearcoat = weight;
    s.clearcoat_roughness = there ? roughness : 0.0;
    s.clearcoat_normal = there ? n : vec3(0.0);
}

// The direction turns from the tangent to the bitangent.
void addAnisotropy(const Material m, inout Surface s) {
    float strength = m.anisotropy;
    vec2 direction = vec2(1.0, 0.0);
    if (on(feature_anisotropy_texture)) {
        vec4 texel = TEXEL(anisotropy);
        direction = texel.rg * 2.0 - 1.0;
        strength *= texel.b;
    }
    vec2 turn = m.anisotropy_rotation;
    direction = vec2(direction.x * turn.x - direction.y * turn.y,
                     direction.x * turn.y + direction.y * turn.x);
    vec3 t = rotatedFrom(vec3(direction, 0.0), LAYER_ANISOTROPY, shaded_rotation);
    turn = turnOf(fromTangentSpace(t, shaded_normal, shaded_tangent), s.normal);
    s.anisotropy = turn != vec2(0.0) ? strength : 0.0;
    s.anisotropy_turn = strength > 0.0 ? turn : vec2(0.0);
}

void addSheen(const Material m, inout Surface s) {
    s.sheen_color = m.sheen_color;
    if (on(feature_sheen_color_texture)) s.sheen_color *= TEXEL(sheen_color).rgb;
    float roughness = m.sheen_roughness;
    if (on(feature_sheen_roughness_texture)) roughness *= TEXEL_OR(sheen_roughness, sheen_color).a;
    s.sheen_roughness = s.sheen_color != vec3(0.0) ? roughness : 0.0;
}

void addFilm(const Material m, inout Surface s) {
    s.iridescence = m.iridescence;
    if (on(feature_iridescence_texture)) s.iridescence *= TEXEL(iridescence).r;
    float thickness = m.iridescence_thickness_max;
    if (on(feature_iridescence_thickness_texture))
        thickness = blend(m.iridescence_thickness_min, m.iridescence_thickness_max,
                          TEXEL(iridescence_thickness).g);
    bool there = s.iridescence > 0.0;
    s.iridescence_ior = there ? m.iridescence_ior : 0.0;
    s.iridescence_thickness = there ? thickness : 0.0;
}

float slabThickness(const Material m) {
    float thickness = m.thickness * constants.scale;
    if (on(feature_thickness_texture)) thickness *= TEXEL(thickness).g;
    return thickness;
}

// A volume behind the surface absorbs over its thickness, as in the Khronos sample viewer.
void addDiffuseTransmission(const Material m, inout Surface s) {
    float weight = m.diffuse_transmission;
    vec3 color = m.diffuse_transmission_color;
    if (on(feature_diffuse_transmission_texture))
        weight *= TEXEL_OR(diffuse_transmission, diffuse_transmission_color).a;
    if (on(feature_diffuse_transmission_color_texture)) color *= TEXEL(diffuse_transmission_color).rgb;
    if (on(feature_absorbing))
        color *= crossing(m.attenuation_color, m.attenuation_distance, slabThickness(m));
    s.diffuse_transmission = weight;
    s.diffuse_transmission_color = weight > 0.0 ? color : vec3(0.0);
}

void addTransmission(const Material m, const float alpha, inout Surface s) {
    s.coverage = feature_transmission == TRANSMISSION_COVERED ? clamp(alpha, 0.0, 1.0) : 1.0;
    s.transmission = m.transmission;
    if (on(feature_transmission_texture)) s.transmission *= TEXEL(transmission).r;
    float thickness = slabThickness(m);
    bool there = s.transmission > 0.0;
    s.ior = there ? m.ior : 0.0;
    s.thickness = there ? thickness : 0.0;
    s.attenuation_color = there ? m.attenuation_color : vec3(0.0);
    s.attenuation_distance = there ? m.attenuation_distance : 0.0;
    s.dispersion = there ? m.dispersion : 0.0;
}

// Fields that unlit materials have too.
Surface surfaceAt(const vec3 towards) {
    Surface s = bareSurface(positionFromDepth(shadedPixel(), fragmentDepth()));
    s.geometric_normal = needsGeometricNormal() ? triangleNormal(towards) : vec3(0.0);
    s.triangle_normal = s.geometric_normal;
    s.normal = shadingNormal(towards);
    s.material_id = constants.material;
    s.texcoord = shaded_texcoord;
    if (on(feature_captured) && on(feature_normal_texture)) {
        s.tangent = directionOf(shaded_tangent.xyz);
        s.handedness = shaded_tangent.w < 0.0 ? -1.0 : 1.0;  // undoes the rounding of interpolation
        s.tangent_normal = directionOf(mappedNormal());
    }
    s.lightmapped = on(feature_lightmap_texture);
    if ((feature_object_lights & OBJECT_LIGHTS_VERTEX) != 0)
        s.object_irradiance +=
            on(feature_double_sided) && !gl_FrontFacing ? shaded_irradiance_behind : shaded_irradiance;
    if ((feature_object_lights & OBJECT_LIGHTS_SH) != 0) s.object_irradiance += harmonicIrradiance(s.normal);
    return s;
}

// See contract/material.h.
void makeUnlit(const vec3 base_color, inout Surface s) {
    s.albedo = vec3(0.0);
    s.metallic = 0.0;
    s.roughness = 1.0;
    s.emission = base_color;
    s.dielectric_f0 = vec3(0.0);
    s.dielectric_f90 = 0.0;
}

void addBase(const Material m, const vec3 base_color, inout Surface s) {
    s.albedo = base_color;
    s.metallic = m.metallic;
    s.roughness = m.roughness;
    if (on(feature_metallic_roughness_texture)) {
        vec4 texel = metallicRoughnessTexel();
        s.roughness *= texel.g;
        s.metallic *= texel.b;
    }
    if (on(feature_specular_glossiness) && on(feature_specular_color_texture))
        s.roughness = 1.0 - (1.0 - s.roughness) * TEXEL(specular_color).a;
    if (on(feature_specular_aa)) s.roughness = filteredRoughness(s.roughness);
    if (on(feature_occlusion_texture)) {
        float texel = TEXEL_OR(occlusion, metallic_roughness).r;
        s.occlusion = 1.0 + m.occlusion_strength * (texel - 1.0);
    }
    if (on(feature_emission)) {
        s.emission = m.emission;
        if (on(feature_emissive_texture)) s.emission *= TEXEL_OR(emissive, base_color).rgb;
    }
    if (on(feature_lightmap_texture)) s.lightmap = m.lightmap_intensity * TEXEL(lightmap).rgb;
}

void addSpecular(const Material m, inout Surface s) {
    if (on(feature_dielectric_specular)) {
        s.dielectric_f0 = m.dielectric_f0;
        s.dielectric_f90 = m.specular;
        if (on(feature_specular_color_texture)) s.dielectric_f0 *= TEXEL(specular_color).rgb;
        if (on(feature_specular_texture)) s.dielectric_f90 *= TEXEL(specular).a;
        s.dielectric_f0 = min(s.dielectric_f0, vec3(1.0)) * s.dielectric_f90;
    }
    if (on(feature_specular_glossiness)) s.albedo *= 1.0 - largestOf(s.dielectric_f0);
}

Surface surfaceFromMaterial(const vec4 base_color) {
    Material m = material;
    vec3 towards = on(feature_orthographic) ? view.backward : -v_world;
    Surface s = surfaceAt(towards);
    if (on(feature_unlit)) {
        makeUnlit(base_color.rgb, s);
        return s;
    }
    addBase(m, base_color.rgb, s);
    if (hasLayer(LAYER_CLEARCOAT)) addClearcoat(m, towards, s);
    if (hasLayer(LAYER_ANISOTROPY)) addAnisotropy(m, s);
    if (hasLayer(LAYER_SHEEN)) addSheen(m, s);
    if (hasLayer(LAYER_IRIDESCENCE)) addFilm(m, s);
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) addDiffuseTransmission(m, s);
    if (on(feature_transmission)) addTransmission(m, base_color.a, s);
    addSpecular(m, s);
    return s;
}

#endif
