// SPDX-License-Identifier: MIT
// An explanation as a part of a page, and as a page of its own without external resources.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/explain/words.h"

#include <functional>
#include <string>

namespace diptych {

// Where a page finds the picture of this name: its address beside the page, or the picture itself as a data
// URI. Empty: it is not kept.
using PictureSource = std::function<std::string(const std::string& name)>;

// The map of causes with its legend, the table of causes, pairs, and what else must be known; for a page that
// has the style of compare/page.
std::string explanationSection(const Explanation& explanation, const ExplainedPictures& of,
                               const PictureSource& source);

// index.html, beside the pictures of explanationMaps(), dominantFile, and both sides' lit as below.
inline constexpr const char* litFiles[] = {"lit.baseline.png", "lit.test.png"};
std::string explanationHtml(const Explanation& explanation, const ExplainedPictures& of,
                            const std::string& device);

}  // namespace diptych
