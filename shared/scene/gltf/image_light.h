// SPDX-License-Identifier: MIT
// EXT_lights_image_based (Khronos, glTF 2.0 vendor extensions): the environment of a scene as the pictures of
// a cube. Of its mips the first is read, of which shading makes all others, and irradiance too; so the
// irradianceCoefficients are not.
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

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

class Resources;

struct ImageLight {
    std::string who;  // "EXT_lights_image_based: light 0"
    double intensity = 1;
    glm::dquat rotation{1, 0, 0, 0};  // unit, of the environment
    std::array<int, 6> images{};      // of the file: +X, -X, +Y, -Y, +Z, -Z
};
struct ImageLights {
    std::map<std::size_t, ImageLight> scenes;  // only scenes that have one
    std::vector<std::string> notes;
};

// Takes the extension out of `document`, which need not have been checked against the schema. A light with a
// fault is left out, with a note.
ImageLights takeImageLights(nlohmann::json& document);

// The environment of the file's scene `index`; nothing where it has none, or where its images cannot be read,
// which a note says.
std::optional<Environment> readImageLight(const ImageLights& lights, std::size_t index,
                                          const tinygltf::Model& model, const Resources& resources,
                                          std::vector<std::string>& notes);

}  // namespace diptych::gltf
