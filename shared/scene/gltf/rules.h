// SPDX-License-Identifier: MIT
// What glTF says of several properties together, where types and ranges are right already.
#pragma once

#include "shared/scene/gltf/note_list.h"
#include "shared/scene/gltf/references.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace diptych::gltf {

// Of one item of a collection, `who` in a line: what is against them is taken out with a note where the item
// makes sense without it. Throws std::runtime_error where it does not.
void checkRules(std::string_view collection, nlohmann::json& item, const std::string& who, NoteList& notes);

// byteStride of every bufferView: 0 and that of packed indices are taken out with a note, others that glTF
// does not allow make the view a broken one.
void checkStrides(nlohmann::json& document, References& references, NoteList& notes);

// Puts empty items, so that those after them keep their numbers, in the place of what is broken and no scene
// needs, and notes it. Nodes lose their camera or skin where it is such. Throws std::runtime_error: the first
// fault of what a scene needs.
void leaveOutUnusable(nlohmann::json& document, const References& references, NoteList& notes);

}  // namespace diptych::gltf
