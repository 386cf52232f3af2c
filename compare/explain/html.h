// SPDX-License-Identifier: MIT
// An explanation as a section of a page, and as a page without external resources.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/explain/words.h"

#include <functional>
#include <string>

namespace diptych {

// The address of an image for a page: a relative path, or a data URI. Empty: the image is not kept.
using PictureSource = std::function<std::string(const std::string& name)>;

// The map of causes with its legend, the table of causes, pairs, and caveats; for a page with the style of
// compare/page.
std::string explanationSection(const Explanation& explanation, const ExplainedPictures& of,
                               const PictureSource& source);

// index.html, to be written beside explanationMaps(), dominantFile and the lit images below.
inline constexpr const char* litFiles[] = {"lit.baseline.png", "lit.test.png"};
std::string explanationHtml(const Explanation& explanation, const ExplainedPictures& of);

}  // namespace diptych
