// SPDX-License-Identifier: MIT
// Where a surface lies in the tiles of a point or a spot, by shared/contract/local_shadow.h.
#ifndef LOCAL_FACE_GLSL
#define LOCAL_FACE_GLSL

#include "shaders/lib/shadow.glsl"

// From world directions to a light's own axes.
vec3 inLight(LocalShadow light, vec3 v) { return vec3(dot(v, light.x), dot(v, light.y), dot(v, light.z)); }

// Of positions, a share of their distance from camera and light: the position's own, the light's, the depth
// in the map and the one that is compared with it, a unit in the last place each.
const float LOCAL_ROUNDING = 4.8e-7;

// The face that a direction from the light, in its axes, lies in: that of the longest component.
uint faceOf(vec3 direction) {
    vec3 size = abs(direction);
    bool x = size.x > size.y && size.x > size.z, y = !x && size.y > size.z;
    float along = x ? direction.x : y ? direction.y : direction.z;
    return (x ? 0u : y ? 2u : 4u) + (along < 0.0 ? 1u : 0u);
}

// The components of a vector across a face, and along it.
vec3 onFace(vec3 v, uint face) {
    vec3 turned = face < 2u ? v.yzx : face < 4u ? v.zxy : v;
    return vec3(turned.xy, (face & 1u) == 0u ? turned.z : -turned.z);
}

// As receiverOf() of the sun, in a perspective: `p`, from the light, and the geometric normal `n` on the
// face; `rounding`: of p, m. Inverse depth is linear in texels, so that the plane is exact. Whatever its
// slope, no texel of the filter is compared with less than the plane's own depth there.
Receiver localReceiver(vec3 p, vec3 n, float rounding, LocalShadow light, LocalFace face) {
    float texel = 1.0 / face.texels;  // across, at a depth of 1
    float height = max(-dot(n, p), LEAST_SLOPE_COSINE * lengthOf(p));  // of the light over the plane
    // By how much the plane rises from the surface to the filter's farthest texel: in texels, were the light
    // a metre above it and a metre away.
    float rise = (0.5 * float(feature_shadow_kernel) + 0.5) * (abs(n.x) + abs(n.y));
    float across = texel * p.z;  // m of a texel at the surface
    // Neither reaches the light.
    float aside = min(max(rise - MOST_LIFT * height / p.z, 0.0) * across, 0.5 * p.z);
    float bias = min(light.bias * across + rounding, 0.25 * p.z);
    vec3 q = p + n * (aside + bias);
    float inverse = light.depth_scale / q.z;
    float depth_of_texel = light.depth_scale * texel / height;
    Receiver r;
    vec2 texel_of_q = q.xy * (face.texels / q.z), inside = clamp(texel_of_q, -face.reach, face.reach);
    r.texel = face.centre + inside;
    r.slope = n.xy * -depth_of_texel;
    // Where a small tile has no room for the filter it is read in the same plane farther in.
    r.depth = inverse + light.depth_offset + dot(r.slope, inside - texel_of_q);
    r.aside = inverse * aside / height;
    r.most = max(MOST_LIFT * texel * inverse, rise * depth_of_texel - r.aside);
    r.highest = 1e30;  // all texels count
    r.counts = 1.0;
    return r;
}

#endif
