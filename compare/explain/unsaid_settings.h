// SPDX-License-Identifier: MIT
// Settings that the test has without saying so: an environment that is turned, other ambient light, other
// haze; and of another program's picture, other conventions. Each is tried in our lighting of its channels.
#pragma once

#include "compare/explain/channel_lighting.h"
#include "compare/explain/explained_sides.h"
#include "shared/frame/settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// A Setting that the test may have without saying so.
struct UnsaidSetting {
    std::string_view option;
    Settings settings;  // the test's with this one, and with those that are believed before it
    std::string shows;
    bool guessed = false;  // a multiple that no term says
};

// Those that are believed, in the order in which they are found; none where it is known what makes the rest.
std::vector<UnsaidSetting> unsaidSettings(const ExplainedSides& sides, ChannelLighting& lighting);

}  // namespace diptych
