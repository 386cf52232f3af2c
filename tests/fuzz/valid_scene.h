// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

namespace diptych::fuzz {

// Everything that scene.h and motion.h promise of a loaded scene, so that nobody behind the loader checks it
// again: indices lead somewhere, arrays are as long as each other, numbers are finite, nodes are trees.
// Aborts with the promise that is broken.
void requireSound(const Scene& scene);

}  // namespace diptych::fuzz
