// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace diptych::gltf {

// Light that KHR_lights_punctual has no words for, in a file's "extras":
//
//   scenes[i].extras.diptych.lights: [ ... ]   objects as in lights_json.h. With "node", a node's index,
//   position,
//                                              direction and axis are in its space; its scale changes no
//                                              size.
//   extensions.KHR_lights_punctual.lights[i].extras.diptych.angle: rad    of a directional light
//
// What is wrong with one leaves it out with a note.
struct LightExtras {
    struct Hung {
        std::string who;  // "scene 0: extras: diptych: light 2"
        Light light;
        int node = -1;  // the file's index, one of its nodes; -1: in world space
    };
    struct OfScene {
        std::vector<Hung> lights;
        std::vector<std::string> notes;
    };
    struct OfLight {
        float angle = 0;
        std::vector<std::string> notes;
    };
    std::map<std::size_t, OfScene> scenes;  // that have any
    std::map<std::size_t, OfLight> lights;
};

// `document` may still be anything.
LightExtras lightExtras(const nlohmann::json& document);

class NoteList;

// To light `index` of KHR_lights_punctual what its extras say, to the scene the lights of those of the file's
// scene `index`. `place` of each of the file's nodes is that in Scene::nodes, -1: not there.
void addExtras(const LightExtras& extras, std::size_t index, Light& light, NoteList& notes);
void hangLights(const LightExtras& extras, std::size_t index, const std::vector<int>& place, Scene& scene,
                NoteList& notes);

}  // namespace diptych::gltf
