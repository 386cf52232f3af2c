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
    EXPECT_EQ(names, (std::set<std::string>{"difference.png", "share-1.haze.png", "share-2.cause-1.png",
                                            "share-3.cause-2.png", "unexplained.png"}));
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

// Two causes with parts, of which a row names three of each kind, from 5 % on.
Explanation detailed() {
    Explanation e = made(3);
    e.distance = 2;
    e.unexplained = 0.5;
    e.flip = 0.5;
    e.flip_unexplained = 0.125;
    e.causes.resize(2);
    Cause &first = e.causes[0], &second = e.causes[1];
    first.contribution = 1.5;
    first.interval = 0.125;
    first.alone = 1;
    first.last = 0.75;
    first.worst = 4;
    first.worst_x = 2, first.worst_y = 1;
    first.dominates = 0.25;
    first.flip = 0.25;
    first.materials = {{12, "glass", 0.75}, {-1, "", 0.375}, {3, "", 0.075}, {4, "fourth", 0.075}};
    first.lights = {{3, "lamp", 1.125}, {0, "sun", 0.0749}, {5, "faint", 0.0149}};
    second.contribution = -0.5;
    second.description = "darker";
    second.alone = -0.25;
    second.last = -0.125;
    second.worst = -2;
    second.worst_x = 1;
    second.dominates = 0.5;
    second.flip = -0.125;
    second.materials = {{0, "", -0.5}, {1, "other", 0.25}};
    e.pairs = {{0, 1, 0.25}, {1, 0, -0.5}};
    e.devices = {{"textures", "decoding", 0.5}, {"edges", "another triangle", -0.25}};
    e.reproduction = {0.001, 0.02};
    e.nonfinite = 1;
    e.subsets = 1, e.frames = 2;
    e.without_effect = {"metallic", "--seed"};
    e.lights_drawn = 32, e.lights_omitted = 5;
    return e;
}

