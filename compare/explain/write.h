// SPDX-License-Identifier: MIT
// An explanation as text, JSON, a section of a page, a page, and a folder.
#pragma once

#include "compare/explain/explanation.h"
#include "shared/image/png.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
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

// "78 % on material 12, Lantern glass; 9 % on background": the first parts, at most `most`, each with at
// least `least` of the cause's share. `before`: "on ".
std::string partsOf(const Cause& cause, const std::vector<CausePart>& parts, std::string_view before,
                    std::string_view noun, std::size_t most, double least);
// One line each: interacting pairs, differences without effect, what relighting misses, lights left out.
std::vector<std::string> remarksOn(const Explanation& explanation, const ExplainedPictures& of);

std::string inWords(const Explanation& explanation, const ExplainedPictures& of);
nlohmann::ordered_json toJson(const Explanation& explanation, const ExplainedPictures& of);

// The address of an image for a page: a relative path, or a data URI. Empty: the image is not kept.
using PictureSource = std::function<std::string(const std::string& name)>;

// The map of causes with its legend, the table of causes, pairs, and caveats; for a page with the style of
// compare/page.
std::string explanationSection(const Explanation& explanation, const ExplainedPictures& of,
                               const PictureSource& source);

// index.html, without external resources but the images of writeExplanation().
std::string explanationHtml(const Explanation& explanation, const ExplainedPictures& of);

inline constexpr const char* explanationManifest = "explain.json";

// Writes index.html, explain.json and the images. Replaces an earlier explanation atomically; replaces
// anything else only with `force`. `lit`: litPicture() of both sides. Returns the text of explain.json.
// Throws std::runtime_error naming the folder or file.
std::string writeExplanation(const Explanation& explanation, const ExplainedPictures& of,
                             std::array<Image8, 2> lit, const std::filesystem::path& folder, bool force);

}  // namespace diptych
