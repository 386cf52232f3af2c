// SPDX-License-Identifier: MIT
// Moves a report's files into a folder that also has other files, all or none.
#pragma once

#include "shared/image/temporary.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

struct FileMoves {
    std::vector<std::string> files;    // files to move into place
    std::vector<std::string> earlier;  // files to remove unless in `files`
};

// Writes the list of moves into `made`, a folder inside `folder`, and renames it to the name that
// finishMoves() expects. From then on the new files count. Then moves the files; undoes all moves if one
// fails. Throws std::runtime_error naming the file.
void moveFiles(const std::filesystem::path& folder, Temporary& made, const FileMoves& moves);

// Whether moveFiles() is in progress or was killed.
bool isMoveBegun(const std::filesystem::path& folder);

// Finishes interrupted moves. Throws std::runtime_error naming the file.
void finishMoves(const std::filesystem::path& folder);

}  // namespace diptych
