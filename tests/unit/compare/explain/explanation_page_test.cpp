// SPDX-License-Identifier: MIT
// Images and page of a hand-made explanation.
#include "compare/explain/images.h"
#include "compare/explain/write.h"
#include "compare/output/writers.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

namespace diptych::tests {
namespace {

// `count` causes on 3x2 pixels. Cause 0 has the first pixel, the last cause a negative contribution at the
// second.
Explanation made(std::size_t count) {
    Explanation e;
    e.dominant = Image(3, 2, 1, -1.0f);
    e.unexplained_map = Image(3, 2, 1);
    for (std::size_t i = 0; i < count; ++i) {
        Cause cause;
        cause.name = i == 0 ? "--haze" : "cause " + std::to_string(i);
        cause.description = "on instead of <off> & so";
        cause.contribution = 1.0 / static_cast<double>(count);
        cause.map = Image(3, 2, 1);
        cause.materials = {{-1, "", cause.contribution}};
        e.causes.push_back(cause);
    }
    e.distance = 1;
    e.dominant.data[0] = 0;
    e.causes.front().map.data[0] = 4;
    e.causes.back().map.data[1] = -4;
    return e;
}

// Colours as seen without one type of cone, encoded again (Machado, Oliveira and Fernandes 2009, "A
// Physiologically-based Model for Simulation of Color Vision Deficiency", full severity).
using Matrix = std::array<std::array<double, 3>, 3>;
constexpr Matrix everyCone{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Matrix withoutL{
    {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
constexpr Matrix withoutM{
    {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};

std::array<double, 3> seen(const Matrix& eye, const Color8& color) {
    std::array<double, 3> out{};
    for (std::size_t row = 0; row < 3; ++row) {
        double linear = 0;
        for (std::size_t c = 0; c < 3; ++c) linear += eye[row][c] * std::pow(color[c] / 255.0, 2.2);
        out[row] = 255 * std::pow(std::clamp(linear, 0.0, 1.0), 1 / 2.2);
    }
    return out;
}

double minDistance(const Matrix& eye, std::size_t colors) {
    double min = 1e9;
    for (std::size_t i = 0; i < colors; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const auto a = seen(eye, causeColor(i)), b = seen(eye, causeColor(j));
            min = std::min(min, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
        }
    return min;
}

TEST(ExplanationImages, ColoursAreToldApartByMostEyes) {
    for (const Matrix& eye : {everyCone, withoutL, withoutM}) {
        EXPECT_GT(minDistance(eye, ownColors + 1), 25);
        EXPECT_EQ(minDistance(eye, ownColors + 2), 0) << "the rest share one";
    }
}

TEST(ExplanationImages, TheMapShowsTheCauseElseTheDarkImage) {
    const Explanation e = made(2);
    Image8 shown{3, 2, 3, std::vector<std::uint8_t>(18, 200)};
    const Image8 map = dominantImage(e, shown);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(map.data[c], causeColor(0)[c]);
        EXPECT_LT(map.data[3 + c], 100);
        EXPECT_GT(map.data[3 + c], 0);
    }
    shown.width = 2;
    EXPECT_THROW(dominantImage(e, shown), std::logic_error);
}

TEST(ExplanationImages, ContributionsAreOnOneScaleAndNegativeOnesBlue) {
    const Explanation e = made(3);
    EXPECT_EQ(topOfMaps(e), 4);
    std::set<std::string> names;
    for (const NamedImage& map : explanationMaps(e)) {
        EXPECT_TRUE(names.insert(map.name).second) << map.name;
        EXPECT_EQ(map.image.width, 3);
    }
    EXPECT_TRUE(names.contains("share-1.haze.png"));
    EXPECT_TRUE(names.contains("share-3.cause-2.png"));
    const Image8 last = contributionImage(e.causes.back().map, 4);
    EXPECT_GT(last.data[5], last.data[3] + 50);
    EXPECT_GT(last.data[5], last.data[4] + 20);
    EXPECT_EQ(last.data[0], 0);
}

TEST(ExplanationPage, IsWellFormedAndNamesEveryCause) {
    const ExplainedImages of{
        "a<b>.glb", "deferred", "forward_plus --haze on", {{"Again", "diptych explain a"}}, "a device"};
    for (const std::size_t count : {0u, 1u, 9u}) {
        Explanation e = count > 0 ? made(count) : Explanation();
        e.causes.resize(count);
        const std::string page = explanationHtml(e, of);
        EXPECT_EQ(markupFault(page, {"meta", "img", "br", "wbr"}), "") << count;
        EXPECT_EQ(page.find("<off>"), std::string::npos);
        EXPECT_EQ(countOf(page, "<tr><td>"), count);
        EXPECT_EQ(countOf(page, "share-"), count);
        EXPECT_EQ(countOf(page, "src=\"dominant.png\""), count > 0 ? 1u : 0u);
        EXPECT_NE(page.find("diptych explain a"), std::string::npos);
    }
    // A report shows the same without the images.
    EXPECT_EQ(countOf(inHtml(blocksOf(made(2), of)), "<img"), 0u);
}

TEST(ExplanationPage, TerminalAndPageSayTheSame) {
    const ExplainedImages of{"a.glb", "deferred", "forward_plus", {}, "a device"};
    Explanation e = made(2);
    e.unexplained = 0.25;
    e.nonfinite = 3;
    e.devices = {{"textures", "decoding", 0.5}};
    const std::string text = inText(blocksOf(e, of)), page = inHtml(blocksOf(e, of));
    for (const char* sentence :
         {"lit differs because of --haze 50.0 %, cause 1 50.0 %; unexplained 25.0 %; "
          "across devices by textures",
          "lit of forward_plus differs from that of deferred by 1 W/(sr m^2) on average",
          "excluded: 3 pixels with NaN or infinity", "decoding", "100 % background"}) {
        EXPECT_NE(text.find(sentence), std::string::npos) << text;
        EXPECT_NE(page.find(sentence), std::string::npos) << page;
    }
    EXPECT_NE(inText(blocksOf(Explanation(), of)).find("no cause: lit is the same"), std::string::npos);
}

}  // namespace
}  // namespace diptych::tests
