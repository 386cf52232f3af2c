// SPDX-License-Identifier: MIT
// Whether two samples of a pixel may be shaded as one although their triangles differ. On a fine mesh,
// each triangle covers part of a pixel and looks like its neighbours. Normals are compared relative to the
// lobe's width: a highlight of roughness r is r^2 wide.
#ifndef SIMILAR_GLSL
#define SIMILAR_GLSL

#include "shaders/lib/surface/gbuffer_read.glsl"

// Largest difference of colours, fractions and roughness; of radiance, relative to the larger one. A
// quarter of an 8-bit level, because a dark surface may be brightly lit.
const float SIMILAR_ATTRIBUTE = 0.25 / 255.0;
// Sine of the angle between normals, relative to the squared roughness.
const float SIMILAR_NORMAL = 0.001;
// Distance of either position from the plane of the other, relative to the distance between them.
const float SIMILAR_PLANE = 0.01;
// Distance between the positions, relative to that on a surface facing the viewer. At grazing angles a
// pixel spans much of a surface, and light on it changes.
const float SIMILAR_SPAN = 1.5;

bool within(const vec3 a, const vec3 b, const float largest) {
    vec3 d = abs(a - b);
    return max(d.x, max(d.y, d.z)) <= largest;
}

bool alikeRadiance(const vec3 a, const vec3 b) {
    return within(a, b, SIMILAR_ATTRIBUTE * max(max(a.x, max(a.y, a.z)), max(b.x, max(b.y, b.z))));
}

bool alikeLayers(const Surface s, const Surface t) {
    vec3 turned = s.clearcoat_normal - t.clearcoat_normal;
    vec3 along = anisotropyDirection(s) - anisotropyDirection(t);
    float rough = min(s.clearcoat_roughness, t.clearcoat_roughness), turn = SIMILAR_NORMAL * rough * rough;
    vec2 film = vec2(s.iridescence_ior, s.iridescence_thickness),
         other = vec2(t.iridescence_ior, t.iridescence_thickness);
    if (any(greaterThan(abs(film - other), SIMILAR_ATTRIBUTE * max(film, other)))) return false;
    if (!within(s.sheen_color, t.sheen_color, SIMILAR_ATTRIBUTE) ||
        !within(s.diffuse_transmission_color, t.diffuse_transmission_color, SIMILAR_ATTRIBUTE) ||
        !within(vec3(s.sheen_roughness, s.iridescence, s.diffuse_transmission),
                vec3(t.sheen_roughness, t.iridescence, t.diffuse_transmission), SIMILAR_ATTRIBUTE))
        return false;
    return within(vec3(s.clearcoat, s.clearcoat_roughness, s.anisotropy),
                  vec3(t.clearcoat, t.clearcoat_roughness, t.anisotropy), SIMILAR_ATTRIBUTE) &&
           dot(turned, turned) <= turn * turn && dot(along, along) <= SIMILAR_NORMAL * SIMILAR_NORMAL;
}

// a, b: texels of two samples of pixel p.
bool areSimilar(const ivec2 p, const GBufferTexel a, const GBufferTexel b) {
    uvec2 at = a.attachments[GBUFFER_SHADED].xy, bt = b.attachments[GBUFFER_SHADED].xy;
    Surface s = decodeGBuffer(a, positionFromDepth(vec2(p) + locationOfShaded(at), depthOfShaded(at)));
    vec3 facing = positionFromDepth(vec2(p) + locationOfShaded(bt), depthOfShaded(at)) - s.position;
    Surface t = decodeGBuffer(b, positionFromDepth(vec2(p) + locationOfShaded(bt), depthOfShaded(bt)));
    vec3 between = t.position - s.position, turned = s.normal - t.normal;
    float rough = min(s.roughness, t.roughness);
    float turn = SIMILAR_NORMAL * rough * rough;
    float off = max(abs(dot(between, s.normal)), abs(dot(between, t.normal)));
    bool near = off * off <= SIMILAR_PLANE * SIMILAR_PLANE * dot(between, between) &&
                dot(between, between) <= SIMILAR_SPAN * SIMILAR_SPAN * dot(facing, facing);
    return s.material_id == t.material_id && s.lightmapped == t.lightmapped && near &&
           dot(turned, turned) <= turn * turn && within(s.albedo, t.albedo, SIMILAR_ATTRIBUTE) &&
           within(vec3(s.roughness, s.metallic, s.occlusion), vec3(t.roughness, t.metallic, t.occlusion),
                  SIMILAR_ATTRIBUTE) &&
           within(s.dielectric_f0, t.dielectric_f0, SIMILAR_ATTRIBUTE) &&
           abs(s.dielectric_f90 - t.dielectric_f90) <= SIMILAR_ATTRIBUTE &&
           (!on(feature_gbuffer_layers) || alikeLayers(s, t)) &&
           alikeRadiance(s.emission, t.emission) && alikeRadiance(s.lightmap, t.lightmap);
}

#endif
