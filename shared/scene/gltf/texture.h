// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <string>
#include <vector>

namespace tinygltf {
class Model;
struct Texture;
}  // namespace tinygltf

namespace diptych::gltf {

class Tally;

// Textures with their samplers, in the file's order; images by the file's index. Returns what is wrong with
// each, a fault only of the materials that read it: "sampler 0: 1 is no wrap mode"; empty: nothing.
std::vector<std::string> readTextures(const tinygltf::Model& model, Scene& scene);

// Of a texture's extensions, one that brings an image of a kind that is not read; nullptr: none does.
const char* otherImageOf(const tinygltf::Texture& texture);

// The pixels of images[i], the file's image imageOf[i], on all cores. Those that are `lightmaps` may be
// pictures of linear light, OpenEXR, Radiance HDR or PFM; what was repaired of one is added to `notes`.
void readImages(const tinygltf::Model& model, const std::vector<int>& imageOf,
                const std::vector<bool>& lightmaps, std::vector<TextureImage>& images,
                std::vector<std::string>& notes, Tally& tally);

}  // namespace diptych::gltf
