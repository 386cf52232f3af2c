// SPDX-License-Identifier: MIT
#include "shared/frame/settings.h"
#include "compare/explain/channel_lighting.h"
#include "compare/explain/explain.h"
#include "compare/explain/explanations.h"
#include "compare/frames/frame_properties.h"
#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
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

// The path is the baseline's; without it, deferred's.
TEST(ExplainArguments, NameTheSceneItsSettingsAndTheTest) {
    Settings settings;
    settings.haze = true;
    using Words = std::vector<std::string>;
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        settings.path = path;
        EXPECT_EQ(explainArguments("a.glb", settings, Path::deferred, {}),
                  (Words{"explain", "--haze", "on", "a.glb"}));
        EXPECT_EQ(explainArguments("a.glb", settings, Path::forward_plus, {{"msaa", "4"}, {"seed", "2"}}),
                  (Words{"explain", "--test", "seed=2", "--test", "msaa=4", "--baseline", "forward_plus",
                         "--haze", "on", "a.glb"}));
    }
}

// Light that fails, or everything.
TEST(Explained, IsWhatFailsInLit) {
    Report report;
    EXPECT_FALSE(isExplained(true, report));
    report.comparisons.resize(2);
    EXPECT_TRUE(isExplained(true, report));
    EXPECT_FALSE(isExplained(false, report));
    for (const auto& [channel, verdict, is] : {std::tuple{Channel::albedo, Verdict::fail, false},
                                               {Channel::lit, Verdict::pass, false},
                                               {Channel::lit, Verdict::informative, false},
                                               {Channel::lit, Verdict::fail, true}}) {
        ChannelDiff& diff = report.comparisons[1].channels.emplace_back();
        diff.mode = &debugMode(channel);
        diff.verdict = verdict;
        EXPECT_EQ(isExplained(false, report), is) << debugMode(channel).name;
    }
}

}  // namespace
}  // namespace diptych::tests
