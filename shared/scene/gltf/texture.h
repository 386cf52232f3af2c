// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/claims.h"
#include "shared/scene/model/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <vector>

namespace diptych::gltf {

struct Model;

// Reads the document's textures and samplers in the file's order; image indices are the file's. Returns the
// fault of each texture, such as "sampler 0: 1 is not a wrap mode", or an empty string. A fault matters only
// to materials that read the texture.
std::vector<std::string> readTextures(const nlohmann::json& document, Scene& scene);

// The texture's first extension with an unsupported image format; nullptr: none.
const char* otherImageOf(const nlohmann::json& texture);

// Decodes images[i], the file's image imageOf[i], on all cores. Images flagged in `lightmaps` may also be
// OpenEXR, Radiance HDR or PFM; `notes` receives repairs of these. `tally` is called for each image, from any
// thread. Returns the images' claims.
std::vector<Claim> readImages(const Model& model, const std::vector<int>& imageOf,
                              const std::vector<bool>& lightmaps, std::vector<TextureImage>& images,
                              std::vector<std::string>& notes, const std::function<void()>& tally);

}  // namespace diptych::gltf
