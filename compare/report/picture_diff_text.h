// SPDX-License-Identifier: MIT
#pragma once

#include "compare/verdict/comparison.h"
#include "compare/verdict/picture_diff.h"

#include <string>
#include <vector>

namespace diptych {

// For a terminal: a line per channel, failures first, then one line of verdict. Ends in a newline.
std::string pictureDiffTable(const PictureDiff& diff);

// Every figure of every channel; those of the deciding channel stand at the top. Ends in a newline.
std::string pictureDiffJson(const PictureDiff& diff);

// What is said of two folders.
struct FolderDiff {
    std::string reference, test;
    std::vector<PictureDiff> pictures;
    std::vector<std::string> reference_alone, test_alone;  // names, each a failure
    std::vector<SceneError> errors;                        // pairs that could not be compared

    bool passed() const;
    std::vector<SceneError> failures() const;  // of the names that one folder lacks
};
std::string folderDiffTable(const FolderDiff& diff);
std::string folderDiffJson(const FolderDiff& diff);

}  // namespace diptych
