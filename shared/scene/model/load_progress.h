// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace diptych {

// Called from any thread while a scene is loaded, with what is done of the step that it names, from 0 to 1.
using LoadProgress = std::function<void(double fraction, const char* step)>;

}  // namespace diptych
