// SPDX-License-Identifier: MIT
// An explanation in words and as JSON.
#pragma once

#include "compare/explain/explain.h"

#include <nlohmann/json.hpp>

#include <string>

namespace diptych {

// Whose pictures an explanation is of: "deferred", and in which Settings the test differs, as "--haze on".
struct ExplainedPictures {
    std::string scene, baseline, test;
};

// Over this share of the distance the words say that what is left unexplained is more than a trifle.
inline constexpr double worthUnexplained = 0.05;

std::string inWords(const Explanation& explanation, const ExplainedPictures& of);
nlohmann::ordered_json toJson(const Explanation& explanation, const ExplainedPictures& of);

}  // namespace diptych
