// SPDX-License-Identifier: MIT
// Moving a report's files into a folder that holds files of others, one by one: all of them or none.
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

// `made`, in `folder`, gets the plan written into it and is renamed to what finishMoves() looks for: from
// then on the new files count. What fails after that is undone. Throws std::runtime_error naming the file.
void moveFiles(const std::filesystem::path& folder, Temporary& made, const FileMoves& moves);

// A program was killed while it carried out its plan, or is at it now.
bool isMoveBegun(const std::filesystem::path& folder);

// Carries out a plan that was begun and not undone. Throws std::runtime_error naming the file.
void finishMoves(const std::filesystem::path& folder);

}  // namespace diptych
