// SPDX-License-Identifier: MIT
#include "compare/cli/verdict_options.h"

#include <fmt/ranges.h>

namespace diptych::cli {

void WordList::put(const char* option, const std::string& value) {
    if (value.starts_with('-'))
        words.push_back(fmt::format("{}={}", option, value));
    else
        words.insert(words.end(), {option, value});
}

void WordList::add(const SelectionOptions& selection) {
    add("--mask", selection.mask);
    if (!selection.ids.empty()) put("--ids", fmt::format("{}", fmt::join(selection.ids, ",")));
    add("--ignore-edges", selection.ignore_edges);
    if (const auto& crop = selection.crop)
        put("--crop", fmt::format("{},{},{}x{}", crop->x, crop->y, crop->width, crop->height));
}

}  // namespace diptych::cli
