// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/environment/air.glsl"
#include "tests/probe/shaders/probe.glsl"

// Haze, HazeMarch, direction (unit), reach (below 0: endless) -> transmittance, scattered
const uint WIDTH = 36;

vec4 texel(const uint i) { return vec4(IN3(WIDTH, 4 * i), IN(WIDTH, 4 * i + 3)); }

void main() {
    if (PROBE_ROW >= probe_rows) return;
    Haze h = HAZE_OF_TEXELS(texel(0), texel(1), texel(2), texel(3), texel(4));
    HazeMarch m = HAZE_MARCH_OF_TEXELS(texel(5), texel(6), texel(7));
    vec3 away = IN3(WIDTH, 32);
    float reach = IN(WIDTH, 35), height = h.camera_height;
    bool endless = reach < 0.0;
    Hazed hazed;
    if (on(feature_haze & HAZE_MARCHED)) {
        hazed = marchedHaze(h, m, height, away, reach, endless);
    } else {
        float air = endless ? airBeyond(height, away.y, h.inverse_height)
                            : airAlong(height, away.y * reach, reach, h.inverse_height);
        hazed = hazeOfAir(h, air, away);
    }
    for (uint c = 0; c < 3; ++c) {
        OUT(6, c) = hazed.transmittance[c];
        OUT(6, 3 + c) = hazed.scattered[c];
    }
}
