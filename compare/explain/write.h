// SPDX-License-Identifier: MIT
// An explanation as a document, JSON and a folder.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/output/document.h"
#include "shared/image/png.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Names of the explained images: "deferred", and the test's differing Settings, such as "--haze on".
struct ExplainedImages {
    // A shell command, and its purpose: "Explain it again".
    struct Command {
        std::string does, line;
    };

    std::string scene, baseline, test;
    std::vector<Command> commands{};  // the first repeats the explanation
    std::string device{};             // that lights the channels
};

// "lit differs because of albedo 69.1 %, roughness 10.9 %, ...; unexplained 0.0 %".
std::string headlineOf(const Explanation& explanation);
// The headline, the causes, the unexplained part and remarks; without images.
std::vector<output::Block> blocksOf(const Explanation& explanation, const ExplainedImages& of);

nlohmann::ordered_json toJson(const Explanation& explanation, const ExplainedImages& of);

// index.html, without external resources but the images of writeExplanation().
std::string explanationHtml(const Explanation& explanation, const ExplainedImages& of);

inline constexpr const char* explanationManifest = "explain.json";

// Writes index.html, explain.json and the images. Replaces an earlier explanation atomically; replaces
// anything else only with `force`. `lit`: litImage() of both sides. Returns the text of explain.json.
// Throws std::runtime_error naming the folder or file.
std::string writeExplanation(const Explanation& explanation, const ExplainedImages& of,
                             std::array<Image8, 2> lit, const std::filesystem::path& folder, bool force);

}  // namespace diptych
