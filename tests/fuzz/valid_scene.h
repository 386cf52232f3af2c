// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

namespace diptych::fuzz {

// All postconditions of scene.h and motion.h for a loaded scene, so that later code need not check them:
// indices are valid, array lengths match, numbers are finite, nodes are trees. Aborts with the violated
// one.
void requireSound(const Scene& scene);

}  // namespace diptych::fuzz
