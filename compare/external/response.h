// SPDX-License-Identifier: MIT
// What a renderer writes of radiance: a curve, and primaries. Measured of emitters whose radiance is known.
#pragma once

#include "compare/external/renderer_file.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <vector>

namespace diptych::external {

struct RampStep {
    double told = 0, shown = 0;  // radiance, W/(sr m^2), and what was written
};

enum class CurveKind { linear, srgb, tone };

// From what is written back to radiance.
class Response {
public:
    // Of a ramp in ascending order, at least two of which differ. A curve is linear or sRGB's, by any factor,
    // where that leaves at most 6 % of each step that is not cut off; else it is told by the ramp alone.
    explicit Response(std::vector<RampStep> ramp);

    CurveKind kind() const { return kind_; }
    double exposure() const { return exposure_; }  // a factor on all radiance; 1 of a tone curve
    std::optional<double> cutOffAt() const { return cut_off_; }  // radiance beyond which all is written alike

    // `columns[c]`: what is written of an emitter of the radiance `told` in component c alone.
    void measurePrimaries(const std::array<glm::dvec3, 3>& columns, double told);
    // Nothing where it is none of the known ones, although other than Rec.709.
    std::optional<Primaries> primaries() const { return primaries_; }

    glm::dvec3 radiance(const glm::dvec3& shown) const;

private:
    double straight(double shown) const;  // without primaries

    std::vector<RampStep> ramp_;  // ascending in both, what is cut off left out
    CurveKind kind_ = CurveKind::tone;
    double exposure_ = 1;
    std::optional<double> cut_off_;
    std::optional<Primaries> primaries_ = Primaries::rec709;
    glm::dmat3 told_from_shown_{1.0};
};

}  // namespace diptych::external
