// SPDX-License-Identifier: MIT
// The scenes listed in builtin.cpp; each function adds one to an empty builder. The comment beside a test
// scene names the bug that it catches.
#pragma once

#include "shared/scene/builtin/builder.h"

#include <cstdint>

namespace diptych::builtin {

void gallery(Builder& b);
void spheres(Builder& b, std::uint32_t lights);
void furnace(Builder& b);

// array.cpp: scalability
struct ArrayCounts {
    std::uint32_t objects, triangles, meshes, materials, texture_mib;
};
// `triangles` is the approximate total over all objects. Counts are adjusted so that textures of 4 MiB <=
// materials <= meshes <= objects.
void array(Builder& b, const ArrayCounts& counts);

// covered.cpp: cost of layers
struct CoverFractions {
    std::uint32_t coated, woven, brushed,
        glass;  // clear coat, sheen, anisotropy, transmission; % of the wall
};
// The first of the `lights` is a sun. Behind glass is a plain tile.
void covered(Builder& b, const CoverFractions& fractions, std::uint32_t lights);

// surfaces.cpp: surface properties that a G-buffer must store
void normals(Builder& b);         // seams and steps of normal encodings, in every octant
void emission(Builder& b);        // emission clamped or rescaled, 1e-6 to 1e6
void darkAlbedo(Builder& b);      // base colour packed with a gamma
void dielectrics(Builder& b);     // specular parameters that the G-buffer lacks
void cutout(Builder& b);          // alpha tests and double sides that differ between passes
void occlusion(Builder& b);       // occlusion applied to direct light
void manyMaterials(Builder& b);   // material ids beyond the packed bits
void vertexColors(Builder& b);    // vertex colours dropped, or applied elsewhere
void unlitMaterials(Builder& b);  // light, normal map or emission on unlit surfaces
void sixteenBits(Builder& b);     // 16-bit textures cut to 8 bits
void lightmaps(Builder& b);       // baked light lost, doubled, clamped or from the wrong UV set

// places.cpp: positions, visibility, transforms
void coplanar(Builder& b);    // depth ties
void glass(Builder& b);       // blending order, sides and lights; opacity 0, 1 and beyond
void crossed(Builder& b);     // surfaces that no draw order blends correctly
void deep(Builder& b);        // position from depth, off-centre in a wide view
void mirrored(Builder& b);    // bitangents and winding under inherited mirroring
void stretched(Builder& b);   // normals under non-uniform scale and shear
void farAway(Builder& b);     // float32 in world space
void ortho(Builder& b);       // view vectors and depth of an orthographic camera
void triangle(Builder& b);    // the smallest input
void empty(Builder& b);       // no mesh
void background(Builder& b);  // nothing in view

// calibration.cpp: compares other renderers
void calibration(Builder& b);

// turned_maps.cpp: normal maps under KHR_texture_transform
void tangents(Builder& b);  // tangents of untransformed or resting texture coordinates

// layers.cpp: layers over and within the base, and light through surfaces
// coats, sheens, films and directions of highlights lost, shared with the base, or on wrong tangents
void layers(Builder& b);
// light through walls and slabs: lost, from another place, of another colour, or from one side alone
void transmission(Builder& b);

// motion.cpp: animation
void motion(Builder& b);  // a pose that is missing, late or incomplete

// lamps.cpp: lights
void rangeEdge(Builder& b);  // light remaining at the end of the range
void suns(Builder& b);
void points(Builder& b);
void spots(Builder& b);
void areas(Builder& b);
void unlit(Builder& b);

}  // namespace diptych::builtin
