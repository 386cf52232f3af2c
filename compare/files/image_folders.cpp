// SPDX-License-Identifier: MIT
#include "compare/files/image_folders.h"

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

bool isImage(const fs::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::ranges::count(endings, ending) > 0;
}

std::vector<std::string> imagesIn(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const bool hidden = at->path().filename().string().starts_with('.');
        std::error_code ignored;
        if (hidden && at->is_directory(ignored)) at.disable_recursion_pending();
        if (!hidden && isImage(at->path()) && at->is_regular_file(ignored))
            names.push_back(at->path().lexically_relative(folder).generic_string());
    }
    if (error) throw std::runtime_error(fmt::format("{}: {}", folder.string(), error.message()));
    std::ranges::for_each(names, refuseLineBreak);
    std::ranges::sort(names);
    return names;
}

// The name with each letter beyond ASCII, composed or with combining marks, as '?'. Without Unicode's
// tables two letters with marks are not told apart. Jamo and kana marks count, too.
std::string withoutForm(std::string_view name) {
    std::string out;
    while (!name.empty()) {
        const auto [code, size] = characterAt(name);
        const bool mark = (code >= 0x300 && code <= 0x36f) || (code >= 0x1160 && code <= 0x11ff) ||
                          code == 0x3099 || code == 0x309a;
        if (mark && !out.empty())
            out.back() = '?';
        else
            out += size == 1 ? name.front() : '?';
        name.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return out;
}

}  // namespace

std::string otherForm(std::string_view name, const std::vector<std::string>& names) {
    const std::string mine = withoutForm(name);
    if (mine == name) return {};
    const auto found = std::ranges::find_if(names, [&](const std::string& other) {
        // A form has as many characters as another only if it is the same.
        const auto starts = [](std::string_view text) {
            return std::ranges::count_if(text, [](unsigned char c) { return (c & 0xc0u) != 0x80u; });
        };
        return starts(other) != starts(name) && withoutForm(other) == mine;
    });
    return found == names.end() ? std::string() : *found;
}

ImageFolders imageFolders(const fs::path& reference, const fs::path& test) {
    const std::vector<std::string> left = imagesIn(reference), right = imagesIn(test);
    ImageFolders result;
    std::ranges::set_intersection(left, right, std::back_inserter(result.both));
    std::ranges::set_difference(left, right, std::back_inserter(result.reference_alone));
    std::ranges::set_difference(right, left, std::back_inserter(result.test_alone));
    if (result.both.empty()) {
        const bool form = std::ranges::any_of(
            left, [&](const std::string& name) { return !otherForm(name, right).empty(); });
        throw std::runtime_error(fmt::format(
            "{} and {} share no picture name ({} and {} pictures){}", reference.string(), test.string(),
            left.size(), right.size(),
            form ? "; some seem to differ in Unicode form only (composed or decomposed); rename them" : ""));
    }
    return result;
}

}  // namespace diptych
