// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace diptych {

// The scenes that the words of a command line mean, in their order, each once.
//   a folder        the .gltf and .glb files in it and below, sorted by name, hidden ones left out
//   a pattern       those whose names match: * and ? and [...] within a name, ** any folders; a folder that
//                   matches stands for what is in it. What is there under the very name is no pattern, and
//                   FILE?scene=NAME is none
//   @LIST           the lines of a file: each is any of these, relative to the list's folder; empty lines and
//                   what follows a # at the beginning of a line or behind a space are left out
//   anything else   itself: a file, whether or not it is there, or builtin:NAME
// Throws std::runtime_error, one line, where a folder or list cannot be read or names no scene, a pattern
// matches none, or a list contains itself.
std::vector<std::string> scenesOf(const std::vector<std::string>& words);

}  // namespace diptych
