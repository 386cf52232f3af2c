// SPDX-License-Identifier: MIT
// Errors of a path's sun shadow, compared with traced rays of the reference.
#pragma once

#include "compare/experiment/measures.h"
#include "shared/frame/frame.h"

#include <optional>

namespace diptych::tradeoff {

using experiment::ShadowErrors;

// Empty if the reference traced no shadow-casting sun, or if the Frame has another size or lacks
// shadow_visibility or depth. A Frame without shadow maps sees the sun everywhere, so its gap is infinite.
// Error and leak are infinite if nothing should be lit.
std::optional<ShadowErrors> shadowErrorsOf(const Frame& reference, const Frame& frame);

}  // namespace diptych::tradeoff
