// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace diptych::gltf {

class NoteList;

// Reads what the program defines in a file's "extras", after the check against the schema. A faulty value is
// omitted with a note.
//
// Lights:
//
//   scenes[i].extras.diptych.lights: [ ... ]   objects as in lights_json.h. With "node", a node's index,
//                                              position, direction and axis are in the node's space; its
//                                              scale does not change sizes.
//   extensions.KHR_lights_punctual.lights[i].extras.diptych
//       .angle: rad           of a directional light
//       .importance: "auto", "important", "not_important"
//       .shadow: true         of a point or spot light: requests a shadow

// Applies the extras of `file`, light `index` of KHR_lights_punctual, to `light`.
void addExtras(const nlohmann::json& file, int index, Light& light, NoteList& notes);

// Adds the lights in the extras of `file`, scene `index`. `node_index` maps the file's nodes to Scene::nodes,
// -1: not in the scene.
void attachLights(const nlohmann::json& file, int index, const std::vector<int>& node_index, Scene& scene,
                  NoteList& notes);

// Materials:
//
//   materials[i].extras.diptych.lightmap: { "index": a texture, "texCoord": 0, 1 (1), "intensity": F (1) }
//
// The texture's image is PNG, JPEG or WebP (sRGB), or OpenEXR, Radiance HDR or PFM (linear). Its colour
// times intensity is irradiance over pi, W/(sr m^2).
struct Lightmap {
    int texture = -1, texcoord = 1;  // valid, or -1
    double intensity = 1;
};
// `textures`: their number. `who` names the material. Faults and unknown keys go to `notes`.
Lightmap lightmapOf(const nlohmann::json& material, std::size_t textures, const std::string& who,
                    NoteList& notes);

}  // namespace diptych::gltf
