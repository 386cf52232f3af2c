// SPDX-License-Identifier: MIT
#pragma once

#include "compare/verdict/comparison.h"
#include "compare/verdict/image_diff.h"

#include <string>
#include <vector>

namespace diptych {

// Every metric of every channel; those of the deciding channel are at the top. Ends in a newline.
std::string imageDiffJson(const ImageDiff& diff);

// The result of comparing two folders.
struct FolderDiff {
    std::string reference, test;
    std::vector<ImageDiff> images;
    std::vector<std::string> reference_alone, test_alone;  // unmatched names, each a failure
    std::vector<SceneError> errors;                        // pairs that could not be compared

    bool passed() const;
    std::vector<SceneError> failures() const;  // for the unmatched names
};
std::string folderDiffJson(const FolderDiff& diff);

}  // namespace diptych
