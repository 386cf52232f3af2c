// SPDX-License-Identifier: MIT
// Channels that a path supports, and the messages for others.
#include "shared/frame/supported_channels.h"
#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace diptych {
namespace {

TEST(SupportedChannels, WhoMakesOneIsNamedWhereAnotherIsAsked) {
    const auto why = [](Path path, Channel channel, int samples = 1) {
        Settings settings;
        settings.path = path;
        settings.msaa = samples;
        return std::string(unsupportedReason(settings, debugMode(channel)));
    };
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference})
        EXPECT_EQ(why(path, Channel::albedo), "");
    EXPECT_NE(why(Path::deferred, Channel::texcoords).find("--path forward_plus"), std::string::npos);
    EXPECT_EQ(why(Path::reference, Channel::texcoords), "");
    EXPECT_NE(why(Path::reference, Channel::light_count).find("--path forward_plus"), std::string::npos);
    EXPECT_NE(why(Path::forward_plus, Channel::shaded_samples, 4).find("--path deferred"), std::string::npos);
    EXPECT_NE(why(Path::reference, Channel::shaded_samples).find("--path deferred"), std::string::npos);
    EXPECT_NE(why(Path::deferred, Channel::shaded_samples).find("--msaa 4"), std::string::npos);
    EXPECT_EQ(why(Path::deferred, Channel::shaded_samples, 4), "");
}

TEST(SupportedChannels, TheReferenceMakesWhatIsAboutTheScene) {
    for (const auto& [channel, made] :
         {std::pair{Channel::lit, true}, std::pair{Channel::tangent, true},
          std::pair{Channel::shaded_samples, false}, std::pair{Channel::cascade, false}})
        EXPECT_EQ(isSupportedByReference(debugMode(channel)), made) << debugMode(channel).name;
}

}  // namespace
}  // namespace diptych
