// SPDX-License-Identifier: MIT
// EXT_lights_image_based (Khronos, glTF 2.0 vendor extensions): a scene's environment as the images of a
// cube. Only the first mip level is read: shading derives the others and the irradiance, so
// irradianceCoefficients are ignored.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych::gltf {

struct Model;
class Resources;

struct ImageLight {
    std::string who;  // "EXT_lights_image_based: light 0"
    double intensity = 1;
    glm::dquat rotation{1, 0, 0, 0};  // unit, of the environment
    std::array<int, 6> images{};      // file indices: +X, -X, +Y, -Y, +Z, -Z
};
struct ImageLights {
    std::map<std::size_t, ImageLight> scenes;  // only scenes with one
    std::vector<std::string> notes;
};

// Removes the extension from `document`, which need not be checked against the schema. A faulty light is
// omitted with a note.
ImageLights takeImageLights(nlohmann::json& document);

// The environment of the file's scene `index`; none if it has none or, with a note, if its images cannot
// be read.
std::optional<Environment> readImageLight(const ImageLights& lights, std::size_t index, const Model& model,
                                          const Resources& resources, std::vector<std::string>& notes);

}  // namespace diptych::gltf
