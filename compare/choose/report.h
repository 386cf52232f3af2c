// SPDX-License-Identifier: MIT
// A choice for people and scripts: in words, as JSON and as a page.
#pragma once

#include "compare/choose/common.h"
#include "compare/choose/deciders.h"
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

// --explain-choice: what of the scene decided between the paths.
struct DecidersReport {
    std::string chosen, other;            // Settings in words, of both paths
    std::string chosen_path, other_path;  // names
    bool other_fits = true;               // the budget
    Deciders deciders;
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
    std::optional<DecidersReport> deciders{};
    double seconds = 0;
};

// Of several scenes: the Settings for all of them.
struct CommonReport {
    std::vector<std::string> scenes;
    CommonChoice choice;
    // Of each candidate; SCENE stands in the command for any of them.
    std::vector<std::string> words, commands;
    double seconds = 0;
};

struct Choices {
    std::vector<ChoiceReport> scenes;  // at least one
    std::optional<CommonReport> all;   // of several
};

// Of the only scene, or for all; nothing where nothing fits.
std::optional<Settings> chosenSettings(const Choices& choices);

// "the fastest with FLIP at most 0.01"
std::string goalInWords(const ChoiceReport& report);
// For a terminal; ends with a new line.
std::string inWords(const ChoiceReport& report);
// `first`: any of its scenes, which says the budget.
std::string inWords(const CommonReport& report, const ChoiceReport& first);
// "takes 3.1 % longer (-0.5 % to +6.8 %)", "takes 0.5 % less time (-1.2 % to +0.3 %)".
std::string longerInWords(double ratio, double low, double high);
// Of one candidate: time, error and memory.
std::string figuresInWords(const ChoiceReport& report, std::size_t candidate);
const char* fateInWords(Fate fate);
// Why, who else, how sure, or by how much it is missed: a line each, without indentation.
std::vector<std::string> reasonsInWords(const ChoiceReport& report);
std::vector<std::string> reasonsInWords(const CommonReport& report, const ChoiceReport& first);
// A line on the two Settings, then the three properties that turn the choice first, two spaces before each.
std::vector<std::string> inWords(const DecidersReport& report);
nlohmann::ordered_json toJson(const DecidersReport& report);
nlohmann::ordered_json toJson(const ChoiceReport& report);
// One scene's, or { "scenes": [...], "all": {...} } with the Settings for all as "settings".
nlohmann::ordered_json toJson(const Choices& choices);

}  // namespace diptych::choose
