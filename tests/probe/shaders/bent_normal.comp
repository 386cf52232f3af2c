// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/environment/environment.glsl"
#include "tests/probe/shaders/probe.glsl"

// About n = z: v, cosine and sine of the direction along which a lobe is stretched, its width across,
// strength -> bentNormal()
void main() {
    if (PROBE_ROW >= probe_rows) return;
    vec3 v = vec3(IN(7, 0), IN(7, 1), IN(7, 2));
    Brdf b;
    b.across = vec3(-IN(7, 4), IN(7, 3), 0.0);
    b.viewed = vec2(0.0, dot(b.across, v));
    b.alphas = vec2(1.0, IN(7, 5));
    vec3 bent = bentNormal(b, vec3(0.0, 0.0, 1.0), v, IN(7, 6));
    for (int i = 0; i < 3; ++i) OUT(3, i) = bent[i];
}
