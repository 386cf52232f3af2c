// SPDX-License-Identifier: MIT
#include "compare/files/picture_folders.h"

#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace diptych {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> endings{".exr", ".png",  ".hdr", ".pfm",
                                                  ".tif", ".tiff", ".jpg", ".jpeg"};

bool isPicture(const fs::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::ranges::count(endings, ending) > 0;
}

std::vector<std::string> picturesIn(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const bool hidden = at->path().filename().string().starts_with('.');
        std::error_code ignored;
        if (hidden && at->is_directory(ignored)) at.disable_recursion_pending();
        if (!hidden && isPicture(at->path()) && at->is_regular_file(ignored))
            names.push_back(at->path().lexically_relative(folder).generic_string());
    }
    if (error) throw std::runtime_error(fmt::format("{}: {}", folder.string(), error.message()));
    std::ranges::for_each(names, refuseLineBreak);
    std::ranges::sort(names);
    return names;
}

}  // namespace

PictureFolders pictureFolders(const fs::path& reference, const fs::path& test) {
    const std::vector<std::string> left = picturesIn(reference), right = picturesIn(test);
    PictureFolders result;
    std::ranges::set_intersection(left, right, std::back_inserter(result.both));
    std::ranges::set_difference(left, right, std::back_inserter(result.reference_alone));
    std::ranges::set_difference(right, left, std::back_inserter(result.test_alone));
    if (result.both.empty())
        throw std::runtime_error(fmt::format("{} and {} share no picture name ({} and {} pictures)",
                                             reference.string(), test.string(), left.size(), right.size()));
    return result;
}

}  // namespace diptych
