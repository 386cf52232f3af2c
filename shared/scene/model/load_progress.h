// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace diptych {

// Called from any thread while a scene is loaded: the fraction of the step `step` that is done, 0 to 1.
using LoadProgress = std::function<void(double fraction, const char* step)>;

}  // namespace diptych
