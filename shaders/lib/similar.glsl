// SPDX-License-Identifier: MIT
// Whether two samples of a pixel may be shaded as one although they are of different triangles: as on a fine
// mesh, where each triangle covers a part of a pixel and its neighbours look the same. Normals are what a
// lobe's width makes of them: a highlight of roughness r is r^2 wide.
#ifndef SIMILAR_GLSL
#define SIMILAR_GLSL

#include "shaders/lib/gbuffer_read.glsl"

// Largest differences, of colours, shares and roughness; of radiance as a share of the larger one.
const float SIMILAR_ATTRIBUTE = 1.0 / 255.0;
// Sine of the angle between normals, as a share of the squared roughness; and at most.
const float SIMILAR_NORMAL = 0.02;
const float SIMILAR_NORMAL_MOST = 0.02;
// Distance of either position from the plane of the other, as a share of the distance between them.
const float SIMILAR_PLANE = 0.1;

bool within(vec3 a, vec3 b, float most) {
    vec3 d = abs(a - b);
    return max(d.x, max(d.y, d.z)) <= most;
}

bool alikeRadiance(vec3 a, vec3 b) {
    return within(a, b, SIMILAR_ATTRIBUTE * max(max(a.x, max(a.y, a.z)), max(b.x, max(b.y, b.z))));
}

// a, b: of two samples of pixel p.
bool areSimilar(ivec2 p, GBufferTexel a, GBufferTexel b) {
    uvec2 at = a.attachments[GBUFFER_SHADED].xy, bt = b.attachments[GBUFFER_SHADED].xy;
    Surface s = decodeGBuffer(a, positionFromDepth(vec2(p) + placeOfShaded(at), depthOfShaded(at)));
    Surface t = decodeGBuffer(b, positionFromDepth(vec2(p) + placeOfShaded(bt), depthOfShaded(bt)));
    vec3 between = t.position - s.position, turned = s.normal - t.normal;
    float rough = min(s.roughness, t.roughness);
    float turn = min(SIMILAR_NORMAL * rough * rough, SIMILAR_NORMAL_MOST);
    float off = max(abs(dot(between, s.normal)), abs(dot(between, t.normal)));
    bool near = off * off <= SIMILAR_PLANE * SIMILAR_PLANE * dot(between, between);
    return s.material_id == t.material_id && s.lightmapped == t.lightmapped && near &&
           dot(turned, turned) <= turn * turn && within(s.albedo, t.albedo, SIMILAR_ATTRIBUTE) &&
           within(vec3(s.roughness, s.metallic, s.occlusion), vec3(t.roughness, t.metallic, t.occlusion),
                  SIMILAR_ATTRIBUTE) &&
           within(s.dielectric_f0, t.dielectric_f0, SIMILAR_ATTRIBUTE) &&
           abs(s.dielectric_f90 - t.dielectric_f90) <= SIMILAR_ATTRIBUTE &&
           alikeRadiance(s.emission, t.emission) && alikeRadiance(s.lightmap, t.lightmap);
}

#endif
