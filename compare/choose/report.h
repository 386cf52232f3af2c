// SPDX-License-Identifier: MIT
// A choice as text, JSON and page. Its JSON has schema 2.
#pragma once

#include "compare/choose/common.h"
#include "compare/choose/search.h"
#include "compare/choose/sensitivity.h"
#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace diptych::choose {

// Check of the chosen Settings from a held-out camera.
struct HeldOutCamera {
    std::string camera;
    double error = 0;
    bool holds = true;  // within the error budget; without one, at most 1.5 times the chosen error
};

// --explain-choice: scene properties that decide between the paths.
struct SensitivityReport {
    std::string chosen, other;            // descriptions of both paths' Settings
    std::string chosen_path, other_path;  // names
    bool other_fits = true;               // whether the other path is within the budget
    Sensitivities sensitivities;
};

struct ChoiceReport {
    std::string scene;
    std::vector<std::string> cameras;  // titles
    Settings given;
    Budget budget;
    ReportDevice device;
    Choice choice;
    // By candidate: description of its Settings, and the command that renders it.
    std::vector<std::string> words, commands;
    std::vector<HeldOutCamera> held_out;  // other cameras of the scene
    std::vector<std::string> notes{};
    std::optional<SensitivityReport> sensitivities{};
    double seconds = 0;

    std::string figure() const { return std::string(named(budget.figure).title); }  // "FLIP"
};

// The joint choice for several scenes.
struct CommonReport {
    std::vector<std::string> scenes;
    CommonChoice choice;
    // By candidate. Commands use SCENE as the scene's name.
    std::vector<std::string> words, commands;
    double seconds = 0;
};

struct Choices {
    std::vector<ChoiceReport> scenes;  // at least one
    std::optional<CommonReport> all;   // with several scenes
};

// Every candidate of every scene, then those of the joint choice.
std::vector<const experiment::Row*> allRows(const Choices& choices);

// The only scene's choice, or the joint one. Empty if nothing fits.
std::optional<Settings> chosenSettings(const Choices& choices);

// "the fastest with FLIP at most 0.01"
std::string goalInWords(const ChoiceReport& report);
// Terminal text, ends with a newline.
std::string inWords(const ChoiceReport& report);
// `first`: report of any scene, for the budget.
std::string inWords(const CommonReport& report, const ChoiceReport& first);
// "takes 3.1 % longer (-0.5 % to +6.8 %)", "takes 0.5 % less time (-1.2 % to +0.3 %)".
std::string longerInWords(const TimeRatio& of);
nlohmann::ordered_json jsonOf(const TimeRatio& of);
// Time, error and memory of one candidate.
std::string figuresInWords(const ChoiceReport& report, std::size_t candidate);
const char* nameOf(CandidateStatus status);  // "too slow"
const char* statusInWords(CandidateStatus status);
// Reasons, alternatives and significance, or how far the budget is missed. One line each, not indented.
std::vector<std::string> reasonsInWords(const ChoiceReport& report);
std::vector<std::string> reasonsInWords(const CommonReport& report, const ChoiceReport& first);
// A line on both Settings, then the three most relevant properties, indented by two spaces.
std::vector<std::string> inWords(const SensitivityReport& report);
nlohmann::ordered_json toJson(const SensitivityReport& report);
nlohmann::ordered_json toJson(const ChoiceReport& report);
// The report of one scene, or { "scenes": [...], "all": {...} } with the joint choice as "settings".
nlohmann::ordered_json toJson(const Choices& choices);

}  // namespace diptych::choose
