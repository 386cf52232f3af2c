// SPDX-License-Identifier: MIT
// Finds the smallest scene that still shows a failure. Delta debugging (Zeller and Hildebrandt 2002,
// "Simplifying and Isolating Failure-Inducing Input") over draws, lights and triangles, then one pixel.
#pragma once

#include "compare/audit/case.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace diptych::audit {

struct FailingPixel {
    bool fails = false;
    int x = -1, y = -1;  // the worst pixel
    double error = 0;
};

struct Reduced {
    Case smallest;
    FailingPixel shown;
};

// `test`: whether a case fails as expected. Tries at most `budget` cases. Empty if the scene without
// textures and animation does not fail.
std::optional<Reduced> reduce(const Case& failing, const std::function<FailingPixel(const Case&)>& test,
                              std::size_t budget);

}  // namespace diptych::audit
