// SPDX-License-Identifier: MIT
// Channels that a path supports, and the messages for others.
#include "shared/frame/made_channels.h"
#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace diptych {
namespace {

TEST(MadeChannels, WhoMakesOneIsNamedWhereAnotherIsAsked) {
    const auto why = [](Path path, gpu::uint mode, int samples = 1) {
        Settings settings;
        settings.path = path;
        settings.msaa = samples;
        return std::string(notMadeBecause(settings, debugMode(static_cast<int>(mode))));
    };
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference})
        EXPECT_EQ(why(path, gpu::DEBUG_albedo), "");
    EXPECT_NE(why(Path::deferred, gpu::DEBUG_texcoords).find("--path forward_plus"), std::string::npos);
    EXPECT_EQ(why(Path::reference, gpu::DEBUG_texcoords), "");
    EXPECT_NE(why(Path::reference, gpu::DEBUG_light_count).find("--path forward_plus"), std::string::npos);
    EXPECT_NE(why(Path::forward_plus, gpu::DEBUG_shaded_samples, 4).find("--path deferred"),
              std::string::npos);
    EXPECT_NE(why(Path::reference, gpu::DEBUG_shaded_samples).find("--path deferred"), std::string::npos);
    EXPECT_NE(why(Path::deferred, gpu::DEBUG_shaded_samples).find("--msaa 4"), std::string::npos);
    EXPECT_EQ(why(Path::deferred, gpu::DEBUG_shaded_samples, 4), "");
}

TEST(MadeChannels, TheReferenceMakesWhatIsAboutTheScene) {
    for (const auto& [mode, made] :
         {std::pair{gpu::DEBUG_lit, true}, std::pair{gpu::DEBUG_tangent, true},
          std::pair{gpu::DEBUG_shaded_samples, false}, std::pair{gpu::DEBUG_cascade, false}})
        EXPECT_EQ(isMadeByReference(debugMode(static_cast<int>(mode))), made) << mode;
}

}  // namespace
}  // namespace diptych
