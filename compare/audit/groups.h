// SPDX-License-Identifier: MIT
// The quantities by what they push; quantities() has them all.
#pragma once

#include "compare/audit/quantity.h"

#include <vector>

namespace diptych::audit {

std::vector<Quantity> placeQuantities();     // where the scene is, and how large
std::vector<Quantity> cameraQuantities();    // how it is seen
std::vector<Quantity> lightQuantities();     // by what it is lit
std::vector<Quantity> materialQuantities();  // of what it is made
std::vector<Quantity> shadowQuantities();    // shadow maps and haze
std::vector<Quantity> amountQuantities();    // how much there is of it: lights, triangles, pixels, seconds

// What several lack.
std::string lacksNothing(const Subject& subject);
std::string lacksSurface(const Subject& subject);  // no surface is seen, or the camera is orthographic
std::string lacksLocalLight(const Subject& subject);
std::string lacksSun(const Subject& subject);
std::string lacksEnvironment(const Subject& subject);

double originalOne(const Subject& subject);

// first, first * step, ... up to last, all rounded to three digits.
std::vector<double> ladder(double first, double last, double step = 10);

}  // namespace diptych::audit
