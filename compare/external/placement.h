// SPDX-License-Identifier: MIT
// Locates the marks of the calibration charts in an image.
#pragma once

#include "shared/image/image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace diptych::external {

// Maps expected to actual positions, pixels from the image's centre, x right, y down: first flips, then
// scales, then shifts.
struct Placement {
    bool upside_down = false, mirrored = false;
    glm::dvec2 scale{1}, shift{0};
    double residual = 0;  // RMS of the marks' position errors, pixels

    glm::dvec2 operator()(const glm::dvec2& expected) const {
        return {(mirrored ? -expected.x : expected.x) * scale.x + shift.x,
                (upside_down ? -expected.y : expected.y) * scale.y + shift.y};
    }
};

// `ids`: expected material_id, with `marks` as emitters of radiance 1 on black. `image`: same size, any
// monotonic tone curve. Uses the centroid of each mark in a window; handles flips and scales from 1/2 to
// 2. Empty if the residual exceeds a pixel.
std::optional<Placement> findPlacement(const Image& ids, const std::vector<int>& marks, const Image& image);

// Per-component median over a material's pixels in the image, away from its edges. Empty if none are
// visible.
std::optional<glm::dvec3> medianColor(const Image& ids, int material, const Image& image,
                                      const Placement& placement);

}  // namespace diptych::external
