// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace diptych {

// Scenes that the words of a command line select, in order, without duplicates.
//   a folder        .gltf and .glb files in it and below, sorted by name; hidden ones are skipped
//   a pattern       files with matching names: * and ? and [...] within a name, ** any folders. A matching
//                   folder counts as above. Names that exist as such, and FILE?scene=NAME, are no patterns
//   @LIST           lines of a file: each is any of these, relative to the list's folder. Comments begin with
//                   a # at the start of a line or after a space; empty lines are skipped
//   anything else   itself: a file, whether or not it exists, or builtin:NAME
// Throws std::runtime_error, one line, if a folder or list is unreadable or has no scene, a pattern matches
// nothing, or a list contains itself.
std::vector<std::string> scenesOf(const std::vector<std::string>& words);

}  // namespace diptych
