// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/extras.h"
#include "shared/scene/model/scene.h"

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// Materials, textures and samplers in the file's order, and a last material, glTF's default, if a primitive
// names none. One that nothing is drawn with reads no texture, and its faults are notes. Scene::images gets
// the encoded images' places only: those that a material reads, and `imageOf[i]` is the file's index of
// Scene::images[i].
void readMaterials(const tinygltf::Model& model, const MaterialExtras& extras, Scene& scene,
                   std::vector<int>& imageOf);

// Which of Scene::images are read as lightmaps and as nothing else.
std::vector<bool> lightmapsAlone(const Scene& scene);

}  // namespace diptych::gltf
