// SPDX-License-Identifier: MIT
// The scenes listed in builtin.cpp. The comment beside a test scene names the bug that it catches.
#pragma once

#include "shared/scene/model/scene.h"

#include <cstdint>

namespace diptych::builtin {

Scene gallery();
Scene spheres(std::uint32_t lights);
Scene furnace();

// array.cpp: scalability
struct ArrayCounts {
    std::uint32_t objects, triangles, meshes, materials, texture_mib;
};
// `triangles` is the approximate total over all objects. Counts are adjusted so that textures of 4 MiB <=
// materials <= meshes <= objects.
Scene array(const ArrayCounts& counts);

// covered.cpp: cost of layers
struct CoverShares {
    std::uint32_t coated, woven, brushed,
        glass;  // clear coat, sheen, anisotropy, transmission; % of the wall
};
// The first of the `lights` is a sun. Behind glass is a plain tile.
Scene covered(const CoverShares& shares, std::uint32_t lights);

// surfaces.cpp: surface properties that a G-buffer must store
Scene normals();         // seams and steps of normal encodings, in every octant
Scene emission();        // emission clamped or rescaled, 1e-6 to 1e6
Scene darkAlbedo();      // base colour packed with a gamma
Scene dielectrics();     // specular parameters that the G-buffer lacks
Scene cutout();          // alpha tests and double sides that differ between passes
Scene occlusion();       // occlusion applied to direct light
Scene manyMaterials();   // material ids beyond the packed bits
Scene vertexColors();    // vertex colours dropped, or applied elsewhere
Scene unlitMaterials();  // light, normal map or emission on unlit surfaces
Scene sixteenBits();     // 16-bit textures cut to 8 bits
Scene lightmaps();       // baked light lost, doubled, clamped or from the wrong UV set

// places.cpp: positions, visibility, transforms
Scene coplanar();    // depth ties
Scene glass();       // blending order, sides and lights; opacity 0, 1 and beyond
Scene crossed();     // surfaces that no draw order blends correctly
Scene deep();        // position from depth, off-centre in a wide view
Scene mirrored();    // bitangents and winding under inherited mirroring
Scene stretched();   // normals under non-uniform scale and shear
Scene farAway();     // float32 in world space
Scene ortho();       // view vectors and depth of an orthographic camera
Scene triangle();    // the smallest input
Scene empty();       // no mesh
Scene background();  // nothing in view

// calibration.cpp: compares other renderers
Scene calibration();

// turned_maps.cpp: normal maps under KHR_texture_transform
Scene tangents();  // tangents of untransformed or resting texture coordinates

// layers.cpp: layers over and within the base
// coats, sheens, films and directions of highlights lost, shared with the base, or on wrong tangents
Scene layers();

// transmission.cpp: light through surfaces
// light through walls and slabs: lost, from another place, of another colour, or from one side alone
Scene transmission();

// motion.cpp: animation
Scene motion();  // a pose that is missing, late or incomplete

// lamps.cpp: lights
Scene rangeEdge();  // light remaining at the end of the range
Scene suns();
Scene points();
Scene spots();
Scene areas();
Scene unlit();

}  // namespace diptych::builtin
