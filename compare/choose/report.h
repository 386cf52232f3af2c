// SPDX-License-Identifier: MIT
// A choice for people and scripts: in words, as JSON and as a page.
#pragma once

#include "compare/choose/search.h"
#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace diptych::choose {

// The chosen Settings from a camera that they were not chosen on.
struct UnseenCamera {
    std::string camera;
    double error = 0;
    bool holds = true;  // within the error of the budget; without one, no more than half as large again
};

struct ChoiceReport {
    std::string scene;
    std::vector<std::string> cameras;  // their titles
    Settings given;
    Budget budget;
    std::string figure, figure_name;  // "FLIP", "flip"
    ReportDevice device;
    Choice choice;
    // Of each candidate: its Settings in words; and the command that draws it.
    std::vector<std::string> words, commands;
    std::vector<UnseenCamera> unseen;  // cameras of the scene that were not asked for
    std::vector<std::string> notes{};
    // Effects on passes that earlier choices on this device taught.
    std::size_t known_effects = 0;
    double seconds = 0;
};

// "the fastest with FLIP at most 0.01"
std::string goalInWords(const ChoiceReport& report);
// For a terminal; ends with a new line.
std::string inWords(const ChoiceReport& report);
nlohmann::ordered_json toJson(const ChoiceReport& report);

}  // namespace diptych::choose
