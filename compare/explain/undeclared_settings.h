// SPDX-License-Identifier: MIT
// Finds undeclared Settings of the test: a rotated environment, other ambient light or haze; for another
// renderer's image, other conventions. Each is tried by relighting the test's channels.
#pragma once

#include "compare/explain/channel_lighting.h"
#include "compare/explain/explained_sides.h"
#include "shared/frame/settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// A Setting that the test may use without declaring it.
struct UndeclaredSetting {
    std::string_view option;
    Settings settings;  // the test's with this one and all accepted before it
    std::string description;
    bool guessed = false;  // an estimated multiple that no term confirms
};

// The accepted Settings, in the order in which they are found; empty if the residual's source is known.
std::vector<UndeclaredSetting> undeclaredSettings(const ExplainedSides& sides, ChannelLighting& lighting);

}  // namespace diptych
