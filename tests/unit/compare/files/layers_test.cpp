// SPDX-License-Identifier: MIT
// Matching of two image files: names, types, widths; pixel selection; prefilters.
#include "compare/files/layers.h"
#include "compare/metrics/prefilter.h"
#include "compare/verdict/selection.h"
#include "shared/image/png.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace diptych {

using namespace metrics;

namespace {

// A layer of a 2 x 1 image; component c of pixel i is 10 c + i.
ImageLayer layer(const std::string& name, const std::vector<std::string>& channels,
                 const std::string& sample = "float") {
    ImageLayer l{name, channels, sample, Image(2, 1, static_cast<int>(channels.size()))};
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t c = 0; c < channels.size(); ++c)
            l.image.pixel(i)[c] = static_cast<float>(10 * c + i);
    return l;
}

ImageFile file(std::vector<ImageLayer> layers) {
    return {2, 1, "OpenEXR", false, std::move(layers)};
}

std::vector<std::string> namesOf(const std::vector<ImageChannel>& channels) {
    std::vector<std::string> names;
    for (const ImageChannel& c : channels) names.push_back(c.name);
    return names;
}

TEST(Layers, ChannelsWithoutALayerHaveOurNames) {
    const auto channels = channelsOf(
        file({layer("", {"R", "G", "B", "A", "Z"}), layer("normals", {"normals.X", "normals.Y", "normals.Z"}),
              layer("roughness", {"roughness.Y"}), layer("id", {"id.id"}, "uint")}),
        {});
    EXPECT_EQ(namesOf(channels),
              (std::vector<std::string>{"lit", "A", "depth", "normals", "roughness", "id"}));
    EXPECT_EQ(channels[0].kind, ChannelKind::color);
    EXPECT_EQ(channels[0].image.pixel(1)[2], 21);
    EXPECT_EQ(channels[2].image.pixel(1)[0], 41);
    EXPECT_EQ(channels[3].kind, ChannelKind::vector);
    EXPECT_EQ(channels[5].kind, ChannelKind::id);
}

// Integers are ids: by their type, also without a layer's name, or by values that light does not have.
TEST(Layers, IntegersAreNoLight) {
    const auto kindsOf = [](ImageLayer&& one) {
        return matchChannels(channelsOf(file({one}), {}), channelsOf(file({one}), {}), {}).channels[0].kind;
    };
    EXPECT_EQ(kindsOf(layer("", {"R", "G", "B"}, "uint")), ChannelKind::id);
    EXPECT_EQ(kindsOf(layer("", {"Y"}, "uint")), ChannelKind::id);
    ImageLayer ids = layer("", {"R", "G", "B"});
    EXPECT_EQ(kindsOf(ImageLayer(ids)), ChannelKind::color) << "small integers may be light";
    ids.image.data[0] = 100001;
    EXPECT_EQ(kindsOf(ImageLayer(ids)), ChannelKind::id);
    ids.image.data[1] = 0.5f;
    EXPECT_EQ(kindsOf(ImageLayer(ids)), ChannelKind::color);
}

// On either side, and also in named layers and 8-bit files.
TEST(Layers, AColourWithoutAlphaIsOpaque) {
    const auto with = [] {
        return channelsOf(file({layer("", {"R", "G", "B", "A"}), layer("b", {"b.R", "b.G", "b.B", "b.A"}),
                                layer("c", {"c.A"})}),
                          {});
    };
    const auto without = [] {
        return channelsOf(file({layer("", {"R", "G", "B"}), layer("b", {"b.R", "b.G", "b.B"})}), {});
    };
    for (const bool lacking : {false, true}) {
        const MatchedChannels matched =
            lacking ? matchChannels(with(), without(), {}) : matchChannels(without(), with(), {});
        ASSERT_EQ(matched.channels.size(), 4u);
        for (const MatchedChannel& channel : matched.channels) {
            if (channel.name != "A" && channel.name != "b.A") continue;
            EXPECT_EQ((lacking ? channel.test : channel.reference).image.data, (PixelData{1, 1}));
            EXPECT_EQ((lacking ? channel.reference : channel.test).image.data, (PixelData{30, 31}));
        }
        EXPECT_EQ(matched.notes.at(0), fmt::format("A: {} has none, so it counts as opaque: 1 everywhere",
                                                   lacking ? "the test" : "the reference"));
        ASSERT_EQ(matched.one_sided.size(), 1u) << "an alpha of nothing";
    }
    const auto eight = [](const std::vector<std::string>& channels) {
        ImageLayer l{"", channels, "8 bit", {}};
        l.coded = {2, 1, static_cast<int>(channels.size()),
                   std::vector<std::uint8_t>(2 * channels.size(), 7)};
        return channelsOf(file({std::move(l)}), {});
    };
    const MatchedChannels coded = matchChannels(eight({"R", "G", "B", "A"}), eight({"R", "G", "B"}), {});
    ASSERT_EQ(coded.channels.size(), 2u);
    EXPECT_EQ(coded.channels[1].test.coded.data, (std::vector<std::uint8_t>{255, 255}));
}

