// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shadows/local_face.glsl"
#include "tests/probe/shaders/probe.glsl"

// position relative to the light, geometric normal; of the light: x, y, z, depth scale and offset, bias;
// of each of the six faces: centre, texels, extent -> face, texel, depth, and the minimum over filter
// texels of compared depth minus depth of the surface's plane there
const uint WIDTH = 6 + 12 + 24;

void main() {
    if (PROBE_ROW >= probe_rows) return;
    LocalShadow light = LocalShadow(IN3(WIDTH, 6), IN(WIDTH, 15), IN3(WIDTH, 9), IN(WIDTH, 16),
                                    IN3(WIDTH, 12), IN(WIDTH, 17));
    vec3 position = IN3(WIDTH, 0), p = inLight(light, position);
    uint face = faceOf(p), at = 18u + 4u * face;
    LocalFace tile =
        LocalFace(vec2(IN(WIDTH, at), IN(WIDTH, at + 1u)), IN(WIDTH, at + 2u), IN(WIDTH, at + 3u));
    vec3 normal = inLight(light, IN3(WIDTH, 3));
    ReceiverPlane r = localReceiverPlane(onFace(p, face), onFace(normal, face), 0.0, light, tile);
    OUT(5, 0) = float(face);
    OUT(5, 1) = r.texel.x;
    OUT(5, 2) = r.texel.y;
    OUT(5, 3) = r.depth;
    float smallest = 1e30;
    vec2 first = floor(r.texel - 0.5 * float(feature_shadow_kernel));
    vec3 q = onFace(p, face), n = onFace(normal, face);
    for (uint y = 0u; y <= feature_shadow_kernel; ++y)
        for (uint x = 0u; x <= feature_shadow_kernel; ++x) {
            vec2 texel = first + vec2(x, y) + 0.5;
            vec2 across = (texel - tile.centre) / tile.texels;
            float inverse = dot(n, vec3(across, 1.0)) / dot(n, q);
            float plane = inverse * light.depth_scale + light.depth_offset;
            float bias = clamp(dot(r.slope, texel - r.texel) - r.normal_offset_depth, 0.0, r.max_bias);
            smallest = min(smallest, r.depth + bias - plane);
        }
    OUT(5, 4) = smallest;
}
