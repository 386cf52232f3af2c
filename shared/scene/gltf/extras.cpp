// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/extras.h"

#include "shared/scene/gltf/note_list.h"
#include "shared/scene/gltf/unchecked.h"
#include "shared/scene/lights/json_fields.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string_view>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;
using Notes = std::vector<std::string>;

constexpr const char* ours = "diptych";
// maxIntensity keeps the product with any texel finite in float32.
constexpr double maxCount = 2147483647, maxIntensity = 1e12;

// The object "diptych" in the "extras" of `owner`. Keys that are not `known` get a note.
const Json* ourExtras(const Json& owner, std::initializer_list<std::string_view> known,
                      const std::string& who, Notes& notes) {
    const Json* extras = memberOf(owner, "extras");
    const Json* own = extras ? memberOf(*extras, ours) : nullptr;
    if (!own) return nullptr;
    if (!own->is_object()) {
        notes.push_back(who + ": is not an object: left out");
        return nullptr;
    }
    for (const auto& item : own->items())
        if (std::ranges::find(known, item.key()) == known.end())
            notes.push_back(fmt::format("{}: {}: is ignored", who, oneLine(item.key())));
    return own;
}

// The member `key` of that object; no other key is known.
const Json* ourExtra(const Json& owner, const char* key, const std::string& who, Notes& notes) {
    const Json* own = ourExtras(owner, {key}, who, notes);
    return own ? memberOf(*own, key) : nullptr;
}

// Removes "node" from `object` and returns its value; -1 if absent.
int takeNode(Json& object, std::size_t nodes, const std::string& who) {
    const auto at = object.find("node");
    if (at == object.end()) return -1;
    const double index = at->is_number() ? at->get<double>() : -1;
    if (!(index >= 0 && index < static_cast<double>(nodes) && index == std::floor(index)))
        throw std::runtime_error(fmt::format("{}: node: is not an index of the {} nodes", who, nodes));
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
    const Json* own = ourExtras(light, {"angle", "importance", "shadow"}, who, result.notes);
    if (!own) return result;
    const auto left = [&](const auto& read) {
        try {
            read();
        } catch (const std::runtime_error& e) {
            result.notes.push_back(std::string(e.what()) + ": left out");
        }
    };
    left([&] { result.importance = importanceOf(JsonFields(*own, who)); });
    const Json* type = memberOf(light, "type");
    if (memberOf(*own, "shadow"))
        left([&] {
            if (!type || (*type != "point" && *type != "spot"))
                throw std::runtime_error(who + ": shadow: applies only to point and spot lights");
            result.shadow = JsonFields(*own, who).flag("shadow", false);
        });
    if (!memberOf(*own, "angle")) return result;
    left([&] {
        if (!type || *type != "directional")
            throw std::runtime_error(who + ": angle: applies only to directional lights");
        result.angle = sunAngle(JsonFields(*own, who));
    });
    return result;
}

MaterialExtras::Lightmap lightmapOf(const Json& material, std::size_t textures, const std::string& who) {
    MaterialExtras::Lightmap result;
    const Json* found = ourExtra(material, "lightmap", who, result.notes);
    if (found) try {
            const JsonFields fields(*found, who + ": lightmap");
            constexpr std::array<std::string_view, 3> known{"index", "texCoord", "intensity"};
            fields.knownOnly(known, "a lightmap");
            const auto whole = [&](std::string_view key, double fallback, double end) {
                const double index = fields.number(key, fallback, 0, maxCount);
                if (!(index < end && index == std::floor(index)))
                    fields.fail(key, fmt::format("{:g} is not a whole number below {:g}", index, end));
                return static_cast<int>(index);
            };
            if (!fields.find("index")) fields.fail("index", "is missing; give a texture");
            const double intensity = fields.number("intensity", 1, 0, maxIntensity);
            const int texcoord = whole("texCoord", 1, 2);
            result.texture = whole("index", 0, static_cast<double>(textures));
            result.texcoord = texcoord;
            result.intensity = intensity;
        } catch (const std::runtime_error& e) {
            result.notes.push_back(std::string(e.what()) + ": left out");
        }
    return result;
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
        if (found.angle > 0 || found.importance != Importance::automatic || found.shadow ||
            !found.notes.empty())
            result.lights[i] = std::move(found);
    }
    return result;
}

MaterialExtras materialExtras(const Json& document) {
    MaterialExtras result;
    const Json& materials = arrayAt(document, "/materials");
    const std::size_t textures = arrayAt(document, "/textures").size();
    for (std::size_t i = 0; i < materials.size(); ++i) {
        MaterialExtras::Lightmap found =
            lightmapOf(materials[i], textures, fmt::format("material {}: extras: {}", i, ours));
        if (found.texture >= 0 || !found.notes.empty()) result.lightmaps[i] = std::move(found);
    }
    return result;
}

void addExtras(const LightExtras& extras, std::size_t index, Light& light, NoteList& notes) {
    const auto found = extras.lights.find(index);
    if (found == extras.lights.end()) return;
    for (const std::string& note : found->second.notes) notes.add(note);
    light.importance = found->second.importance;
    light.shadow = found->second.shadow;
    // A broken light became a point light.
    if (light.kind == LightKind::directional) light.angle = found->second.angle;
}

void attachLights(const LightExtras& extras, std::size_t index, const std::vector<int>& place, Scene& scene,
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
