// SPDX-License-Identifier: MIT
// What a report shows of an explanation.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/explain/words.h"
#include "compare/verdict/explained.h"
#include "shared/image/png.h"

#include <string>

namespace diptych {

// `shown`: a picture of the scene, of the same size, behind the map of causes.
Explained explainedOf(const Explanation& explanation, const ExplainedPictures& of, const Image8& shown);

// Of what cannot be explained: why, in one line.
Explained notExplained(const std::string& because);

}  // namespace diptych
