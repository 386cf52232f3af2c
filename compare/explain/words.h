// SPDX-License-Identifier: MIT
// An explanation as text and JSON.
#pragma once

#include "compare/explain/explanation.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace diptych {

// Names of the explained images: "deferred", and the test's differing Settings, such as "--haze on".
struct ExplainedPictures {
    // A shell command, and its purpose: "Explain it again".
    struct Command {
        std::string does, line;
    };

    std::string scene, baseline, test;
    std::vector<Command> commands{};  // the first repeats the explanation
    std::string device{};             // that lights the channels
};

// Above this fraction of the distance the text calls the unexplained part significant.
inline constexpr double worthUnexplained = 0.05;

std::string materialName(const MaterialShare& material);
// "light 3, Lamp".
std::string lightName(const LightShare& light);
// The number of lights rendered alone, if some were omitted; else empty.
std::string lightsLine(const Explanation& explanation);
std::string pairLine(const Explanation& explanation, const CausePair& pair);
// The relative residual of relighting each side's channels; empty if there is none.
std::string reproductionLine(const Explanation& explanation, const ExplainedPictures& of);
// The fraction, 0 to 1, of the pixels with any cause where this one is the largest.
double dominatedShare(const Explanation& explanation, std::size_t cause);

// "lit differs because of albedo 69.1 %, roughness 10.9 %, ...; unexplained 0.0 %".
std::string inShort(const Explanation& explanation);
std::string inWords(const Explanation& explanation, const ExplainedPictures& of);
nlohmann::ordered_json toJson(const Explanation& explanation, const ExplainedPictures& of);

}  // namespace diptych
