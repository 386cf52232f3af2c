// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "compare/probe/shaders/rows.glsl"

// A row's lights and texels replace a frame's; texel i of an environment is at 4 i.
#define LIGHT_LISTS_GLSL
#include "shaders/lib/contract.glsl"
struct OneDraw {
    uint draw;
};
OneDraw constants = OneDraw(0u);
ObjectLights object_lights[1];
ObjectLight object_list[1];
Light lightAt(const uint i) { return Light(vec3(0.0), 0.0, vec3(0.0), 0.0); }
SpotCone spotConeAt(const uint i) { return SpotCone(vec3(0.0), 0.0, 0.0, vec3(0.0)); }
#include "shaders/lib/lights/object_lights.glsl"

vec4 rowTexel(const samplerBuffer texels, const int i) { return in4(4 * uint(i)); }
vec4 rowTexel(const sampler2D texels, const ivec2 p, const int level) { return vec4(0.0); }
#define texelFetch rowTexel
#include "shaders/lib/environment/environment.glsl"

// texels of an environment, normal -> irradiance / pi
void ofEnvironment() { out3(0, environmentIrradiance(in3(32))); }

// nine coefficients, normal -> irradiance
void ofObject() {
    object_lights[0].irradiance = ObjectIrradiance(in3(0), in3(3), in3(6), in3(9), in3(12), in3(15), in3(18),
                                                   in3(21), in3(24));
    out3(0, harmonicIrradiance(in3(27)));
}

// alpha^2, cosine
void masking() { out1(0, smithLambda(in1(0), in1(1))); }

void main() {
    if (beyondRows()) return;
    switch (probed) {
        case 0: ofEnvironment(); break;
        case 1: ofObject(); break;
        case 2: masking(); break;
        case 3: out1(0, specularLevel(in1(0))); break;
    }
}