TEST(Layers, ColoursHaveNamesOfTheirOwn) {
    const auto channels = channelsOf(
        file({layer("", {"r", "g", "b", "a"}), layer("beauty", {"beauty.red", "beauty.Green", "beauty.BLUE"}),
              layer("c", {"c.X", "c.Y", "c.Z", "c.alpha"})}),
        {});
    EXPECT_EQ(namesOf(channels), (std::vector<std::string>{"lit", "A", "beauty", "c", "c.A"}));
    EXPECT_EQ(channels[2].kind, ChannelKind::color);
}

// Each image's only colour layer, with its alpha; not if both names have a meaning of their own.
TEST(Layers, OnlyColoursAreAPair) {
    const auto named = [](const std::string& name) {
        return channelsOf(file({layer(name, {name + ".R", name + ".G", name + ".B", name + ".A"})}), {});
    };
    const auto plain = [] { return channelsOf(file({layer("", {"R", "G", "B", "A"})}), {}); };
    const MatchedChannels matched = matchChannels(plain(), named("ViewLayer.Combined"), {});
    ASSERT_EQ(matched.channels.size(), 2u);
    EXPECT_EQ(matched.channels[0].name, "lit");
    EXPECT_EQ(matched.channels[1].name, "A");
    EXPECT_EQ(matched.notes,
              std::vector<std::string>{"lit of the reference is compared with ViewLayer.Combined of the "
                                       "test: each is the only colour of its image"});
    EXPECT_EQ(matchChannels(named("a"), named("b"), {}).channels.at(0).name, "a");
    const std::string shown(60, 'n');
    EXPECT_NE(matchChannels(plain(), named(shown), {}).notes.at(0).find("with " + shown + " of"),
              std::string::npos);
    EXPECT_EQ(matchChannels(plain(), named(shown + "n"), {}).notes.at(0).find(shown + "n"), std::string::npos)
        << "a longer name is cut";
    EXPECT_NE(faultOf([&] {
                  matchChannels(plain(), named("albedo"), {});
              }).find("--map 'lit=albedo.R,albedo.G,albedo.B' compares these two"),
              std::string::npos);
    const auto two = [&] {
        return channelsOf(file({layer("a", {"a.R", "a.G", "a.B"}), layer("b", {"b.R", "b.G", "b.B"})}), {});
    };
    EXPECT_EQ(faultOf([&] { matchChannels(plain(), two(), {}); }).substr(0, 26),
              "the images share no layer:");
}

TEST(Layers, ALayerIsGivenAName) {
    const auto channels = channelsOf(
        file({layer("v.Combined", {"v.Combined.R", "v.Combined.G", "v.Combined.B", "v.Combined.A"})}),
        {"lit=v.Combined"});
    EXPECT_EQ(namesOf(channels), (std::vector<std::string>{"lit", "A"}));
}

TEST(Layers, NamesOfOthersAreGivenOurs) {
    const auto channels =
        channelsOf(file({layer("diffuse", {"diffuse.R", "diffuse.G", "diffuse.B"}), layer("", {"ao"})}),
                   {"albedo=diffuse.B,diffuse.G,diffuse.R", "occlusion=ao", "normals=N.x,N.y,N.z"});
    EXPECT_EQ(namesOf(channels), (std::vector<std::string>{"albedo", "occlusion"}));
    EXPECT_EQ(channels[0].image.pixel(0)[0], 20) << "in the order that was asked for";
    for (const char* sentence : {"albedo", "=a", "albedo=", "albedo=a,,b"})
        EXPECT_EQ(faultOf([&] {
                      channelsOf(file({layer("", {"R"})}), {sentence});
                  }).find(std::string("--map ") + sentence + ": give NAME=CHANNEL,"),
                  0u);
}

