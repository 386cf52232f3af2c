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

// Reads textures with their samplers, in the file's order; their images are the file's indices. Returns the
// fault of each texture, which only matters to materials that read it: "sampler 0: 1 is no wrap mode";
// empty: no fault.
std::vector<std::string> readTextures(const tinygltf::Model& model, Scene& scene);

// The first extension of a texture that gives an image of a format that is not read; nullptr: none.
const char* otherImageOf(const tinygltf::Texture& texture);

// Decodes the pixels of images[i], the file's image imageOf[i], on all cores. Images flagged in `lightmaps`
// may also be pictures of linear light, OpenEXR, Radiance HDR or PFM; what was repaired in them is added to
// `notes`.
void readImages(const tinygltf::Model& model, const std::vector<int>& imageOf,
                const std::vector<bool>& lightmaps, std::vector<TextureImage>& images,
                std::vector<std::string>& notes, Tally& tally);

}  // namespace diptych::gltf
