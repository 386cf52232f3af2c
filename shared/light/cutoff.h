// SPDX-License-Identifier: MIT
// Gives infinite lights a range, so that not every light list contains them.
#pragma once

#include "shared/light/falloff.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"

#include <span>
#include <vector>

namespace diptych {

// Distance, m, at which a white Lambertian surface facing the light has the luma-weighted radiance `cutoff`,
// W/(sr m^2): sqrt(I / (pi cutoff)). I is the luma of the light's colour times its intensity, W/sr; for area
// lights, of its radiance times its area.
double cutoffRange(const Light& light, double cutoff);

// The lights, with a range for those without one. `cutoff` 0: unchanged.
std::vector<Light> withCutoff(std::vector<Light> lights, double cutoff);

// Fraction, 0 to 1, of the unshadowed flux from infinite lights onto the scene that the cutoff removes, by
// its window and beyond the range. Both sides of a surface receive light. Estimated at 4,096 fixed points
// distributed over the triangles by area; the relative standard error is a few hundredths. 0 if no light
// is infinite.
double energyCut(const Scene& scene, const Pose& pose, std::span<const Light> lights, double cutoff,
                 const LightFalloff& falloff);

}  // namespace diptych