// The reference's uncertainty layer is not an image channel. In another program's file a layer with that
// name is an ordinary layer.
TEST(Layers, OurUncertaintyIsNoChannel) {
    ImageFile ours = file({layer("", {"R", "G", "B"}), layer("uncertainty", {"uncertainty.Y"})});
    EXPECT_EQ(namesOf(channelsOf(ours, {})), (std::vector<std::string>{"lit", "uncertainty"}));
    ours.attributes["software"] = "diptych";
    EXPECT_EQ(namesOf(channelsOf(ours, {})), std::vector<std::string>{"lit"});
    EXPECT_EQ(namesOf(channelsOf(ours, {"known=uncertainty.Y"})), (std::vector<std::string>{"known", "lit"}));
    const auto matched =
        matchChannels(channelsOf(ours, {}), channelsOf(file({layer("", {"R", "G", "B"})}), {}), {});
    EXPECT_TRUE(matched.notes.empty() && matched.one_sided.empty()) << "nor is it said to be missing";

    ImageFile taken = ours;
    EXPECT_EQ(takeUncertainty(taken).data, (PixelData{0, 1}));
    EXPECT_TRUE(takeUncertainty(taken).empty());
    EXPECT_EQ(taken.layers.size(), 1u);
}

TEST(Layers, WhatOnlyOneHasIsSaid) {
    const auto matched =
        matchChannels(channelsOf(file({layer("a", {"a.Y"}), layer("b", {"b.Y"})}), {}),
                      channelsOf(file({layer("b", {"b.Y"}, "half"), layer("c", {"c.Y"})}), {}), {});
    ASSERT_EQ(matched.channels.size(), 1u);
    EXPECT_EQ(matched.channels[0].name, "b");
    ASSERT_EQ(matched.one_sided.size(), 2u);
    EXPECT_EQ(matched.one_sided[0].name + " of " + matched.one_sided[0].owner, "a of the reference");
    EXPECT_EQ(matched.one_sided[1].name + " of " + matched.one_sided[1].owner, "c of the test");
    EXPECT_EQ(matched.notes, std::vector<std::string>{"b: float in the reference, half in the test"});
}

TEST(Layers, ThoseThatAreWantedAreMatchedAlone) {
    const auto reference = [] {
        return channelsOf(file({layer("a", {"a.Y"}), layer("b", {"b.Y"}), layer("b2", {"b2.Y"})}), {});
    };
    const auto test = [] {
        return channelsOf(file({layer("b", {"b.Y"}), layer("b2", {"b2.Y"}), layer("c", {"c.Y"})}), {});
    };
    const auto namesOfMatched = [](const MatchedChannels& matched) {
        std::vector<std::string> names;
        for (const auto& channel : matched.channels) names.push_back(channel.name);
        return names;
    };
    const MatchedChannels one = matchChannels(reference(), test(), {"b"});
    EXPECT_EQ(namesOfMatched(one), std::vector<std::string>{"b"});
    EXPECT_TRUE(one.one_sided.empty()) << "nobody asked for a and c";
    EXPECT_EQ(namesOfMatched(matchChannels(reference(), test(), {"b*"})),
              (std::vector<std::string>{"b", "b2"}));
    EXPECT_EQ(matchChannels(reference(), test(), {"*"}).one_sided.size(), 2u);
}

// Grey, with or without alpha, counts as light and can be compared with colour.
TEST(Layers, GreyIsAColour) {
    const auto grey = channelsOf(file({layer("", {"Y", "A"})}), {});
    EXPECT_EQ(namesOf(grey), (std::vector<std::string>{"lit", "A"}));
    EXPECT_EQ(grey[0].kind, ChannelKind::color);
    ASSERT_EQ(grey[0].image.components, 3);
    for (const int c : {0, 1, 2}) EXPECT_EQ(grey[0].image.at(1, 0, c), 1);
    EXPECT_EQ(matchChannels(grey, channelsOf(file({layer("", {"R", "G", "B"})}), {}), {}).channels.size(),
              2u);
}

TEST(Layers, NamesThatNeitherFileHasAreAnError) {
    ImageFile a = file({layer("", {"R", "G", "B"})}), b = file({layer("d", {"d.Y"})});
    EXPECT_EQ(faultOf([&] { checkNames(a, b, {"albedo=R,G,B", "ao=d.Y"}); }), "");
    EXPECT_EQ(
        faultOf([&] { checkNames(a, b, {"albedo=R,G,X"}); }),
        "--map albedo=R,G,X: neither file has these channels; the reference has R, G, B, the test has d.Y");
}