TEST(ExplanationPage, ATableSaysAllOfACause) {
    const ExplainedImages of{"a.glb", "deferred", "forward_plus --haze on", {{"Again", "diptych explain a"}}};
    EXPECT_EQ(
        inText(blocksOf(detailed(), of)),
        "Why lit differs: a.glb\n"
        "lit differs because of --haze 75.0 %, cause 1 -25.0 %; unexplained 25.0 %; across devices by "
        "textures 25.0 %, edges -12.5 %\n"
        "lit of forward_plus --haze on differs from that of deferred by 2 W/(sr m^2) on average, FLIP 0.5\n"
        "  across devices     share  description\n"
        "  textures         25.00 %  decoding\n"
        "  edges           -12.50 %  another triangle\n"
        "  cause                    share   of FLIP  largest at  worst pixel  materials and lights\n"
        "  --haze       75.00 % +- 6.25 %   50.00 %      25.0 %          2,1  50 % material 12, glass; 25 % "
        "background; 75 % light 3, lamp\n"
        "  cause 1               -25.00 %  -25.00 %      50.0 %          1,0  100 % material 0\n"
        "  unexplained            25.00 %   25.00 %                           no channel and no Setting "
        "describes it\n"
        "  excluded: 1 pixel with NaN or infinity in one of the pictures\n"
        "  --haze and cause 1 hide each other (interaction +12.5 %)\n"
        "  cause 1 and --haze are redundant (interaction -25.0 %)\n"
        "  differs without an effect on any pixel: metallic, --seed\n"
        "  lighting its own channels misses lit by 0.1 % in deferred and by 2 % in forward_plus --haze on\n"
        "  by light: the 32 brightest were rendered alone, the other 5 were not\n"
        "  1 picture shaded from 2 rendered frames\n");
    for (const output::Block& block : blocksOf(detailed(), of))
        if (const auto* table = std::get_if<output::Table>(&block.content);
            table && table->columns[0].title == "cause") {
            EXPECT_EQ(
                inCsv(*table),
                "cause,share,of FLIP,alone,last,largest at,worst pixel,there,description,materials and "
                "lights\r\n"
                "--haze,75.00 % +- 6.25 %,50.00 %,50.00 %,37.50 %,25.0 %,\"2,1\",4,on instead of <off> & "
                "so,\"50 % material 12, glass; 25 % background; 75 % light 3, lamp\"\r\n"
                "cause 1,-25.00 %,-25.00 %,-12.50 %,-6.25 %,50.0 %,\"1,0\",-2,darker,100 % material 0\r\n"
                "unexplained,25.00 %,25.00 %,,,,,,remains with every cause swapped,no channel and no Setting "
                "describes it\r\n");
        }
    EXPECT_EQ(toJson(detailed(), of), nlohmann::ordered_json::parse(
                                          R"(
{"schema":1,"software":"diptych","scene":"a.glb","baseline":"deferred","test":"forward_plus --haze on",
"distance":2.0,"flip":0.5,"causes":[{"name":"--haze","share":0.75,"interval":0.0625,
"where":[2,1],"shows":"on instead of <off> & so","alone":0.5,"last":0.375,"dominates":0.25,
"flip_share":0.5,"materials":[{"id":12,"name":"glass","share":0.375},{"id":-1,"name":"",
"share":0.1875},{"id":3,"name":"","share":0.0375},{"id":4,"name":"fourth","share":0.0375}],
"lights":[{"place":3,"name":"lamp","share":0.5625},{"place":0,"name":"sun","share":0.03745}]},
{"name":"cause 1","share":-0.25,"interval":0.0,"where":[1,0],"shows":"darker","alone":-0.125,
"last":-0.0625,"dominates":0.5,"flip_share":-0.25,"materials":[{"id":0,"name":"",
"share":-0.25},{"id":1,"name":"other","share":0.125}],"lights":[]}],"unexplained":0.25,
"flip_unexplained":0.125,"pairs":[{"causes":["--haze","cause 1"],"interaction":0.125},
{"causes":["cause 1","--haze"],"interaction":-0.25}],"devices":[{"name":"textures",
"share":0.25,"shows":"decoding"},{"name":"edges","share":-0.125,"shows":"another triangle"}],
"inert":["metallic","--seed"],"reproduction":[0.001,0.02],"shaded":1,"lights_drawn":32,
"lights_left_out":5,"nonfinite":1,"drawn":2,"command":"diptych explain a"})"));
    ExplainedImages bare = of;
    bare.commands.clear();
    EXPECT_EQ(toJson(Explanation(), bare)["command"], nullptr);
    EXPECT_EQ(toJson(Explanation(), bare)["unexplained"], 0) << "of no difference";
}

// The headline has every cause and device; without causes it says so.
TEST(ExplanationPage, AHeadlineOfAnUnknownReason) {
    Explanation e;
    e.distance = e.unexplained = 1;
    EXPECT_EQ(headlineOf(e), "lit differs for an unknown reason; unexplained 100.0 %");
}

// The page's images stand in order, each with its colour and share; the rest are on one scale.
TEST(ExplanationPage, EveryPictureHasItsCaption) {
    const ExplainedImages of{"a.glb", "deferred", "forward_plus", {}, "a device"};
    const auto picturesOf = [&](const Explanation& e) {
        const std::string page = explanationHtml(e, of);
        std::vector<std::string> sources;
        for (std::size_t at = page.find("src=\""); at != page.npos; at = page.find("src=\"", at + 1))
            sources.push_back(page.substr(at + 5, page.find('"', at + 5) - at - 5));
        return sources;
    };
    using Sources = std::vector<std::string>;
    Explanation e = detailed();
    EXPECT_EQ(picturesOf(e), (Sources{"dominant.png", "lit.baseline.png", "lit.test.png", "difference.png",
                                      "share-1.haze.png", "share-2.cause-1.png", "unexplained.png"}));
    EXPECT_EQ(picturesOf(Explanation()), (Sources{"lit.baseline.png", "lit.test.png"}));
    const std::string page = explanationHtml(e, of);
    for (const char* part :
         {"<h2>The pictures</h2>", "</i>--haze 75.00 %", "</i>cause 1 -25.00 %", "unexplained 25.00 %",
          "black 0, pale yellow 4 W/(sr m^2), cyan beyond", "3\u00d72, on a device", "#56b4e9", "#e69f00"})
        EXPECT_NE(page.find(part), std::string::npos) << part << page;
    e.unexplained = 0;
    EXPECT_EQ(countOf(explanationHtml(e, of), "unexplained.png"), 0u);
}

// Of 2000 pixels that differ, two may be beyond the end of the colours; of 999, none.
TEST(ExplanationImages, AScaleEndsAtThe999thOfAThousand) {
    for (const auto& [count, top] : {std::pair{2000, 1998.0}, {1000, 999}, {999, 999}, {1, 1}, {0, 0}}) {
        Explanation e;
        e.unexplained_map = Image(50, 50, 1, -1.0f);
        for (int i = 0; i < count; ++i)
            e.unexplained_map.data[static_cast<std::size_t>(i)] = static_cast<float>(i + 1);
        EXPECT_EQ(topOfMaps(e), top) << count;
    }
}

// Brightness is the root of the share of the scale; the colour map of errors ends at the same value.
TEST(ExplanationImages, NegativeContributionsAreBlueByTheirRoot) {
    Image map(3, 2, 1), positive = map;
    map.data = {0, 1, -1, -4, -16, -1e-9f};
    positive.data = {0, 1, 0, 0, 0, 0};
    const Image8 errors = errorMap(positive, 4), image = contributionImage(map, 4);
    std::vector<std::uint8_t> expected(errors.data.begin(), errors.data.begin() + 6);
    for (const auto& color : {Color8{35, 75, 128}, {70, 150, 255}, {70, 150, 255}, {0, 0, 0}})
        expected.insert(expected.end(), color.begin(), color.end());
    EXPECT_EQ(image.data, expected);
    EXPECT_EQ(contributionImage(map, 0).data, errorMap(positive, 0).data) << "no scale";
}

TEST(ExplanationImages, TheDarkImageIsGreyByLuminance) {
    Explanation e;
    e.dominant = Image(2, 1, 1, -1.0f);
    e.dominant.data[1] = 9;
    const Image8 shown{2, 1, 4, {100, 200, 50, 255, 255, 255, 255, 255}};
    // 0.3 (0.2126 100 + 0.7152 200 + 0.0722 50) = 50.4
    EXPECT_EQ(dominantImage(e, shown).data, (std::vector<std::uint8_t>{50, 50, 50, 0xd8, 0xd8, 0xd8}));
}

}  // namespace
}  // namespace diptych::tests
