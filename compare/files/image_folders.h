// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// Image files of two folders by relative name ("a/lit.exr"), sorted.
struct ImageFolders {
    std::vector<std::string> both, reference_alone, test_alone;
};

// Searches both folders recursively. Skips hidden files and other file types. Throws std::runtime_error,
// one line, if a folder is unreadable or there is no common name.
ImageFolders imageFolders(const std::filesystem::path& reference, const std::filesystem::path& test);

// The first of `names` that seems to be this name in another Unicode form (composed or decomposed); "" if
// none is.
std::string otherForm(std::string_view name, const std::vector<std::string>& names);

}  // namespace diptych
