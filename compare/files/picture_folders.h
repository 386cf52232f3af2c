// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Image files of two folders by relative name ("a/lit.exr"), sorted.
struct PictureFolders {
    std::vector<std::string> both, reference_alone, test_alone;
};

// Searches both folders recursively. Skips hidden files and other file types. Throws std::runtime_error,
// one line, if a folder is unreadable or there is no common name.
PictureFolders pictureFolders(const std::filesystem::path& reference, const std::filesystem::path& test);

}  // namespace diptych
