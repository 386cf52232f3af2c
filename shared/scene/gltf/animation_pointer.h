// SPDX-License-Identifier: MIT
// Resolves JSON pointers of KHR_animation_pointer. Source: Khronos, glTF 2.0 Asset Object Model
// Specification, 2023, and RFC 6901.
#pragma once

#include "shared/scene/model/motion.h"

#include <string>

namespace diptych::gltf {

struct Model;

// The target of a channel, by the file's indices.
struct ChannelTarget {
    AnimatedPart part = AnimatedPart::translation;
    int object = -1;     // index of a node, mesh, light, camera or material
    int element = 0;     // morph target or texture slot (SLOT_*); else 0
    bool effect = true;  // false if it cannot change a pixel, such as the roughness of an unlit material
    auto operator<=>(const ChannelTarget&) const = default;
};

// Throws std::runtime_error, "WHO: ...", for a pointer that resolves to nothing or to an unsupported
// property. If the object of a property is missing, its default applies, although the extension requires
// the object. A property without a default (zfar, range) must exist.
ChannelTarget pointerTarget(const Model& model, const std::string& pointer, const std::string& who);

}  // namespace diptych::gltf
