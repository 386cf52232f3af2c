// SPDX-License-Identifier: MIT
// Rules of glTF over several properties, checked after types and ranges.
#pragma once

#include "shared/scene/gltf/note_list.h"
#include "shared/scene/gltf/references.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace diptych::gltf {

// Checks one item of a collection, named `who` in messages. Removes a faulty property with a note if the
// item is valid without it; otherwise throws std::runtime_error.
void checkRules(std::string_view collection, nlohmann::json& item, const std::string& who, NoteList& notes);

// Checks byteStride of every bufferView. Removes 0, and the stride of tightly packed indices, with a note.
// Other invalid strides mark the view as broken.
void checkStrides(nlohmann::json& document, References& references, NoteList& notes);

// Replaces broken items by empty ones if no scene needs them or they are meshes, each with a note; indices
// stay valid. Removes broken cameras and skins from nodes. Returns the faults of meshes by index. Throws
// std::runtime_error with the first fault that affects a scene otherwise.
std::map<std::size_t, std::string> leaveOutUnusable(nlohmann::json& document, const References& references,
                                                    NoteList& notes);

}  // namespace diptych::gltf