TEST(Layers, WhatIsNotInBothIsAnError) {
    const auto a = [] { return channelsOf(file({layer("", {"R", "G", "B"})}), {}); };
    const auto b = [] { return channelsOf(file({layer("lit", {"lit.Y"})}), {}); };
    const auto c = [] { return channelsOf(file({layer("ao", {"ao.Y"})}), {}); };
    EXPECT_EQ(faultOf([&] { matchChannels(a(), b(), {}); }),
              "lit: R,G,B in the reference and lit.Y in the test; match them with --map");
    EXPECT_EQ(faultOf([&] { matchChannels(a(), c(), {}); }),
              "the images share no layer: the reference has lit, the test has ao; --map can match them");
    EXPECT_EQ(faultOf([&] { matchChannels(a(), a(), {"normals"}); }),
              "--channels normals: not in both images; both have lit");
    EXPECT_EQ(faultOf([&] { matchChannels(a(), a(), {"lti"}); }),
              "--channels lti: not in both images; did you mean lit?");
}

TEST(Layers, WholeNumbersBeyondFloat32AreToldApart) {
    const auto ids = [](std::uint32_t value) {
        ImageLayer l = layer("id", {"id.Y"}, "uint");
        for (const std::size_t i : {0u, 1u}) l.image.pixel(i)[0] = 16777216.0f;
        l.exact = {{16777216u, value}};
        return channelsOf(file({std::move(l)}), {});
    };
    auto matched = matchChannels(ids(16777217u), ids(16777216u), {});
    EXPECT_EQ(matched.channels[0].reference.image.data[0], matched.channels[0].test.image.data[0]);
    EXPECT_NE(matched.channels[0].reference.image.data[1], matched.channels[0].test.image.data[1]);
    matched = matchChannels(ids(16777217u), ids(16777217u), {});
    EXPECT_EQ(matched.channels[0].reference.image.data[1], matched.channels[0].test.image.data[1]);
}

// ---- which pixels count ----

std::string picked(const Coverage& coverage) {
    std::string text;
    for (const std::uint8_t c : coverage.covered) text += c ? 'x' : '.';
    return text;
}

TEST(Selection, EdgesOfObjectsAreLeftOut) {
    Image ids(6, 2, 1, 4.0f);
    ids.at(5, 0) = ids.at(5, 1) = 7.0f;
    std::vector<std::string> notes;
    const auto without = [&](int edge) {
        Coverage all = everyPixel(12);
        SelectionOptions options;
        options.ignore_edges = edge;
        applySelection(all, 6, 2, options, {{&ids, &ids}, {}}, notes);
        return picked(all);
    };
    EXPECT_EQ(without(1), "xxxx..xxxx..") << "both sides of the edge";
    EXPECT_EQ(without(2), "xxx...xxx...");
    EXPECT_EQ(notes.back(), "6 of 12 pixels are compared; options exclude the others");
    EXPECT_EQ(faultOf([&] { without(9); }),
              "--mask, --ids, --crop and --ignore-edges leave no pixel to compare");
    Coverage all = everyPixel(12);
    SelectionOptions options;
    options.ignore_edges = 1;
    EXPECT_EQ(faultOf([&] { applySelection(all, 6, 2, options, {}, notes); }),
              "--ignore-edges: needs material_id or Z to find edges, and neither image has one");
    Image depth(6, 2, 1, 10.0f);  // 5 % further away is another object
    depth.at(0, 0) = 10.6f;
    depth.at(5, 1) = 10.4f;
    applySelection(all, 6, 2, options, {{}, {&depth, &depth}}, notes);
    EXPECT_EQ(picked(all), "..xxxx.xxxxx");
}

// Another renderer's file may have neither ids nor depth. Then the other image's are used.
TEST(Selection, EdgesAreThoseOfTheOneImageThatTellsThem) {
    Image ids(6, 1, 1, 4.0f), depth(6, 1, 1, 10.0f);
    ids.at(5, 0) = 7.0f;
    depth.at(0, 0) = 20.0f;
    std::vector<std::string> notes;
    const auto by = [&](const ObjectPlanes& objects) {
        Coverage all = everyPixel(6);
        SelectionOptions options;
        options.ignore_edges = 1;
        applySelection(all, 6, 1, options, objects, notes);
        return picked(all) + " " + notes[notes.size() - 2];
    };
    EXPECT_EQ(by({{&ids, nullptr}, {}}), "xxxx.. edges are where material_id changes in the reference");
    EXPECT_EQ(by({{nullptr, &ids}, {}}), "xxxx.. edges are where material_id changes in the test");
    EXPECT_EQ(by({{}, {nullptr, &depth}}),
              "..xxxx edges are where depth changes by over 5 % between neighbours in the test");
    // A plane that both images have comes first: an object may be elsewhere in each.
    EXPECT_EQ(by({{&ids, nullptr}, {&depth, &depth}}),
              "..xxxx edges are where depth changes by over 5 % between neighbours");
}

