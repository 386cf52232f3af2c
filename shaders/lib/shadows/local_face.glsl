// SPDX-License-Identifier: MIT
// Position of a surface in the shadow tiles of a point or spot light (shared/contract/local_shadow.h).
#ifndef LOCAL_FACE_GLSL
#define LOCAL_FACE_GLSL

#include "shaders/lib/shadows/sun_shadow.glsl"

// World directions to a light's own axes.
vec3 inLight(const LocalShadow light, const vec3 v) {
    return vec3(dot(v, light.x), dot(v, light.y), dot(v, light.z));
}

// Rounding of positions as a fraction of the distance from camera and light. One ulp each for the
// position, the light, the map's depth and the depth compared with it.
const float LOCAL_ROUNDING = 4.8e-7;

// Cube face of a direction in the light's axes: that of its longest component.
uint faceOf(const vec3 direction) {
    vec3 size = abs(direction);
    bool x = size.x > size.y && size.x > size.z, y = !x && size.y > size.z;
    float along = x ? direction.x : y ? direction.y : direction.z;
    return (x ? 0u : y ? 2u : 4u) + (along < 0.0 ? 1u : 0u);
}

// Components of a vector across a face (xy) and along its axis (z).
vec3 onFace(const vec3 v, const uint face) {
    vec3 turned = face < 2u ? v.yzx : face < 4u ? v.zxy : v;
    return vec3(turned.xy, (face & 1u) == 0u ? turned.z : -turned.z);
}

// As sunReceiverPlane() of the directional light, in perspective. `p`, from the light, and the geometric
// normal `n` are in the face's axes; `rounding`: of p, m. Inverse depth is linear in texels, so the plane
// is exact. At any slope, no texel of the filter is compared with less than the plane's own depth there.
ReceiverPlane localReceiverPlane(const vec3 p, const vec3 n, const float rounding, const LocalShadow light,
                                 const LocalFace face) {
    float texel = 1.0 / face.texels;  // width at a depth of 1
    float height = max(-dot(n, p), MIN_SLOPE_COSINE * lengthOf(p));  // of the light above the plane
    // Rise of the plane from the surface to the filter's farthest texel, in texels, for a light one metre
    // above the plane and one metre away.
    float rise = (0.5 * float(feature_shadow_kernel) + 0.5) * (abs(n.x) + abs(n.y));
    float across = texel * p.z;  // texel width at the surface, m
    // The limits keep both offsets short of the light.
    float normal_offset = min(max(rise - MAX_PLANE_BIAS * height / p.z, 0.0) * across, 0.5 * p.z);
    float bias = min(light.bias * across + rounding, 0.25 * p.z);
    vec3 q = p + n * (normal_offset + bias);
    float inverse = light.depth_scale / q.z;
    float depth_of_texel = light.depth_scale * texel / height;
    ReceiverPlane r;
    vec2 texel_of_q = q.xy * (face.texels / q.z),
         inside = clamp(texel_of_q, -face.max_filter_offset, face.max_filter_offset);
    r.texel = face.centre + inside;
    r.slope = n.xy * -depth_of_texel;
    // If a small tile does not fit the filter, it is read farther inside, on the same plane.
    r.depth = inverse + light.depth_offset + dot(r.slope, inside - texel_of_q);
    r.normal_offset_depth = inverse * normal_offset / height;
    r.max_bias = max(MAX_PLANE_BIAS * texel * inverse, rise * depth_of_texel - r.normal_offset_depth);
    r.cutoff_bias = 1e30;  // all texels count
    r.cutoff_scale = 1.0;
    return r;
}

#endif
