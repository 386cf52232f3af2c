// SPDX-License-Identifier: MIT
// Quantities by subject; quantities() returns all.
#pragma once

#include "compare/audit/quantity.h"

#include <vector>

namespace diptych::audit {

std::vector<Quantity> placeQuantities();     // position and size of the scene
std::vector<Quantity> cameraQuantities();    // camera
std::vector<Quantity> lightQuantities();     // lights
std::vector<Quantity> materialQuantities();  // materials
std::vector<Quantity> shadowQuantities();    // shadow maps and haze
std::vector<Quantity> amountQuantities();    // amounts: lights, triangles, pixels, seconds

// Shared reasons why a quantity or relation does not apply; empty if it does.
std::string lacksNothing(const Subject& subject);
std::string lacksSurface(const Subject& subject);  // no surface is visible, or the camera is orthographic
std::string lacksLocalLight(const Subject& subject);
std::string lacksSun(const Subject& subject);
std::string lacksEnvironment(const Subject& subject);

double originalOne(const Subject& subject);

// first, first * step, ... up to last, all rounded to three digits.
std::vector<double> ladder(double first, double last, double step = 10);

}  // namespace diptych::audit
