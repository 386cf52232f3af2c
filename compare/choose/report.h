// SPDX-License-Identifier: MIT
// A choice as text, JSON and page. Its JSON has schema 2.
#pragma once

#include "compare/choose/joint.h"
#include "compare/choose/search.h"
#include "compare/choose/sensitivity.h"
#include "compare/output/document.h"
#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
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
struct SensitivityReport : Sensitivities {
    std::string chosen, other;            // descriptions of both paths' Settings
    std::string chosen_path, other_path;  // names
    bool other_fits = true;               // whether the other path is within the budget
};

// Texts of a choice for one scene or of a joint choice.
struct AnyReport {
    Settings requested;
    Budget budget;
    // By candidate: description of its Settings, and the command that renders it.
    std::vector<std::string> words, commands;
    double seconds = 0;
};

struct ChoiceReport : AnyReport {
    std::string scene;
    std::vector<std::string> cameras;  // titles
    ReportDevice device;
    SettingsChoice choice;
    std::vector<HeldOutCamera> held_out;  // other cameras of the scene
    std::vector<std::string> notes{};
    std::optional<SensitivityReport> sensitivities{};
};

// The joint choice for several scenes. Commands use SCENE as the scene's name.
struct JointReport : AnyReport {
    std::vector<std::string> scenes;
    JointChoice choice;
};

struct Choices {
    std::vector<ChoiceReport> scenes;  // at least one
    std::optional<JointReport> all;    // with several scenes
};

// Empty if nothing fits. `Choices`: of the only scene, or the joint one.
template <class AnyChoice>
std::optional<Settings> chosenSettings(const AnyChoice& choice) {
    return choice.chosen ? std::optional(choice.candidates[*choice.chosen].settings) : std::nullopt;
}
inline std::optional<Settings> chosenSettings(const Choices& choices) {
    return choices.all ? chosenSettings(choices.all->choice) : chosenSettings(choices.scenes.front().choice);
}

// Blocks for a terminal and the page.
std::vector<output::Block> blocksOf(const ChoiceReport& report);
std::vector<output::Block> blocksOf(const JointReport& report);
// Compares the chosen Settings with the other path's best fitting ones, pass by pass.
std::string whyText(const ChoiceReport& report);

// The report of one scene, or { "scenes": [...], "all": {...} } with the joint choice as "settings".
nlohmann::ordered_json toJson(const Choices& choices);

inline constexpr const char* choiceManifest = "choice.json";

// Writes the folder: page, choice.json, plots, and settings.json if something fits. With several scenes,
// each scene gets its plot and Settings. Throws std::runtime_error naming -o if the folder has other
// contents.
void writeChoice(const Choices& choices, const std::filesystem::path& folder, bool force);

}  // namespace diptych::choose
