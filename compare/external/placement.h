// SPDX-License-Identifier: MIT
// Where a picture shows the marks of the calibration charts, beside where it should.
#pragma once

#include "shared/image/image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace diptych::external {

// From a place that was told to where it is shown, in pixels from the picture's middle, x to the right and y
// down: first the picture is turned round, then made larger, then moved.
struct Placement {
    bool upside_down = false, mirrored = false;
    glm::dvec2 scale{1}, shift{0};
    double residual = 0;  // root mean square of what it leaves of the marks' places, pixels

    glm::dvec2 operator()(const glm::dvec2& told) const {
        return {(mirrored ? -told.x : told.x) * scale.x + shift.x,
                (upside_down ? -told.y : told.y) * scale.y + shift.y};
    }
};

// `ids`: material_id as it should be, of which `marks` are emitters of 1 before nothing; `picture`: of the
// same size, whatever curve it has. Each mark's centroid is measured within a window, for pictures that are
// turned round in any way and of half to twice the scale. Empty where the marks are not found, to a pixel.
std::optional<Placement> findPlacement(const Image& ids, const std::vector<int>& marks, const Image& picture);

// The median of a material's pixels, away from its edges, where the picture shows them; by component. Empty
// where it does not.
std::optional<glm::dvec3> shownBy(const Image& ids, int material, const Image& picture,
                                  const Placement& placement);

}  // namespace diptych::external
