// SPDX-License-Identifier: MIT
#include "shared/scene/image/environment.h"

#include "shared/image/exr.h"
#include "shared/image/png.h"
#include "shared/image/radiance.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace diptych;

namespace {

// 4 x 2 pixels; all components are different numbers that RGBE represents exactly.
Image numbered() {
    Image image(4, 2, 3);
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = 1 + static_cast<float>(i) / 32;
    return image;
}

std::string environmentFault(const std::filesystem::path& file) {
    std::vector<std::string> notes;
    return faultOf([&] { readEnvironment(file, notes); });
}

}  // namespace

TEST(Environment, ExrAndRadianceHoldTheSamePixels) {
    const std::filesystem::path in = folder();
    const Image image = numbered();
    writeExr(in / "sky.exr", {{{"R", "G", "B"}, &image}});
    writeHdr(in / "sky.hdr", image);
    for (const char* name : {"sky.exr", "sky.hdr"}) {
        std::vector<std::string> notes;
        const Environment environment = readEnvironment(in / name, notes);
        EXPECT_EQ(environment.name, (in / name).string());
        EXPECT_EQ(environment.radiance.width, 4);
        EXPECT_EQ(environment.radiance.height, 2);
        EXPECT_EQ(environment.radiance.components, 3);
        for (std::size_t i = 0; i < image.data.size(); ++i)
            EXPECT_NEAR(environment.radiance.data[i], image.data[i], name[4] == 'e' ? 0 : 0.004 * 1.75) << i;
        EXPECT_TRUE(notes.empty()) << notes.front();
    }
}

// Channels without a layer name are the image, wherever they are in the file.
TEST(Environment, TheUnnamedLayerIsReadOrTheFirstWithColours) {
    const std::filesystem::path in = folder();
    const Image image = numbered(), other(4, 2, 3, 9), depth(4, 2, 1, 5);
    writeExr(in / "both.exr", {{{"A.R", "A.G", "A.B"}, &other}, {{"R", "G", "B"}, &image}, {{"Z"}, &depth}});
    std::vector<std::string> notes;
    EXPECT_EQ(readEnvironment(in / "both.exr", notes).radiance.data, image.data);
    EXPECT_TRUE(notes.empty());
    writeExr(in / "sky.exr", {{{"Z"}, &depth}, {{"sky.R", "sky.G", "sky.B"}, &image}});
    EXPECT_EQ(readEnvironment(in / "sky.exr", notes).radiance.data, image.data);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("sky.exr: has no R, G, B outside layers; layer sky is read"), std::string::npos)
        << notes[0];
}

TEST(Environment, WhatIsNoRadianceIsZeroAndCounted) {
    const std::filesystem::path in = folder();
    Image image = numbered(), expected = image;
    const std::pair<std::size_t, float> wrong[] = {{0, -0.001f},
                                                   {1, -7.0f},
                                                   {5, -1.0f},
                                                   {12, std::numeric_limits<float>::infinity()},
                                                   {13, std::numeric_limits<float>::quiet_NaN()},
                                                   {14, -1.0f}};
    for (const auto& [i, value] : wrong) {
        image.data[i] = value;
        expected.data[i] = 0;
    }
    writeExr(in / "sky.exr", {{{"R", "G", "B"}, &image}});
    std::vector<std::string> notes;
    EXPECT_EQ(readEnvironment(in / "sky.exr", notes).radiance.data, expected.data);
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_TRUE(notes[0].ends_with("sky.exr: 3 pixels have components that are negative; 0 is used"))
        << notes[0];
    EXPECT_TRUE(notes[1].ends_with("sky.exr: 1 pixel has a component that is not finite; 0 is used"))
        << notes[1];
}

TEST(Environment, AnotherShapeIsNoted) {
    const std::filesystem::path in = folder();
    const Image image(4, 4, 3, 1);
    writeExr(in / "sky.exr", {{{"R", "G", "B"}, &image}});
    std::vector<std::string> notes;
    EXPECT_EQ(readEnvironment(in / "sky.exr", notes).radiance.height, 4);
    EXPECT_EQ(notes, std::vector<std::string>{"environment " + (in / "sky.exr").string() +
                                              ": 4 x 4 pixels, not twice as wide as high; mapped to all "
                                              "directions"});
}

// 65504 is the largest half float.
TEST(Environment, WhatIsBeyondAHalfIsLimitedWithACount) {
    const std::filesystem::path in = folder();
    const std::string who = "environment " + (in / "sky.exr").string() + ": ";
    const auto notes = [&](float first, float last) {
        Image image = numbered();
        image.data.front() = first;
        image.data.back() = last;
        writeExr(in / "sky.exr", {{{"R", "G", "B"}, &image}});
        std::vector<std::string> lines;
        const Environment environment = readEnvironment(in / "sky.exr", lines);
        EXPECT_EQ(environment.radiance.data.back(), 65504);
        return lines;
    };
    EXPECT_EQ(notes(1, 65504), std::vector<std::string>());
    EXPECT_EQ(notes(1, 65505),
              std::vector<std::string>{who + "1 pixel has a component above 65504; 65504 is used"});
    EXPECT_EQ(notes(1e30f, 70000),
              std::vector<std::string>{who + "2 pixels have components above 65504; 65504 is used"});
}

TEST(Environment, WhatCannotBeOneIsNamed) {
    const std::filesystem::path in = folder();
    const Image grey(4, 2, 1, 1), colour(4, 2, 3, 1);
    writeExr(in / "grey.exr", {{{"Y"}, &grey}});
    writePng(in / "photo.png", {4, 2, 3, std::vector<std::uint8_t>(4 * 2 * 3, 100)});
    std::ofstream(in / "text.hdr") << "sky";
    writeExr(in / "short.exr", {{{"R", "G", "B"}, &colour}});
    std::filesystem::resize_file(in / "short.exr", std::filesystem::file_size(in / "short.exr") / 2);
    const std::pair<const char*, const char*> cases[] = {{"grey.exr", "has no layer with R, G and B"},
                                                         {"photo.png", "is a PNG with display colours"},
                                                         {"text.hdr", "is not a supported image"},
                                                         {"short.exr", ""},
                                                         {"none.exr", "no such file"}};
    for (const auto& [name, fault] : cases) {
        const std::string error = environmentFault(in / name);
        EXPECT_TRUE(error.starts_with((in / name).string() + ": ")) << error;
        EXPECT_NE(error.find(fault), error.npos) << error;
        EXPECT_EQ(error.find('\n'), error.npos) << error;
    }
}
