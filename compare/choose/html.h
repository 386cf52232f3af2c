// SPDX-License-Identifier: MIT
#pragma once

#include "compare/choose/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::choose {

// index.html of a choice: one page without external resources, readable from file://. `files`: others of the
// folder, which it links.
std::string choiceHtml(const Choices& choices, const std::vector<std::string>& files);

inline constexpr const char* choiceManifest = "choice.json";

// Writes the folder: the page, choice.json, settings.json where something fits, and of several scenes each
// one's plot and Settings. Throws std::runtime_error naming -o where something else is there.
void writeChoice(const Choices& choices, const std::filesystem::path& folder, bool force);

}  // namespace diptych::choose
