// SPDX-License-Identifier: MIT
// An explanation in words and as JSON.
#pragma once

#include "compare/explain/explanation.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace diptych {

// Whose pictures an explanation is of: "deferred", and in which Settings the test differs, as "--haze on".
struct ExplainedPictures {
    // A line for a shell, and what it does: "Explain it again".
    struct Command {
        std::string does, line;
    };

    std::string scene, baseline, test;
    std::vector<Command> commands{};  // the first explains them again
};

// Over this share of the distance the words say that what is left unexplained is more than a trifle.
inline constexpr double worthUnexplained = 0.05;

std::string materialName(const MaterialShare& material);
// "light 3, Lamp".
std::string lightName(const LightShare& light);
// How many lights were drawn alone, where some were left out; else empty.
std::string lightsLine(const Explanation& explanation);
std::string pairLine(const Explanation& explanation, const CausePair& pair);
// How far the lighting of each side's own channels is off its lit; empty where it is not.
std::string reproductionLine(const Explanation& explanation, const ExplainedPictures& of);
// Of the pixels where some cause counts, the share where this one counts most, 0 to 1.
double dominatedShare(const Explanation& explanation, std::size_t cause);

// "lit differs because of albedo 69.1 %, roughness 10.9 %, ...; unexplained 0.0 %".
std::string inShort(const Explanation& explanation);
std::string inWords(const Explanation& explanation, const ExplainedPictures& of);
nlohmann::ordered_json toJson(const Explanation& explanation, const ExplainedPictures& of);

}  // namespace diptych
