// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shading/ambient.glsl"
#include "tests/probe/shaders/probe.glsl"

// alpha, n.v -> the fit of specularAlbedo(), meanSchlickWeight()
void main() {
    if (PROBE_ROW >= probe_rows) return;
    vec2 lobe = fittedAlbedo(IN(2, 0), IN(2, 1));
    OUT(3, 0) = lobe.x;
    OUT(3, 1) = lobe.y;
    OUT(3, 2) = meanSchlickWeight(IN(2, 1));
}
