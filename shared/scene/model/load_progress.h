// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace diptych {

// Progress of loading, called from any thread: `fraction` of `step` is done, 0 to 1.
using LoadProgress = std::function<void(double fraction, const char* step)>;

}  // namespace diptych