TEST(Layers, OneComponentAgainstColoursIsSaid) {
    const auto grey = [] { return channelsOf(file({layer("", {"Y"})}), {}); };
    const auto colours = [] { return channelsOf(file({layer("", {"R", "G", "B"})}), {}); };
    EXPECT_EQ(matchChannels(grey(), colours(), {}).notes,
              (std::vector<std::string>{
                  "lit: the single component of the reference is compared with all three of the test"}));
    EXPECT_EQ(matchChannels(colours(), grey(), {}).notes,
              (std::vector<std::string>{
                  "lit: the single component of the test is compared with all three of the reference"}));
    EXPECT_TRUE(matchChannels(grey(), grey(), {}).notes.empty());
}

TEST(Selection, MaskIdsAndCrop) {
    const std::filesystem::path files = folder();
    Image8 mask{3, 2, 4, std::vector<std::uint8_t>(24, 0)};
    for (std::size_t i = 0; i < 6; ++i) mask.data[4 * i + 3] = 255;  // alpha is no brightness
    for (const std::size_t i : {0u, 4u}) mask.data[4 * i + 2] = 200;
    mask.data[4 * 5] = 120;  // below one half
    writePng(files / "mask.png", mask);
    Image ids(3, 2, 1);
    for (int i = 0; i < 6; ++i) ids.data[static_cast<std::size_t>(i)] = static_cast<float>(i);
    std::vector<std::string> notes;
    const auto by = [&](const SelectionOptions& options) {
        Coverage all = everyPixel(6);
        applySelection(all, 3, 2, options, {{&ids, &ids}, {}}, notes);
        EXPECT_EQ(all.count, static_cast<std::size_t>(std::ranges::count(all.covered, 1)));
        return picked(all);
    };
    SelectionOptions options;
    options.mask = (files / "mask.png").string();
    EXPECT_EQ(by(options), "x...x.");
    options = {};
    options.ids = {1, 5, 9};
    EXPECT_EQ(by(options), ".x...x");
    options = {};
    options.crop = cropOf("1,0,2x2");
    EXPECT_EQ(by(options), ".xx.xx");
    options.crop = cropOf("2,0,2x2");
    EXPECT_EQ(faultOf([&] { by(options); }), "--crop 2,0,2x2: is not inside the image of 3x2");
    Coverage four = everyPixel(4);
    options = {};
    options.mask = (files / "mask.png").string();
    EXPECT_EQ(faultOf([&] { applySelection(four, 2, 2, options, {}, notes); }),
              "--mask " + options.mask + ": is 3x2, but the images are 2x2");
}

// ---- prefilters ----

TEST(Prefilter, BlurKeepsTheSumAndLeavesNanAlone) {
    Image point(33, 33, 1);
    point.at(16, 16) = 1;
    const Image soft = blurred(point, 2);
    double sum = 0;
    for (const float v : soft.data) sum += double{v};
    EXPECT_NEAR(sum, 1, 1e-5) << "the Gaussian's weights add up to 1; float32";
    EXPECT_NEAR(soft.at(18, 16) / soft.at(16, 16), std::exp(-0.5), 1e-5) << "one deviation away";
    EXPECT_EQ(blurred(point, 0).data, point.data);
    Image holed(5, 1, 1, 3.0f);
    holed.at(2, 0) = std::nanf("");
    const Image filled = blurred(holed, 1);
    EXPECT_TRUE(std::isnan(filled.at(2, 0)));
    EXPECT_NEAR(filled.at(1, 0), 3, 1e-5) << "the weights of the others make up for it";
}

TEST(Prefilter, ShiftForgivesOnlyWhatMoved) {
    Image reference(5, 5, 1), test(5, 5, 1);
    reference.at(2, 2) = 1;
    test.at(3, 2) = 1;
    const Image moved = shifted(reference, test, 1);
    EXPECT_EQ(moved.at(2, 2), 1) << "the feature is found next to its place";
    EXPECT_EQ(moved.at(3, 2), 0) << "and is not missed where it stands";
    test.at(3, 2) = 0;
    EXPECT_EQ(shifted(reference, test, 1).at(2, 2), 0) << "what is nowhere stays missing";
    test.at(4, 2) = 1;
    EXPECT_EQ(shifted(reference, test, 1).at(2, 2), 0) << "two pixels are too far";
    EXPECT_EQ(shifted(reference, test, 2).at(2, 2), 1);
}

}  // namespace
}  // namespace diptych
