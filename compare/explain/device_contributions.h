// SPDX-License-Identifier: MIT
// Attributes the difference between two devices to edges, textures, vertices, shadow maps, light lists and
// rounding.
#pragma once

#include "compare/explain/explanation.h"
#include "compare/verdict/across_devices.h"
#include "shared/frame/frame.h"

#include <vector>

namespace diptych {

// The channels needed beside explainedChannels().
std::vector<Channel> deviceContributionChannels();

// Sums the maps of an explanation's causes; the results sum to its distance. Descending. `baseline`,
// `test`: the explained Frames.
std::vector<DeviceContribution> deviceContributions(const Explanation& explanation, const Frame& baseline,
                                                    const Frame& test, const AcrossDevices& across);

}  // namespace diptych
