// SPDX-License-Identifier: MIT
// An explanation as a folder.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/explain/words.h"
#include "compare/picture/picture.h"

#include <array>
#include <filesystem>
#include <string>

namespace diptych {

inline constexpr const char* explanationManifest = "explain.json";

// Both sides' lit as an image, with one exposure: channelPicture().
Image8 litPicture(const Frame& frame, const Frame& baseline, const PictureChoice& choice);

// Writes index.html, explain.json and the images. Replaces an earlier explanation atomically; replaces
// anything else only with `force`. `lit`: litPicture() of both sides. Returns the text of explain.json.
// Throws std::runtime_error naming the folder or file.
std::string writeExplanation(const Explanation& explanation, const ExplainedPictures& of,
                             std::array<Image8, 2> lit, const std::filesystem::path& folder, bool force);

}  // namespace diptych
