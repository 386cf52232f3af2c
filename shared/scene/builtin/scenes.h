// SPDX-License-Identifier: MIT
// The scenes that builtin.cpp lists; each function makes one. README.md says what each is for.
#pragma once

#include "shared/scene/model/scene.h"

#include <cstdint>

namespace diptych::builtin {

Scene gallery();
Scene spheres(std::uint32_t lights);
Scene furnace();

// array.cpp: how a frame grows
struct ArrayCounts {
    std::uint32_t objects, triangles, meshes, materials, texture_mib;
};
// `triangles` of all objects together, as near as spheres come. There are at least as many meshes as
// materials, as many materials as textures of 4 MiB, and no more meshes than objects.
Scene array(const ArrayCounts& counts);

// surfaces.cpp: surface properties that a G-buffer must store
Scene normals();
Scene emission();
Scene darkAlbedo();
Scene dielectrics();
Scene cutout();
Scene occlusion();
Scene manyMaterials();
Scene vertexColors();
Scene unlitMaterials();
Scene sixteenBits();
Scene lightmaps();

// places.cpp: positions, visibility, transforms
Scene coplanar();
Scene glass();
Scene crossed();
Scene deep();
Scene mirrored();
Scene stretched();
Scene farAway();
Scene ortho();
Scene triangle();
Scene empty();
Scene background();

// calibration.cpp: what a renderer of others is held against
Scene calibration();

// turned_maps.cpp: normal maps under KHR_texture_transform
Scene tangents();

// motion.cpp: what moves
Scene motion();

// lamps.cpp: lights
Scene rangeEdge();
Scene suns();
Scene points();
Scene spots();
Scene areas();
Scene unlit();

}  // namespace diptych::builtin
