// SPDX-License-Identifier: MIT
// Measures that need a capture: of the sun's shadow, and of the samples that deferred lighting shades.
#pragma once

#include "compare/experiment/measures.h"
#include "shared/frame/frame.h"

#include <optional>

namespace diptych::tradeoff {

using experiment::SampleFractions;
using experiment::ShadowErrors;

// Compared with traced rays of the reference. Empty if the reference traced no shadow-casting sun, or if the
// Frame has another size or lacks shadow_visibility or depth. A Frame without shadow maps sees the sun
// everywhere, so its gap is infinite. Error and leak are infinite if nothing should be lit.
std::optional<ShadowErrors> shadowErrorsOf(const Frame& reference, const Frame& frame);

// The Settings to compare samples with: --msaa-edges exact shades all that differ. Empty if samples are not
// chosen.
std::optional<Settings> exactEdges(const Settings& settings);

// Empty if a Frame lacks shaded_samples or lit.
std::optional<SampleFractions> sampleFractionsOf(const Frame& exact, const Frame& frame);

}  // namespace diptych::tradeoff
