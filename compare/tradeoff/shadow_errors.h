// SPDX-License-Identifier: MIT
// How wrong a path's shadow of the sun is, held against the rays of the reference.
#pragma once

#include "shared/frame/frame.h"

#include <array>
#include <optional>
#include <string_view>

namespace diptych::tradeoff {

struct ShadowFigure {
    std::string_view name, title, means;
};
// Shares are of the pixels that show a surface in the reference and are farther from the traced edge of a
// shadow than the path's filter reaches and one texel: nearer, anything between light and shadow is right.
// V: how much of the sun a pixel sees in the path; R: in the reference, 0 or 1; E: the irradiance that the
// sun would give unshadowed.
inline constexpr std::array shadowFigures{
    ShadowFigure{"error", "error", "sum of |V - R| E divided by the sum of R E; ranks the paths"},
    ShadowFigure{"false_lit", "false lit", "fraction of pixels away from edges that see too much of the sun"},
    ShadowFigure{"false_dark", "false dark",
                 "fraction of pixels away from edges that see too little of the sun"},
    ShadowFigure{"leak", "leak",
                 "sum of max(0, V - R) E divided by the sum of R E: false light relative to correct light"},
    ShadowFigure{"gap", "gap",
                 "99th percentile of the distance from the traced edge, across the light, of dark pixels "
                 "shown more than half lit, in texels: the peter-panning gap between caster and shadow"},
};
using ShadowErrors = std::array<double, shadowFigures.size()>;

// Nothing where the reference traced no sun that casts, or the Frame is of another size or lacks a channel
// that this needs (shadow_visibility and depth). A Frame without shadow maps shows the sun everywhere; its
// gap is infinite, as are error and leak where nothing should be lit.
std::optional<ShadowErrors> shadowErrorsOf(const Frame& reference, const Frame& frame);

}  // namespace diptych::tradeoff
