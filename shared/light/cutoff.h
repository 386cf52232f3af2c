// SPDX-License-Identifier: MIT
// Gives lights without a range one, so that not every light list must hold them.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"

#include <span>
#include <vector>

namespace diptych {

// The distance, m, at which a light of luminous `intensity` (the luminance of its colour times its intensity,
// W/sr; of an area light its radiance times its area) makes a white Lambertian surface that faces it as dim
// as `cutoff`, W/(sr m^2): sqrt(intensity / (pi cutoff)).
double cutoffRange(const Light& light, double cutoff);

// The lights with ranges where they had none. `cutoff` 0: as they were.
std::vector<Light> withCutoff(std::vector<Light> lights, double cutoff);

// Of the flux that lights without a range send onto the scene's surfaces, unshadowed, onto the side that
// faces the light: the share, 0 to 1, that the cutoff takes away, by its window and beyond it. Estimated at
// 4,096 points spread over the triangles by area, the same ones every time; a standard error of a few
// hundredths of itself. 0 where no light is without a range.
double energyCut(const Scene& scene, const Pose& pose, std::span<const Light> lights, double cutoff);

}  // namespace diptych
