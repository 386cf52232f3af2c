// SPDX-License-Identifier: MIT
#pragma once

#include "compare/verdict/picture_diff.h"

#include <string>

namespace diptych {

// For a terminal: a line per channel, failures first, then one line of verdict. Ends in a newline.
std::string pictureDiffTable(const PictureDiff& diff);

// Every figure of every channel; those of the deciding channel stand at the top. Ends in a newline.
std::string pictureDiffJson(const PictureDiff& diff);

}  // namespace diptych
