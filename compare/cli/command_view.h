// SPDX-License-Identifier: MIT
// Options of `view`: those of compare, and its own.
#pragma once

#include "compare/cli/command_compare.h"

namespace diptych::cli {

struct ViewLine : CompareLine {
    std::filesystem::path report;  // folder of a compare report; empty: none
    bool watch = false;
};

// Parses the words of a comparison in a report ("compare ...") as words of `view`. Reports are untrusted
// input: only the scene, Settings and options that influence a verdict are read. Output paths and external
// renderers are skipped. Any other option throws std::runtime_error naming it.
ViewLine parseReported(const std::vector<std::string>& words);

}  // namespace diptych::cli
