// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/animation_pointer.h"

#include "shared/scene/gltf/model.h"
#include "shared/scene/gltf/motion.h"
#include "shared/scene/gltf/properties.h"
#include "shared/scene/gltf/value.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace diptych::gltf {

using Json = nlohmann::json;

namespace {

// RFC 6901: no sign, no leading zero.
std::optional<int> indexOf(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text[0] == '-') return std::nullopt;
    if (text.size() > 1 && text[0] == '0') return std::nullopt;
    return value;
}

bool isWeights(const std::optional<AnimatedPart>& part) {
    return part == AnimatedPart::weights || part == AnimatedPart::mesh_weights;
}

// A pointer's property in the schema's tables (properties.h). No name in them needs the escapes ~0 and ~1.
struct Match {
    AnimatedPart part = {};
    std::size_t slot = gpu::SLOT_COUNT;  // SLOT_* and pointer of the texture that the property belongs to
    std::string texture = {};
    std::vector<int> indices = {};
};

std::optional<Match> matchOf(std::string_view pointer) {
    if (!pointer.starts_with('/')) return {};
    Match match;
    const schema::Property* property = nullptr;
    bool indexed = false;  // whether the last token was an index
    for (std::size_t at = 0; at < pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
        const std::string_view token = pointer.substr(at + 1, end - at - 1);
        const bool list = property && (property->kind == schema::Kind::objects || isWeights(property->part));
        at = end;
        if (list && !indexed) {
            const std::optional<int> index = indexOf(token);
            if (!index) return {};
            match.indices.push_back(*index);
            indexed = true;
            continue;
        }
        const std::span<const schema::Property> members = property ? property->properties : schema::document;
        const auto member = std::ranges::find(members, token, &schema::Property::key);
        if (member == members.end()) return {};
        property = &*member;
        indexed = false;
        if (property->slot == gpu::SLOT_COUNT) continue;
        match.slot = property->slot;
        match.texture = pointer.substr(0, end);
    }
    if (!property || !property->part) return {};
    match.part = !indexed                                  ? *property->part
                 : property->part == AnimatedPart::weights ? AnimatedPart::weight
                                                           : AnimatedPart::mesh_weight;
    return match;
}

class Resolver {
public:
    Resolver(const Model& model, const std::string& pointer, const std::string& who)
        : model_(model), pointer_(oneLine(pointer)), who_(who) {}

    ChannelTarget resolve(const Match& match) const {
        ChannelTarget target{match.part, match.indices[0], 0};
        if (isNodePart(match.part))
            weightOf(targetsOf(model_, item(model_.nodes, target.object)), match, target);
        else if (isMeshPart(match.part))
            weightOf(targetsOf(item(model_.meshes, target.object)), match, target);
        else if (isLightPart(match.part))
            light(item(arrayAt(model_.rest, "/extensions/KHR_lights_punctual/lights"), target.object),
                  target);
        else if (isCameraPart(match.part))
            camera(item(model_.cameras, target.object), target);
        else
            material(item(arrayAt(model_.rest, "/materials"), target.object), match, target);
        return target;
    }

private:
    const Model& model_;
    std::string pointer_;
    const std::string& who_;

    [[noreturn]] void wrong(const std::string& why) const {
        fail(who_, fmt::format("pointer \"{}\": {}", pointer_, why));
    }

    template <class Items>
    const typename Items::value_type& item(const Items& items, int index) const {
        if (static_cast<std::size_t>(index) >= items.size())
            wrong(fmt::format("the file has {}", items.size()));
        return items[static_cast<std::size_t>(index)];
    }

    void weightOf(std::size_t targets, const Match& match, ChannelTarget& target) const {
        if (match.indices.size() < 2) return;
        if (static_cast<std::size_t>(match.indices[1]) >= targets)
            wrong(fmt::format("the mesh has {} morph targets", targets));
        target.element = match.indices[1];
    }

    void light(const Json& light, ChannelTarget& target) const {
        const bool cone =
            target.part == AnimatedPart::light_inner_cone || target.part == AnimatedPart::light_outer_cone;
        if (cone) target.effect = light["type"] == "spot";
        if (target.part != AnimatedPart::light_range) return;
        target.effect = light["type"] != "directional";
        if (!memberOf(light, "range")) wrong("the light has no range");
    }

    void camera(const tinygltf::Camera& camera, const ChannelTarget& target) const {
        const bool perspective = camera.type == "perspective";
        if (perspective != (pointer_.find("/perspective/") != pointer_.npos))
            wrong(fmt::format("the camera is {}", oneLine(camera.type)));
        if (target.part == AnimatedPart::camera_far && perspective && camera.perspective.zfar == 0)
            wrong("the camera has no zfar");
        if (target.part == AnimatedPart::camera_aspect && camera.perspective.aspectRatio == 0)
            wrong("the camera has no aspectRatio");
    }

    void material(const Json& material, const Match& match, ChannelTarget& target) const {
        const bool unlit = extension(material, "KHR_materials_unlit"),
                   glossy = extension(material, "KHR_materials_pbrSpecularGlossiness"),
                   ofGlossy = names("/KHR_materials_pbrSpecularGlossiness/");
        if (ofGlossy && !glossy) wrong("the material has no KHR_materials_pbrSpecularGlossiness");
        const bool transform = target.part >= AnimatedPart::texture_offset;
        if (!match.texture.empty() && !model_.rest.contains(Json::json_pointer(match.texture)))
            wrong("the material has no such texture");
        if (transform) target.element = static_cast<int>(match.slot);
        target.effect = !unlit || target.part == AnimatedPart::base_color ||
                        target.part == AnimatedPart::alpha_cutoff ||
                        (transform && match.slot == gpu::SLOT_base_color);
        // Specular-glossiness replaces the core model and its extensions; unlit replaces both.
        const bool ofOthers = names("/pbrMetallicRoughness/") ||
                              (names("/KHR_materials_") && !names("/KHR_materials_emissive_strength/"));
        if (ofGlossy ? unlit : glossy && !unlit && ofOthers) target.effect = false;
    }

    bool names(std::string_view part) const { return pointer_.find(part) != pointer_.npos; }
};

}  // namespace

ChannelTarget pointerTarget(const Model& model, const std::string& pointer, const std::string& who) {
    const std::optional<Match> match = matchOf(pointer);
    if (!match)
        fail(who,
             fmt::format("pointer \"{}\" names a property that cannot be animated here", oneLine(pointer)));
    return Resolver(model, pointer, who).resolve(*match);
}

}  // namespace diptych::gltf
