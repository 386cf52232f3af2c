// SPDX-License-Identifier: MIT
// Moves a report's files one by one into a folder that also holds other files: either all of them or none.
#pragma once

#include "shared/image/temporary.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

struct FileMoves {
    std::vector<std::string> files;    // to be moved into place
    std::vector<std::string> earlier;  // to be removed where they are not among `files`
};

// Writes the list of moves into `made`, a folder inside `folder`, and renames it to the name that
// finishMoves() looks for; from then on the new files count. Then moves the files, and undoes all moves if
// one fails. Throws std::runtime_error naming the file.
void moveFiles(const std::filesystem::path& folder, Temporary& made, const FileMoves& moves);

// Whether a program was killed during moveFiles(), or is in it now.
bool isMoveBegun(const std::filesystem::path& folder);

// Finishes moves that were begun and neither finished nor undone. Throws std::runtime_error naming the file.
void finishMoves(const std::filesystem::path& folder);

}  // namespace diptych
