// SPDX-License-Identifier: MIT
#include "shared/frame/settings.h"
#include "compare/explain/channel_lighting.h"
#include "compare/explain/explain.h"
#include "compare/frames/frame_properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace diptych::tests {
namespace {

// With a misspelled name, a Setting would become a cause without effect.
TEST(ExplainSettings, ThoseInChannelsAreThere) {
    for (const std::string_view option : settingsInChannels())
        EXPECT_TRUE(std::ranges::any_of(settingFields(), [&](const Field& field) {
            return field.option == option;
        })) << option;
}

// The surface, the result, whose material each pixel is, and whether a lightmap lights it.
TEST(ExplainSettings, ChannelsAreTheSurfacesAndWhatTheyMake) {
    std::set<Channel> expected(surfaceChannels().begin(), surfaceChannels().end());
    for (const Channel channel : {Channel::lit, Channel::material_id, Channel::lightmapped})
        EXPECT_TRUE(expected.insert(channel).second);
    const std::vector<Channel> channels = explainedChannels();
    EXPECT_EQ(channels, std::vector<Channel>(expected.begin(), expected.end()));
}

}  // namespace
}  // namespace diptych::tests
