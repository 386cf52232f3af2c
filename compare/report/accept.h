// SPDX-License-Identifier: MIT
// Rules that accept the differences of a report, for --tolerances.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace diptych {

struct Acceptance {
    std::filesystem::path report;  // its folder or its report.json
    std::string scene, channel;    // empty: all failing ones
    std::string because;           // empty: names the report
};

// Adds a rule for each failing channel of each scene to the file; rules for the same are replaced. Returns
// their number. Throws std::runtime_error, one line, if nothing fails, or fails in a way that no rule can
// accept.
std::size_t acceptDifferences(const Acceptance& accepted, const std::filesystem::path& out);

}  // namespace diptych
