// SPDX-License-Identifier: MIT
// Errors of a path's sun shadow, compared with traced rays of the reference.
#pragma once

#include "compare/experiment/errors.h"
#include "shared/frame/frame.h"

#include <array>
#include <optional>

namespace diptych::tradeoff {

// Fractions are of pixels with a surface in the reference. Pixels within the filter radius plus one texel
// of a traced shadow boundary do not count as false: any value is valid there. V: sun visibility in the
// path; R: in the reference, 0 or 1; E: irradiance of the unshadowed sun.
inline constexpr std::array shadowFigures{
    experiment::NamedMetric{"error", "error", "sum of |V - R| E divided by the sum of R E; ranks the paths"},
    experiment::NamedMetric{"false_lit", "false lit",
                            "fraction of pixels away from edges that see too much of the sun"},
    experiment::NamedMetric{"false_dark", "false dark",
                            "fraction of pixels away from edges that see too little of the sun"},
    experiment::NamedMetric{
        "leak", "leak",
        "sum of max(0, V - R) E divided by the sum of R E: false light relative to correct light"},
    experiment::NamedMetric{
        "gap", "gap",
        "99th percentile of the distance from the traced edge, across the light, of dark pixels "
        "shown more than half lit, in texels: the peter-panning gap between caster and shadow"},
};
using ShadowErrors = std::array<double, shadowFigures.size()>;

// Empty if the reference traced no shadow-casting sun, or if the Frame has another size or lacks
// shadow_visibility or depth. A Frame without shadow maps sees the sun everywhere, so its gap is infinite.
// Error and leak are infinite if nothing should be lit.
std::optional<ShadowErrors> shadowErrorsOf(const Frame& reference, const Frame& frame);

}  // namespace diptych::tradeoff
