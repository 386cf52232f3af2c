// SPDX-License-Identifier: MIT
// The type of a layer in another renderer's file follows from its channels' suffixes.
#include "compare/files/layers.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace diptych {
namespace {

ChannelKind kindOfForeign(const std::vector<std::string>& channels, const std::string& sample = "float") {
    ImageLayer layer{"foreign", channels, sample, Image(2, 1, static_cast<int>(channels.size()))};
    const std::vector<ImageChannel> found = channelsOf({2, 1, "OpenEXR", false, {std::move(layer)}}, {});
    EXPECT_EQ(found.size(), 1u);
    return found.at(0).kind;
}

TEST(ForeignLayers, ThreeComponentsAreAVectorOrAColour) {
    EXPECT_EQ(kindOfForeign({"foreign.X", "foreign.Y", "foreign.Z"}), ChannelKind::vector);
    EXPECT_EQ(kindOfForeign({"foreign.R", "foreign.G", "foreign.B"}), ChannelKind::color);
}

TEST(ForeignLayers, OneComponentIsAnIndexOrAScalar) {
    EXPECT_EQ(kindOfForeign({"foreign.id"}, "uint"), ChannelKind::id);
    EXPECT_EQ(kindOfForeign({"foreign.id"}), ChannelKind::scalar);
}

}  // namespace
}  // namespace diptych
