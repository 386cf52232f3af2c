// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace diptych {

// Scenes as the command line names them, in its order; a folder stands for the .gltf and .glb files in it and
// below, sorted by name, hidden ones left out. Throws std::runtime_error, one line, where a folder cannot be
// read or holds none.
std::vector<std::string> withFoldersOpened(const std::vector<std::string>& scenes);

}  // namespace diptych
