// SPDX-License-Identifier: MIT
// Settings to which a scene is not sensitive: their values do not change the image.
#pragma once

#include "compare/experiment/sweep.h"
#include "shared/scene/model/scene.h"

#include <span>

namespace diptych::experiment {

// Removes rows that differ from an earlier row only in Settings to which the scene is not sensitive. Their
// values become skips with reasons. `lights`: the scene's own and added ones. `scene`: source of
// materials, environment and meshes; nullptr: assume any.
SweepRows sensitiveRows(const SweepRows& sweep, std::span<const Light> lights, const Scene* scene = nullptr);

}  // namespace diptych::experiment
