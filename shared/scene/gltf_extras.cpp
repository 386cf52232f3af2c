// SPDX-License-Identifier: MIT
#include "shared/scene/gltf_extras.h"

#include "shared/scene/gltf_note_list.h"
#include "shared/scene/json_fields.h"
#include "shared/scene/lights_json.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;
using Notes = std::vector<std::string>;

constexpr const char* ours = "diptych";

const Json* memberOf(const Json& object, const char* key) {
    const auto at = object.find(key);  // the end where it is no object
    return at == object.end() ? nullptr : &*at;
}

// What "extras" of `owner` hold of ours under `key`; what else is there is noted.
const Json* ourExtra(const Json& owner, const char* key, const std::string& who, Notes& notes) {
    const Json* extras = memberOf(owner, "extras");
    const Json* own = extras ? memberOf(*extras, ours) : nullptr;
    if (!own) return nullptr;
    if (!own->is_object()) {
        notes.push_back(who + ": is not an object: left out");
        return nullptr;
    }
    for (const auto& item : own->items())
        if (item.key() != key) notes.push_back(fmt::format("{}: {}: is not read", who, oneLine(item.key())));
    return memberOf(*own, key);
}

// "node" of `object`, which loses it.
int takeNode(Json& object, std::size_t nodes, const std::string& who) {
    const auto at = object.find("node");
    if (at == object.end()) return -1;
    const double index = at->is_number() ? at->get<double>() : -1;
    if (!(index >= 0 && index < static_cast<double>(nodes) && index == std::floor(index)))
        throw std::runtime_error(fmt::format("{}: node: is not the index of one of {} nodes", who, nodes));
    object.erase(at);
    return static_cast<int>(index);
}

LightExtras::OfScene ofScene(const Json& scene, std::size_t nodes, const std::string& who) {
    LightExtras::OfScene result;
    const Json* lights = ourExtra(scene, "lights", who, result.notes);
    if (lights && !lights->is_array()) result.notes.push_back(who + ": lights: is not an array: left out");
    if (!lights || !lights->is_array()) return result;
    for (std::size_t i = 0; i < lights->size(); ++i) try {
            LightExtras::Hung hung{fmt::format("{}: light {}", who, i), {}, -1};
            Json object = (*lights)[i];
            hung.node = takeNode(object, nodes, hung.who);
            hung.light = lightFromJson(object, hung.who);
            result.lights.push_back(std::move(hung));
        } catch (const std::runtime_error& e) {
            result.notes.push_back(std::string(e.what()) + ": left out");
        }
    return result;
}

LightExtras::OfLight ofLight(const Json& light, const std::string& who) {
    LightExtras::OfLight result;
    if (!ourExtra(light, "angle", who, result.notes)) return result;
    try {
        const Json* type = memberOf(light, "type");
        if (!type || *type != "directional")
            throw std::runtime_error(who + ": angle: belongs to directional lights");
        result.angle = sunAngle(JsonFields(light["extras"][ours], who));
    } catch (const std::runtime_error& e) {
        result.notes.push_back(std::string(e.what()) + ": left out");
    }
    return result;
}

const Json& arrayAt(const Json& document, const char* place) {
    static const Json none = Json::array();
    const Json::json_pointer pointer(place);
    return document.contains(pointer) && document[pointer].is_array() ? document[pointer] : none;
}

}  // namespace

LightExtras lightExtras(const Json& document) {
    LightExtras result;
    const std::size_t nodes = arrayAt(document, "/nodes").size();
    const Json &scenes = arrayAt(document, "/scenes"),
               &lights = arrayAt(document, "/extensions/KHR_lights_punctual/lights");
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        LightExtras::OfScene found = ofScene(scenes[i], nodes, fmt::format("scene {}: extras: {}", i, ours));
        if (!found.lights.empty() || !found.notes.empty()) result.scenes[i] = std::move(found);
    }
    for (std::size_t i = 0; i < lights.size(); ++i) {
        LightExtras::OfLight found = ofLight(lights[i], fmt::format("light {}: extras: {}", i, ours));
        if (found.angle > 0 || !found.notes.empty()) result.lights[i] = std::move(found);
    }
    return result;
}

void addExtras(const LightExtras& extras, std::size_t index, Light& light, NoteList& notes) {
    const auto found = extras.lights.find(index);
    if (found == extras.lights.end()) return;
    for (const std::string& note : found->second.notes) notes.add(note);
    if (light.kind == LightKind::directional) light.angle = found->second.angle;  // a broken one is a point
}

void hangLights(const LightExtras& extras, std::size_t index, const std::vector<int>& place, Scene& scene,
                NoteList& notes) {
    const auto found = extras.scenes.find(index);
    if (found == extras.scenes.end()) return;
    for (const std::string& note : found->second.notes) notes.add(note);
    for (const LightExtras::Hung& hung : found->second.lights) {
        Light light = hung.light;
        light.node = hung.node < 0 ? -1 : place[static_cast<std::size_t>(hung.node)];
        if (hung.node >= 0 && light.node < 0) {
            notes.add(fmt::format("{}: node: {} is not in the scene: left out", hung.who, hung.node));
            continue;
        }
        if (light.name.empty() && light.node >= 0)
            light.name = scene.nodes[static_cast<std::size_t>(light.node)].name;
        scene.lights.push_back(std::move(light));
    }
}

}  // namespace diptych::gltf
