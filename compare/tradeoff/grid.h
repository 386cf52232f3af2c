// SPDX-License-Identifier: MIT
#pragma once

#include "compare/tradeoff/sweep.h"

#include <string>
#include <vector>

namespace diptych::tradeoff {

// Reads --grid, a file or the JSON itself (it begins with { or [): { "settings": { "gbuffer": ["compact",
// "full"], "size": ["1/2", "320x180"] } } is every combination of these values; a list holds several such
// grids. A single value needs no brackets. Throws std::runtime_error, one line that names the file and what
// in it is wrong.
std::vector<Grid> readGrids(const std::string& fileOrText, const Settings& given);

}  // namespace diptych::tradeoff
