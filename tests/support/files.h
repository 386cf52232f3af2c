// SPDX-License-Identifier: MIT
// Helpers for files in tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// Folder of the running test, with its contents.
inline std::filesystem::path testFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / "diptych" / test->test_suite_name() / test->name();
    std::filesystem::create_directories(path);
    return path;
}
// The same folder, emptied.
inline std::filesystem::path folder() {
    std::filesystem::remove_all(testFolder());
    return testFolder();
}

inline std::string contentsOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return std::move(text).str();
}

// All names in the folder, including hidden ones, sorted.
inline std::vector<std::string> namesIn(const std::filesystem::path& path) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path))
        names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
}

// Paths of all files below the folder, sorted: "a.txt", "inner/b.txt".
inline std::vector<std::string> filesIn(const std::filesystem::path& path) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
        if (!entry.is_directory()) names.push_back(entry.path().lexically_relative(path).string());
    std::ranges::sort(names);
    return names;
}

}  // namespace diptych
