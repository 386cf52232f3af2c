// SPDX-License-Identifier: MIT
#include "shared/frame/settings.h"
#include "compare/explain/channel_lighting.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace diptych::tests {
namespace {

// With a misspelled name, a Setting would become a cause without effect.
TEST(ExplainSettings, ThoseInChannelsAreThere) {
    for (const std::string_view option : settingsInChannels())
        EXPECT_TRUE(std::ranges::any_of(settingFields(), [&](const Field& field) {
            return field.option == option;
        })) << option;
}

}  // namespace
}  // namespace diptych::tests
