// SPDX-License-Identifier: MIT
// Maps a renderer's pixel values to radiance: curve and primaries, measured from emitters of known
// radiance.
#pragma once

#include "compare/external/renderer_file.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <vector>

namespace diptych::external {

struct RampStep {
    double expected = 0, actual = 0;  // radiance, W/(sr m^2), and pixel value
};

enum class CurveKind { linear, srgb, tone };

// Converts pixel values to radiance.
class Response {
public:
    // `ramp`: ascending, with at least two distinct values. A curve counts as linear or sRGB, with any
    // factor, if each unclipped step is within 6 %. Otherwise it interpolates the ramp.
    explicit Response(std::vector<RampStep> ramp);

    CurveKind kind() const { return kind_; }
    double exposure() const { return exposure_; }                // on all radiance; 1 for a tone curve
    std::optional<double> cutOffAt() const { return cut_off_; }  // greater radiance is clipped

    // `columns[c]`: pixel value of an emitter with radiance `expected` in component c only.
    void measurePrimaries(const std::array<glm::dvec3, 3>& columns, double expected);
    // Empty if the primaries are unknown.
    std::optional<Primaries> primaries() const { return primaries_; }

    glm::dvec3 radiance(const glm::dvec3& actual) const;

private:
    double straight(double actual) const;  // without primaries

    std::vector<RampStep> ramp_;  // both ascending; without clipped steps
    CurveKind kind_ = CurveKind::tone;
    double exposure_ = 1;
    std::optional<double> cut_off_;
    std::optional<Primaries> primaries_ = Primaries::rec709;
    glm::dmat3 expected_from_actual_{1.0};
};

}  // namespace diptych::external
