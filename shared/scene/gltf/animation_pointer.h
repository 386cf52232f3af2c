// SPDX-License-Identifier: MIT
// KHR_animation_pointer: which property of the file a JSON pointer names. Source: Khronos, glTF 2.0 Asset
// Object Model Specification, 2023, and RFC 6901.
#pragma once

#include "shared/scene/model/motion.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// What a channel moves, with the file's indices.
struct ChannelTarget {
    AnimatedPart part = AnimatedPart::translation;
    int object = -1;     // node, mesh, light, camera or material
    int element = 0;     // morph target or texture slot (SLOT_*); 0 for others
    bool effect = true;  // false of what cannot change a pixel, as the roughness of an unlit material
    auto operator<=>(const ChannelTarget&) const = default;
};

// Throws std::runtime_error, "WHO: ...", for a pointer that leads nowhere or to what is not modelled. A
// property of an object that the file leaves out is read as its default (the extension asks for the object to
// be there); one without a default (zfar, range) must be there.
ChannelTarget pointerTarget(const tinygltf::Model& model, const std::string& pointer, const std::string& who);

// tinygltf drops channels without a node: gives those of pointers node 0, which is not read.
void keepPointerChannels(nlohmann::json& document);

}  // namespace diptych::gltf
