// SPDX-License-Identifier: MIT
// What kind of channel a layer of another program is: by its name, its components and its values.
#include "compare/files/layer_kinds.h"

#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace diptych {
namespace {

TEST(LayerKinds, AComponentIsTheLastWordAndColoursHaveALetter) {
    for (const auto& [channel, component] : {std::pair{"R", "R"},
                                             {"beauty.red", "R"},
                                             {"a.GREEN", "G"},
                                             {"x.y.Blue", "B"},
                                             {"alpha", "A"},
                                             {"N.X", "X"},
                                             {"AZaz@[`{", "AZaz@[`{"},
                                             {"Grey", "Grey"},
                                             {"a.", ""},
                                             {"", ""}})
        EXPECT_EQ(componentOf(channel), component) << channel;
}

TEST(LayerKinds, NamesOfThreeComponentsTell) {
    const std::vector<std::string> rgb{"R", "G", "B"};
    using enum ChannelKind;
    for (const auto& [name, kind] : {std::pair{"worldNormal", vector},
                                     {"normal_ws", vector},
                                     {"Denoising Normal", vector},
                                     {"N", vector},
                                     {"view.Ng", vector},
                                     {"P", vector},
                                     {"UVs", vector},
                                     {"uv1", vector},
                                     {"z depth", vector},
                                     {"mv2to3", vector},
                                     {"normal.light", color},
                                     {"abnormal", color},
                                     {"N dot L", color},
                                     {"NdotL", color},
                                     {"beauty", color},
                                     {"material", id},
                                     {"Object", id},
                                     {"material color", color},
                                     {"color of an object", color},
                                     {"materialID", id},
                                     {"Material ID", id},
                                     {"index 2", id},
                                     {"CryptoObject00", id},
                                     {"CryptoMaterial.layer", id},
                                     {"uncrypto", color},
                                     {"", color}})
        EXPECT_EQ(diptych::kindOf(name, rgb, "half"), kind) << name;
    EXPECT_EQ(diptych::kindOf("beauty", {"a.X", "a.Y", "a.Z"}, "half"), vector);
    EXPECT_EQ(diptych::kindOf("beauty", {"a.Y", "a.X", "a.Z"}, "half"), color) << "X first";
    EXPECT_EQ(diptych::kindOf("normal", rgb, "uint"), id);
    for (const std::size_t width : {1, 2, 4})
        EXPECT_EQ(diptych::kindOf("worldNormal", std::vector<std::string>(width, "R"), "half"), scalar)
            << width;
}

// Our own layers, by their name and width, have the kind and error of their debug mode; an error that
// depends on the scene's light is none of a file's.
TEST(LayerKinds, OursAreThoseOfTheirDebugMode) {
    for (const DebugMode& mode : debugModes()) {
        const std::string name(mode.name);
        const auto width = static_cast<std::size_t>(mode.width);
        EXPECT_EQ(diptych::kindOf(name, std::vector<std::string>(width, "R"), "float"), mode.kind) << name;
        EXPECT_TRUE(isDebugMode(name, width)) << name;
        EXPECT_FALSE(isDebugMode(name, width + 1)) << name;
        const bool own = isAngle(mode.error_kind) || mode.error_kind == ErrorKind::exact;
        EXPECT_EQ(errorKindOf(name, width, mode.kind), own ? mode.error_kind : ErrorKind::absolute) << name;
        EXPECT_EQ(errorKindOf(name, width + 1, ChannelKind::color), ErrorKind::absolute) << name;
    }
    EXPECT_EQ(errorKindOf("foreign", 1, ChannelKind::id), ErrorKind::exact);
    EXPECT_EQ(errorKindOf("foreign", 3, ChannelKind::vector), ErrorKind::absolute);
}

// A tenth of the pixels that show anything.
TEST(LayerKinds, AnImageIsNegativeFromATenthOn) {
    Image image(30, 1, 3);
    EXPECT_FALSE(isNegative(image)) << "nothing is shown";
    for (int x = 0; x < 20; ++x) image.at(x, 0, 1) = 1;
    image.at(4, 0, 2) = -0.5f;
    EXPECT_FALSE(isNegative(image));
    image.at(7, 0, 0) = -0.5f;
    EXPECT_TRUE(isNegative(image));
    image.at(25, 0, 2) = 1;
    EXPECT_FALSE(isNegative(image)) << "two of 21";
}

TEST(LayerKinds, WholeNumbersBeyondATenBitCodeAreIds) {
    Image image(3, 1, 1, 2.0f);
    image.data = {0, -3, 1024};
    EXPECT_FALSE(isWhole(image));
    image.data[1] = 1025;
    EXPECT_TRUE(isWhole(image));
    image.data[0] = 0.5f;
    EXPECT_FALSE(isWhole(image));
    image.data[0] = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(isWhole(image));
}

}  // namespace
}  // namespace diptych
