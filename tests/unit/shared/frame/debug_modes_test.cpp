// SPDX-License-Identifier: MIT
// Names, indices and layers of channels, and the names of error kinds.
#include "shared/frame/debug_modes.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych {
namespace {

TEST(DebugModes, NumbersAscendAndNamesAreUnique) {
    std::set<std::string_view> names;
    int last = -1;
    for (const DebugMode& mode : debugModes()) {
        EXPECT_GT(channelIndex(mode.channel), last) << mode.name;
        last = channelIndex(mode.channel);
        EXPECT_EQ(channelOfIndex(last), mode.channel);
        EXPECT_TRUE(names.insert(mode.name).second) << mode.name;
        EXPECT_FALSE(mode.shows.empty()) << mode.name;
        EXPECT_EQ(findDebugMode(mode.name), &mode);
        EXPECT_EQ(findDebugMode(std::to_string(last)), &mode);
        EXPECT_EQ(&debugMode(mode.channel), &mode);
    }
}

// Files and scripts of other programs rely on these indices: they never change.
TEST(DebugModes, ZeroToNineAreFixed) {
    const char* const names[] = {"lit",      "albedo",    "normals",  "metallic",    "roughness",
                                 "emission", "occlusion", "specular", "material_id", "texcoords"};
    for (int index = 0; index < 10; ++index)
        EXPECT_EQ(debugMode(channelOfIndex(index).value()).name, names[index]);
}

TEST(DebugModes, WhatIsNotThereIsNotFound) {
    for (const char* word : {"", "Lit", "lit ", "-1", "9999", "1x", "+1"})
        EXPECT_EQ(findDebugMode(word), nullptr) << word;
    EXPECT_THROW(debugMode(foreignChannel(0)), std::out_of_range);
    for (const int index : {-1, 9999}) EXPECT_EQ(channelOfIndex(index), std::nullopt);
}

TEST(DebugModes, ExrChannelsAreNamedByKindAndUnique) {
    EXPECT_EQ(exrChannels(debugMode(Channel::lit)), (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(exrChannels(debugMode(Channel::normals)),
              (std::vector<std::string>{"normals.X", "normals.Y", "normals.Z"}));
    EXPECT_EQ(exrChannels(debugMode(Channel::roughness)), (std::vector<std::string>{"roughness.Y"}));
    EXPECT_EQ(exrChannels(debugMode(Channel::material_id)), (std::vector<std::string>{"material_id.Y"}));
    EXPECT_EQ(exrChannels(debugMode(Channel::texcoords)),
              (std::vector<std::string>{"texcoords.X", "texcoords.Y"}));
    EXPECT_EQ(exrChannels(*findDebugMode("depth")), (std::vector<std::string>{"Z"}));
    std::set<std::string> all;
    for (const DebugMode& mode : debugModes()) {
        const std::vector<std::string> channels = exrChannels(mode);
        EXPECT_EQ(channels.size(), static_cast<std::size_t>(mode.width)) << mode.name;
        for (const std::string& channel : channels) EXPECT_TRUE(all.insert(channel).second) << channel;
    }
}

TEST(DebugModes, MetricsHaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (const ErrorKind errorKind :
         {ErrorKind::relative, ErrorKind::absolute, ErrorKind::angular, ErrorKind::axial, ErrorKind::exact})
        names.insert(nameOf(errorKind));
    EXPECT_EQ(names.size(), 5u);
    EXPECT_FALSE(names.contains("?"));
    EXPECT_EQ(nameOf(ErrorKind::axial), "axial");
}

// Angles need three components, and a range of unit vectors.
TEST(DebugModes, AnglesAreBetweenUnitVectors) {
    for (const DebugMode& mode : debugModes()) {
        EXPECT_EQ(isAngle(mode.error_kind),
                  mode.domain == Domain::unit || mode.domain == Domain::unit_or_zero)
            << mode.name;
        EXPECT_TRUE(!isAngle(mode.error_kind) || mode.width == 3) << mode.name;
    }
    EXPECT_EQ(debugMode(Channel::anisotropy_direction).error_kind, ErrorKind::axial) << "it has no sign";
}

// A pixel's surface is found before the light that reaches it, and that before the light it sends.
TEST(DebugModes, StepsFollowTheComputation) {
    std::set<int> steps;
    for (const DebugMode& mode : debugModes()) {
        EXPECT_TRUE(steps.insert(mode.step).second) << mode.name << " has the step of another channel";
        const ChannelStage stage = sourceOf(mode.channel).stage;
        const int hundreds = stage < ChannelStage::list ? 100 : stage < ChannelStage::light ? 400 : 500;
        EXPECT_GE(mode.step, hundreds) << mode.name;
        EXPECT_LT(mode.step, hundreds == 100 ? 400 : hundreds == 400 ? 500 : 700) << mode.name;
    }
    EXPECT_EQ(*steps.rbegin(), debugMode(Channel::lit).step) << "what all else makes";
}

TEST(DebugModes, CodesHaveBits) {
    for (const DebugMode& mode : debugModes()) {
        const ChannelCode& of = mode.stored;
        EXPECT_EQ(of.code == FieldCode::exact, of.standard == 0) << mode.name;
        EXPECT_LE(of.compact, of.standard) << mode.name;
        EXPECT_EQ(of.compact == 0, of.standard == 0) << mode.name;
        const bool turned = of.code == FieldCode::octahedral || of.code == FieldCode::line;
        EXPECT_TRUE(!turned || isAngle(mode.error_kind)) << mode.name;
    }
    EXPECT_EQ(debugMode(Channel::normals).stored.compact, 12u);
    EXPECT_EQ(debugMode(Channel::normals).stored.standard, 16u);
}

TEST(DebugModes, PlacesAmongRelatedChannelsAreUnique) {
    std::set<int> places;
    for (const DebugMode& mode : debugModes())
        if (mode.related != 0) {
            EXPECT_TRUE(places.insert(mode.related).second) << mode.name;
        }
    EXPECT_EQ(*places.begin(), debugMode(Channel::lit).related);
    EXPECT_EQ(*places.rbegin(), static_cast<int>(places.size()));
}

// Only channels of a surface come from texels, in the unit that their use has.
TEST(DebugModes, TexelsMakeSurfaces) {
    for (const DebugMode& mode : debugModes()) {
        if (mode.texels == TexelUse::none) continue;
        EXPECT_EQ(sourceOf(mode.channel).stage, ChannelStage::surface) << mode.name;
        const bool color = mode.texels == TexelUse::color || mode.texels == TexelUse::scaled_color;
        EXPECT_EQ(color, mode.kind == ChannelKind::color) << mode.name;
        EXPECT_EQ(mode.texels == TexelUse::line, mode.error_kind == ErrorKind::axial) << mode.name;
    }
}

TEST(DebugModes, LayersHaveTheirChannels) {
    for (const DebugMode& mode : debugModes()) {
        const std::string name(mode.name);
        const auto names = [&](const char* word) { return name.find(word) != std::string::npos; };
        const gpu::uint layer =
            names("clearcoat")              ? gpu::LAYER_CLEARCOAT
            : names("anisotropy")           ? gpu::LAYER_ANISOTROPY
            : names("sheen")                ? gpu::LAYER_SHEEN
            : names("iridescence")          ? gpu::LAYER_IRIDESCENCE
            : names("diffuse_transmission") ? gpu::LAYER_DIFFUSE_TRANSMISSION
            : name == "lit_transmission"    ? gpu::LAYER_TRANSMISSION | gpu::LAYER_DIFFUSE_TRANSMISSION
            : names("transmission") || names("attenuation") || names("dispersion") ? gpu::LAYER_TRANSMISSION
                                                                                   : 0u;
        EXPECT_EQ(layerOf(mode.channel), layer) << name;
    }
}

// A channel of several layers is shown if a scene has any of them.
TEST(DebugModes, ScenesShowTheChannelsOfTheirLayers) {
    for (const DebugMode& mode : debugModes()) {
        const gpu::uint layers = layerOf(mode.channel);
        EXPECT_EQ(mayShow(mode.channel, 0), layers == 0) << mode.name;
        for (gpu::uint layer = 1; layer <= gpu::LAYER_TRANSMISSION; layer *= 2) {
            EXPECT_EQ(mayShow(mode.channel, layer), layers == 0 || (layers & layer) != 0) << mode.name;
        }
    }
}

}  // namespace
}  // namespace diptych
