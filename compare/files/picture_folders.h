// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// The picture files of two folders, by their names relative to them ("a/lit.exr"), sorted.
struct PictureFolders {
    std::vector<std::string> both, reference_alone, test_alone;
};

// Of the folders and all below; files whose ending is none of a picture that is read, and hidden ones, are
// left out. Throws std::runtime_error, one line, where a folder cannot be read or the two share no picture.
PictureFolders pictureFolders(const std::filesystem::path& reference, const std::filesystem::path& test);

}  // namespace diptych
