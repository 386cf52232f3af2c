// SPDX-License-Identifier: MIT
// The part of an explanation that a report shows.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/explain/words.h"
#include "compare/verdict/explained.h"
#include "shared/image/png.h"

#include <string>

namespace diptych {

// `shown`: an image of the scene, of the same size, as background of the map of causes.
Explained explainedOf(const Explanation& explanation, const ExplainedPictures& of, const Image8& shown);

// The reason why there is no explanation, in one line.
Explained notExplained(const std::string& because);

}  // namespace diptych
