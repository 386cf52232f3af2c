// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/extras.h"

#include "shared/scene/gltf/value.h"
#include "shared/scene/lights/json_fields.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/scene/model/animated.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string_view>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;

constexpr const char* extras_key = "diptych";
constexpr double maxCount = 2147483647;

// The object "diptych" in the "extras" of `owner`. Keys that are not `known` get a note.
const Json* diptychExtras(const Json& owner, std::initializer_list<std::string_view> known,
                          const std::string& who, NoteList& notes) {
    const Json* extras = memberOf(owner, "extras");
    const Json* own = extras ? memberOf(*extras, extras_key) : nullptr;
    if (!own) return nullptr;
    if (!own->is_object()) {
        notes.add(who + ": is not an object: left out");
        return nullptr;
    }
    for (const auto& item : own->items())
        if (std::ranges::find(known, item.key()) == known.end())
            notes.add(fmt::format("{}: {}: is ignored", who, oneLine(item.key())));
    return own;
}

// Removes "node" from `object` and returns its value; -1 if absent.
int takeNode(Json& object, std::size_t nodes, const std::string& who) {
    const auto at = object.find("node");
    if (at == object.end()) return -1;
    const double index = at->is_number() ? at->get<double>() : -1;
    if (!(index >= 0 && index < static_cast<double>(nodes) && index == std::floor(index)))
        fail(who, fmt::format("node: is not an index of the {} nodes", nodes));
    object.erase(at);
    return static_cast<int>(index);
}

}  // namespace

void addExtras(const Json& file, int index, Light& light, NoteList& notes) {
    const std::string who = fmt::format("light {}: extras: {}", index, extras_key);
    const Json* own = diptychExtras(file, {"angle", "importance", "shadow"}, who, notes);
    if (!own) return;
    const JsonFields fields(*own, who);
    readOrNote(notes, [&] { light.importance = importanceOf(fields); });
    if (memberOf(*own, "shadow"))
        readOrNote(notes, [&] {
            if (light.kind != LightKind::point && light.kind != LightKind::spot)
                fields.fail("shadow", "applies only to point and spot lights");
            light.shadow = fields.flag("shadow", false);
        });
    if (memberOf(*own, "angle"))
        readOrNote(notes, [&] {
            if (light.kind != LightKind::directional)
                fields.fail("angle", "applies only to directional lights");
            light.angle = sunAngle(fields);
        });
}

void attachLights(const Json& file, int index, const std::vector<int>& node_index, Scene& scene,
                  NoteList& notes) {
    const std::string who = fmt::format("scene {}: extras: {}", index, extras_key);
    const Json* own = diptychExtras(file, {"lights"}, who, notes);
    const Json* lights = own ? memberOf(*own, "lights") : nullptr;
    if (!lights) return;
    if (!lights->is_array()) return notes.add(who + ": lights: is not an array: left out");
    for (std::size_t i = 0; i < lights->size(); ++i)
        readOrNote(notes, [&] {
            const std::string name = fmt::format("{}: light {}", who, i);
            Json object = (*lights)[i];
            const int node = takeNode(object, node_index.size(), name);
            Light light = lightFromJson(object, name);
            if (node >= 0) {
                light.node = node_index[static_cast<std::size_t>(node)];
                if (light.node < 0) fail(name, fmt::format("node: {} is not in the scene", node));
                if (light.name.empty()) light.name = scene.nodes[static_cast<std::size_t>(light.node)].name;
            }
            scene.lights.push_back(std::move(light));
        });
}

Lightmap lightmapOf(const Json& material, std::size_t textures, const std::string& material_name,
                    NoteList& notes) {
    Lightmap result;
    const std::string who = fmt::format("{}: extras: {}", material_name, extras_key);
    const Json* own = diptychExtras(material, {"lightmap"}, who, notes);
    if (const Json* found = own ? memberOf(*own, "lightmap") : nullptr)
        readOrNote(notes, [&] {
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
            const double intensity =
                fields.number("intensity", 1, 0, propertiesOf(AnimatedPart::lightmap_intensity).max);
            const int texcoord = whole("texCoord", 1, 2);
            result = {whole("index", 0, static_cast<double>(textures)), texcoord, intensity};
        });
    return result;
}

}  // namespace diptych::gltf
