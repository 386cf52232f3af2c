// SPDX-License-Identifier: MIT
// Settings that a scene cannot feel: whatever their value, it draws the same picture.
#pragma once

#include "compare/tradeoff/sweep.h"
#include "shared/scene/model/scene.h"

#include <span>

namespace diptych::tradeoff {

// The sweep without rows that differ from an earlier one only in Settings that mean nothing to a scene with
// these lights (the scene's own and those that were added). Their values become skips, which say why.
// `scene`: whose materials, environment and meshes they are; nullptr: any.
SweepRows rowsThatAreFelt(const SweepRows& sweep, std::span<const Light> lights,
                          const Scene* scene = nullptr);

}  // namespace diptych::tradeoff
