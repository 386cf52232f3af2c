// SPDX-License-Identifier: MIT
// Rules of glTF that involve several properties, checked after types and ranges.
#pragma once

#include "shared/scene/gltf/note_list.h"
#include "shared/scene/gltf/references.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace diptych::gltf {

// Checks the rules for one item of a collection, called `who` in messages. A property that breaks a rule is
// removed with a note if the item makes sense without it; otherwise throws std::runtime_error.
void checkRules(std::string_view collection, nlohmann::json& item, const std::string& who, NoteList& notes);

// Checks byteStride of every bufferView: 0, and the stride of tightly packed indices, are removed with a
// note; other strides that glTF does not allow mark the view as broken.
void checkStrides(nlohmann::json& document, References& references, NoteList& notes);

// Replaces broken items that no scene needs, and meshes, by empty ones (so that later items keep their
// indices), each with a note. Nodes lose a broken camera or skin. Returns the faults of meshes by their
// index. Throws std::runtime_error with the first fault that affects a scene otherwise.
std::map<std::size_t, std::string> leaveOutUnusable(nlohmann::json& document, const References& references,
                                                    NoteList& notes);

}  // namespace diptych::gltf
