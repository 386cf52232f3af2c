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
    ShadowFigure{"error", "error", "sum of |V - R| E over the sum of R E: by what the paths are ranked"},
    ShadowFigure{"false_lit", "false lit",
                 "share of the pixels away from edges that see more of the sun than is right"},
    ShadowFigure{"false_dark", "false dark", "share of the pixels away from edges that see less"},
    ShadowFigure{"leak", "leak",
                 "sum of max(0, V - R) E over the sum of R E: light that should not be, of what should"},
    ShadowFigure{
        "gap", "gap",
        "texels from the traced edge, across the light, within which 99 in 100 of the dark pixels lie that "
        "are shown more than half lit: where a shadow begins at what casts it, the gap between them"},
};
using ShadowErrors = std::array<double, shadowFigures.size()>;

// Nothing where the reference traced no sun that casts, or the Frame is of another size or lacks a channel
// that this needs (shadow_visibility and depth). A Frame without shadow maps shows the sun everywhere; its
// gap is infinite, as are error and leak where nothing should be lit.
std::optional<ShadowErrors> shadowErrorsOf(const Frame& reference, const Frame& frame);

}  // namespace diptych::tradeoff
