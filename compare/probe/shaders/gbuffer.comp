// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/gbuffer.glsl"
#include "compare/probe/shaders/rows.glsl"

// normals, albedo, emission, lightmap, F0, roughness, metallic, occlusion, F90, material -> the same
// values read back from the G-buffer
void main() {
    if (beyondRows()) return;
    Surface s;
    s.normal = in3(0);
    s.geometric_normal = in3(3);
    s.albedo = in3(6);
    s.emission = in3(9);
    s.lightmap = in3(12);
    s.lightmapped = true;
    s.dielectric_f0 = in3(15);
    s.roughness = in1(18);
    s.metallic = in1(19);
    s.occlusion = in1(20);
    s.dielectric_f90 = in1(21);
    s.material_id = uint(in1(22));
    Surface d = decodeGBuffer(encodeGBuffer(s), vec3(0.0));
    out3(0, d.normal);
    out3(3, d.geometric_normal);
    out3(6, d.albedo);
    out3(9, d.emission);
    out3(12, d.lightmap);
    out3(15, d.dielectric_f0);
    out1(18, d.roughness);
    out1(19, d.metallic);
    out1(20, d.occlusion);
    out1(21, d.dielectric_f90);
    out1(22, float(d.material_id));
    out1(23, d.lightmapped ? 1.0 : 0.0);
}
