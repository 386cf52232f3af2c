// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/extras.h"
#include "shared/scene/model/scene.h"

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// Reads materials, textures and samplers in the file's order. If a primitive names no material, glTF's
// default material is appended. A material that nothing is drawn with reads no texture, and its faults
// become notes. Scene::images gets one empty entry for each image that a material reads; `imageOf[i]` is the
// file's index of Scene::images[i].
void readMaterials(const tinygltf::Model& model, const MaterialExtras& extras, Scene& scene,
                   std::vector<int>& imageOf);

// For each of Scene::images, whether it is read only as a lightmap.
std::vector<bool> lightmapsAlone(const Scene& scene);

}  // namespace diptych::gltf
