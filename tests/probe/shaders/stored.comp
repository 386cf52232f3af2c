// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/gbuffer.glsl"
#include "tests/probe/shaders/probe.glsl"

// Channels of a surface, each of three floats at its number -> the same, decoded from a packed G-buffer. The
// last column is the material's index.
const uint WIDTH = 3 * 77 + 1;

void read(const uint channel, out vec3 field) { field = IN3(WIDTH, 3 * channel); }
void read(const uint channel, out float field) { field = IN(WIDTH, 3 * channel); }
void write(const uint channel, const vec3 field) {
    for (uint i = 0; i < 3; ++i) OUT(WIDTH, 3 * channel + i) = field[i];
}
void write(const uint channel, const float field) { write(channel, vec3(field, 0.0, 0.0)); }

// The channel has the field's name.
#define SAME_NAMES(X)                                                                                   \
    X(albedo) X(metallic) X(roughness) X(emission) X(occlusion) X(geometric_normal) X(dielectric_f90)   \
    X(lightmap) X(dielectric_f0) X(clearcoat) X(clearcoat_roughness) X(clearcoat_normal) X(anisotropy)  \
    X(sheen_color) X(sheen_roughness) X(iridescence) X(iridescence_ior) X(iridescence_thickness)        \
    X(diffuse_transmission) X(diffuse_transmission_color)

void main() {
    if (PROBE_ROW >= probe_rows) return;
    Surface s;
    vec3 direction;
#define READ(name) read(DEBUG_##name, s.name);
    SAME_NAMES(READ)
    read(DEBUG_normals, s.normal);
    read(DEBUG_anisotropy_direction, direction);
    s.anisotropy_turn = turnOf(direction, s.normal);
    s.lightmapped = true;
    s.material_id = uint(IN(WIDTH, WIDTH - 1));
    Surface d = decodeGBuffer(encodeGBuffer(s), vec3(0.0));
#define WRITE(name) write(DEBUG_##name, d.name);
    SAME_NAMES(WRITE)
    write(DEBUG_normals, d.normal);
    write(DEBUG_anisotropy_direction, anisotropyDirection(d));
    OUT(WIDTH, WIDTH - 1) = float(d.material_id);
}
