// SPDX-License-Identifier: MIT
#pragma once

#include "compare/experiment/sweep.h"

#include <string>
#include <vector>

namespace diptych::experiment {

// Reads --grid, a file or JSON text that begins with { or [. A grid is the product of its values:
//   { "settings": { "gbuffer": ["compact", "full"], "size": ["1/2", "320x180"] } }
// A list holds several grids. A single value needs no brackets. Throws std::runtime_error, one line naming
// the file and the problem.
std::vector<Grid> readGrids(const std::string& fileOrText, const Settings& requested);

}  // namespace diptych::experiment
