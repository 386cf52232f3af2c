// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/octahedral.glsl"
#include "shaders/lib/surface/packing.glsl"
#include "compare/probe/shaders/rows.glsl"

// The product packs with constant bit counts, so the index of the function selects the count.
const uint OCTAHEDRAL_ENCODE = 0, OCTAHEDRAL_DECODE = 100, UNORM_PACK = 200, UNORM_UNPACK = 300, ROOT = 400,
           ROOT_BACK = 401, SHARED_EXPONENT = 402;

// unit vector -> x and y of its code, decoded vector
void octahedral(const uint bits) {
    uint code = encodeOctahedral(in3(0), bits);
    out1(0, float(bitfieldExtract(int(code), 0, int(bits))));
    out1(1, float(bitfieldExtract(int(code), int(bits), int(bits))));
    out3(2, decodeOctahedral(code, bits));
}

// x and y of a code -> unit vector
void decoded(const uint bits) {
    uint mask = (1u << bits) - 1u;
    uint code = (uint(int(in1(0))) & mask) | ((uint(int(in1(1))) & mask) << bits);
    out3(0, decodeOctahedral(code, bits));
}

void main() {
    if (beyondRows()) return;
    if (probed < OCTAHEDRAL_DECODE) {
        octahedral(probed);
    } else if (probed < UNORM_PACK) {
        decoded(probed - OCTAHEDRAL_DECODE);
    } else if (probed < UNORM_UNPACK) {
        out1(0, float(packUnorm(in1(0), probed - UNORM_PACK)));
    } else if (probed < ROOT) {
        out1(0, unpackUnorm(uint(in1(0)), 0, probed - UNORM_UNPACK));
    } else if (probed == ROOT) {
        out1(0, float(packSqrt(vec3(0.0, in1(0), 0.0), ALBEDO_BITS) >> ALBEDO_BITS));
    } else if (probed == ROOT_BACK) {
        out1(0, unpackSqrt(uint(in1(0)) << ALBEDO_BITS, ALBEDO_BITS).g);
    } else {
        out3(0, unpackSharedExponent(packSharedExponent(in3(0))));
    }
}
