// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace diptych::gltf {

// Light properties that glTF does not define, in a file's "extras":
//
//   scenes[i].extras.diptych.lights: [ ... ]   objects as in lights_json.h. With "node", a node's index,
//                                              position, direction and axis are in the node's space; its
//                                              scale does not change sizes.
//   extensions.KHR_lights_punctual.lights[i].extras.diptych
//       .angle: rad           of a directional light
//       .importance: "auto", "important", "not_important"
//       .shadow: true         of a point or spot light: requests a shadow
//
// A faulty light is omitted with a note.
struct LightExtras {
    struct Hung {
        std::string who;  // "scene 0: extras: diptych: light 2"
        Light light;
        int node = -1;  // valid index in the file; -1: world space
    };
    struct OfScene {
        std::vector<Hung> lights;
        std::vector<std::string> notes;
    };
    struct OfLight {
        float angle = 0;
        Importance importance = Importance::automatic;
        bool shadow = false;
        std::vector<std::string> notes;
    };
    std::map<std::size_t, OfScene> scenes;  // only scenes with such lights
    std::map<std::size_t, OfLight> lights;
};

// Material properties:
//
//   materials[i].extras.diptych.lightmap: { "index": a texture, "texCoord": 0 or 1 (1), "intensity": F (1)
//   }
//
// The texture's image is PNG, JPEG or WebP (sRGB), or OpenEXR, Radiance HDR or PFM (linear). Its colour
// times intensity is irradiance over pi, W/(sr m^2).
struct MaterialExtras {
    struct Lightmap {
        int texture = -1, texcoord = 1;
        double intensity = 1;
        std::vector<std::string> notes;
    };
    std::map<std::size_t, Lightmap> lightmaps;  // only materials with one
};

// `document` need not be checked against the schema.
LightExtras lightExtras(const nlohmann::json& document);
MaterialExtras materialExtras(const nlohmann::json& document);

class NoteList;

// addExtras() applies the extras of light `index` of KHR_lights_punctual to `light`. attachLights() adds
// the lights in the extras of the file's scene `index`. `place` maps the file's nodes to Scene::nodes, -1:
// not in the scene.
void addExtras(const LightExtras& extras, std::size_t index, Light& light, NoteList& notes);
void attachLights(const LightExtras& extras, std::size_t index, const std::vector<int>& place, Scene& scene,
                  NoteList& notes);

}  // namespace diptych::gltf
