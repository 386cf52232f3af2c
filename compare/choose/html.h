// SPDX-License-Identifier: MIT
#pragma once

#include "compare/choose/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::choose {

// index.html of a choice: one page without external resources, works from file://. `files`: other files of
// the folder, linked by the page.
std::string choiceHtml(const Choices& choices, const std::vector<std::string>& files);

inline constexpr const char* choiceManifest = "choice.json";

// Writes the folder: page, choice.json, plots, and settings.json if something fits. With several scenes,
// each scene gets its plot and Settings. Throws std::runtime_error naming -o if the folder has other
// contents.
void writeChoice(const Choices& choices, const std::filesystem::path& folder, bool force);

}  // namespace diptych::choose
