// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

namespace diptych::gltf {

struct Model;

// Reads materials, textures and samplers in the file's order. Appends glTF's default material if a
// primitive has no material. A material that is never drawn reads no textures, and its faults become
// notes. Scene::images gets an empty entry per used image; `imageOf[i]` is the file's index of
// Scene::images[i].
void readMaterials(const Model& model, Scene& scene, std::vector<int>& imageOf);

// By index in Scene::images: whether only lightmaps use it.
std::vector<bool> lightmapsAlone(const Scene& scene);

}  // namespace diptych::gltf
