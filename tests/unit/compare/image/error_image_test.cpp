// SPDX-License-Identifier: MIT
// Error maps, light counts and ranges as images: colours of single pixels, and legends that match them.
#include "compare/image/channel_image.h"
#include "compare/image/heat.h"
#include "compare/page/text.h"
#include "compare/report/report.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"
#include "tests/support/srgb.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <regex>

namespace diptych {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

Rgb pixelOf(const Image8& image, std::size_t i) {
    const std::uint8_t* p = &image.data[static_cast<std::size_t>(image.components) * i];
    return {p[0], p[1], p[2]};
}

// Oklab lightness and hue of a display colour (Ottosson 2020). This is the forward conversion; the map
// uses its inverse.
struct Seen {
    double lightness, hue;
};
Seen seen(const Rgb& color) {
    double linear[3];
    for (std::size_t c = 0; c < 3; ++c) linear[c] = decodedSrgb(color[c] / 255.0);
    const auto cone = [&](double r, double g, double b) {
        return std::cbrt(r * linear[0] + g * linear[1] + b * linear[2]);
    };
    const double l = cone(0.4122214708, 0.5363325363, 0.0514459929),
                 m = cone(0.2119034982, 0.6806995451, 0.1073969566),
                 s = cone(0.0883024619, 0.2817188376, 0.6299787005);
    const double a = 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
                 b = 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s;
    const double hue = std::atan2(b, a) * 180 / std::numbers::pi;
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s, hue < 0 ? hue + 360 : hue};
}

// The map's lightness is linear in the square root of the error: from 0.22 to 0.97. Half a byte step is at
// most 0.004 of lightness; clipping colours outside the display's gamut adds up to 0.012.
TEST(ErrorMap, LightnessIsLinearInTheRootOfTheErrorsFractionOfTheTop) {
    const double fractions[] = {1e-4, 1e-3, 0.01, 1.0 / 16, 0.1, 0.25, 0.4, 9.0 / 16, 0.75, 1};
    for (const double top : {1e-6, 0.37, 1.0, 2500.0}) {
        Image errors(static_cast<int>(std::size(fractions)), 1, 1);
        for (std::size_t i = 0; i < std::size(fractions); ++i)
            errors.data[i] = static_cast<float>(fractions[i] * top);
        const Image8 image = errorMap(errors, top);
        for (std::size_t i = 0; i < std::size(fractions); ++i) {
            const double root = std::sqrt(fractions[i]);
            EXPECT_NEAR(seen(pixelOf(image, i)).lightness, 0.22 + 0.75 * root, 0.016)
                << top << " x " << fractions[i];
            // The map has 253 colours; half a step between them is at most two bytes.
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(pixelOf(image, i)[c], errorColor(root)[c], 2) << top << " x " << fractions[i];
        }
    }
}

// Violet, red, orange, pale yellow.
TEST(ErrorMap, HueTurnsOnceFromVioletToYellow) {
    EXPECT_NEAR(seen(errorColor(0.1)).hue, 300 + 16.5, 12);
    EXPECT_NEAR(seen(errorColor(0.45)).hue, 300 + 74.25 - 360, 12);
    EXPECT_NEAR(seen(errorColor(0.8)).hue, 300 + 132 - 360, 12);
}

TEST(ErrorMap, OnlyWhatIsAboveTheTopIsBeyond) {
    Image errors(5, 1, 1);
    errors.data = {0, 0.5f, std::nextafter(0.5f, 1.0f), 0.5001f, 1};
    const Image8 image = errorMap(errors, 0.5);
    EXPECT_EQ(pixelOf(image, 0), (Rgb{0, 0, 0}));
    EXPECT_EQ(pixelOf(image, 1), errorColor(1));
    EXPECT_EQ(pixelOf(image, 2), errorColor(1)) << "an error image is float32, its top a double";
    EXPECT_EQ(pixelOf(image, 3), beyondColor);
    EXPECT_EQ(pixelOf(image, 4), beyondColor);
}

// Errors out of tolerance keep their order: paler, and white from a thousand times the top.
TEST(ErrorMap, BeyondTheTopColoursAreOrdered) {
    Image errors(6, 1, 1);
    errors.data = {0.6f, 5, 50, 490, 500, 1e9f};
    const Image8 image = errorMap(errors, 0.5);
    EXPECT_EQ(pixelOf(image, 0), beyondColor);
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_GT(pixelOf(image, i)[0], pixelOf(image, i - 1)[0]) << errors.data[i];
    for (const std::size_t i : {4u, 5u}) EXPECT_EQ(pixelOf(image, i), (Rgb{255, 255, 255}));
}

// ---- The page's legend ----

// The card's difference: its image, the ramp's colours and the text below.
struct Legend {
    Image8 image;
    std::vector<Rgb> stops;
    std::string title;
    std::vector<std::string> words;
    std::string swatches;
};

// `stage` selects one of the card's images: the difference, or the left one of the pair.
Legend legendOf(const Report& report, const std::filesystem::path& out, const std::string& channel,
                const std::string& stage = "<figure><div class=\"stage\">") {
    writeReport(report, out, {});
    const std::string page = contentsOf(out / "index.html");
    const std::size_t card = page.find("id=\"c0-" + channel + "\""), element = page.find(stage, card),
                      end = page.find("</figure>", element);
    const std::string text = page.substr(element, end - element);
    Legend legend;
    std::smatch found;
    EXPECT_TRUE(std::regex_search(text, found, std::regex("src=\"([^\"]*)\""))) << text;
    legend.image = readPng(out / found[1].str());
    const std::regex color("#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})"), word("<span>([^<]*)</span>");
    const std::regex title(
        "</div><figcaption>.*<div class=\"legend\"><span class=\"title\">([^<]*)</span><div class=\"ramp\"");
    EXPECT_TRUE(std::regex_search(text, found, title)) << "below the picture, above the ramp: " << text;
    legend.title = found[1];
    const std::string ramp = text.substr(text.find("linear-gradient(90deg"));
    const std::string gradient = ramp.substr(0, ramp.find(')'));
    for (std::sregex_iterator i(gradient.begin(), gradient.end(), color), none; i != none; ++i) {
        Rgb stop{};
        for (std::size_t c = 0; c < 3; ++c)
            stop[c] = static_cast<std::uint8_t>(std::stoi((*i)[c + 1].str(), nullptr, 16));
        legend.stops.push_back(stop);
    }
    const std::string ends = ramp.substr(0, ramp.find("</div></div>"));
    for (std::sregex_iterator i(ends.begin(), ends.end(), word), none; i != none; ++i)
        legend.words.push_back((*i)[1]);
    legend.swatches = ramp.substr(ramp.find("</div></div>"));
    return legend;
}

// Four pixels whose roughness differs by these errors.
Report withErrors(const std::array<double, 4>& errors) {
    std::vector<Frame> frames(2);
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        Frame& frame = frames[path == Path::forward_plus];
        frame.name = std::string(nameOf(path));
        frame.scene = "builtin:one";
        frame.settings.path = path;
        frame.settings.size = {4, 1};
        frame.channels[Channel::material_id] = Image(4, 1, 1, 3.0f);
        Image& roughness = frame.channels[Channel::roughness] = Image(4, 1, 1);
        for (std::size_t i = 0; i < 4 && path == Path::forward_plus; ++i)
            roughness.data[i] = static_cast<float>(errors[i]);
    }
    return reportOf(std::move(frames));
}

// Quantization error bound of roughness.
double roughnessTolerance() {
    const Report report = withErrors({0, 0, 0, 0});
    return std::ranges::find(report.comparisons[0].channels, Channel::roughness,
                             [](const ChannelDiff& c) { return c.mode->channel; })
        ->tolerance.max;
}

bool alike(const Rgb& a, const Rgb& b) {
    for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(a[c] - b[c]) > 1) return false;
    return true;
}

// Left 0, middle a quarter of the end (the ramp uses the square root), right the tolerance. Pixels with
// these errors have the ramp's colours there.
TEST(ErrorMap, ThePagesLegendIsOfTheImage) {
    const double tolerance = roughnessTolerance();
    ASSERT_GT(tolerance, 0);
    const Legend legend = legendOf(withErrors({tolerance / 4, tolerance, 1.5 * tolerance, tolerance / 36}),
                                   folder() / "report", "roughness");
    EXPECT_EQ(legend.words, (std::vector<std::string>{"0", page::number(tolerance / 4),
                                                      page::number(tolerance) + " (tolerance)"}));
    EXPECT_EQ(legend.title, "absolute error, |a-b|");
    ASSERT_EQ(legend.stops.size(), 13u);
    EXPECT_TRUE(alike(pixelOf(legend.image, 0), legend.stops[6])) << "a quarter: the middle";
    EXPECT_TRUE(alike(pixelOf(legend.image, 1), legend.stops[12])) << "the tolerance: the right end";
    EXPECT_EQ(pixelOf(legend.image, 2), beyondColor);
    EXPECT_TRUE(alike(pixelOf(legend.image, 3), legend.stops[2])) << "a 36th: a sixth of the way";
    EXPECT_NE(legend.swatches.find(fmt::format("background:#{:02x}{:02x}{:02x}\"></i>beyond tolerance",
                                               beyondColor[0], beyondColor[1], beyondColor[2])),
              std::string::npos)
        << legend.swatches;
    for (std::size_t i = 0; i < 13; ++i)
        EXPECT_EQ(legend.stops[i], errorColor(static_cast<double>(i) / 12)) << i;
}

// Without errors out of tolerance there is no swatch. Without a tolerance the map ends at the largest
// error.
TEST(ErrorMap, TheLegendNamesItsEnd) {
    const double tolerance = roughnessTolerance();
    Report report = withErrors({tolerance / 4, tolerance / 2, 0, 0});
    const Legend within = legendOf(report, folder() / "report", "roughness");
    EXPECT_EQ(within.swatches.find("beyond"), std::string::npos);
    EXPECT_EQ(within.words.back(), page::number(tolerance) + " (tolerance)");
    report = withErrors({0.25, 1, 0, 0});
    for (ChannelDiff& channel : report.comparisons[0].channels) channel.tolerance.max = 0;
    const Legend largest = legendOf(report, folder() / "report", "roughness");
    EXPECT_EQ(largest.words, (std::vector<std::string>{"0", "0.25", "1 (max)"}));
    EXPECT_TRUE(alike(pixelOf(largest.image, 0), largest.stops[6]));
    EXPECT_EQ(pixelOf(largest.image, 1), largest.stops[12]);
}

// ---- Channels over their range ----

Frame rowFrame(Channel mode, std::vector<float> values) {
    Frame frame;
    const int width = static_cast<int>(values.size()) / debugMode(mode).width;
    frame.settings.size = {width, 1};
    frame.channels[Channel::material_id] = Image(width, 1, 1, 3.0f);
    Image& image = frame.channels[mode] = Image(width, 1, debugMode(mode).width);
    std::ranges::copy(values, image.data.begin());
    return frame;
}
std::pair<Image8, std::string> shown(Channel mode, const std::vector<Frame>& frames) {
    std::vector<const Frame*> all;
    for (const Frame& frame : frames) all.push_back(&frame);
    const ImageScale range = scaleFor(debugMode(mode), {}, all);
    return {channelImage(debugMode(mode), frames[0], range), range.text};
}

// Both images share a range; bytes are linear in it.
TEST(ChannelImageTop, ARangeIsOfBothPanelsAndStated) {
    const auto [depth, words] = shown(
        Channel::depth, {rowFrame(Channel::depth, {1, 2, 3, 4}), rowFrame(Channel::depth, {5, 2, 2, 2})});
    EXPECT_EQ(words, "grey, 1 to 5 m");
    for (std::size_t i = 0; i < 4; ++i)
        for (const std::uint8_t byte : pixelOf(depth, i))
            EXPECT_EQ(byte, std::lround(255 * static_cast<double>(i) / 4)) << i;
    const auto [normals, axes] =
        shown(Channel::normals, {rowFrame(Channel::normals, {0, 0, 1, -1, 0, 0, 0.6f, -0.5f, 0})});
    EXPECT_EQ(axes, "x, y, z as red, green, blue, -1 to 1");
    EXPECT_EQ(pixelOf(normals, 0), (Rgb{128, 128, 255}));
    EXPECT_EQ(pixelOf(normals, 1), (Rgb{0, 128, 128}));
    EXPECT_EQ(pixelOf(normals, 2), (Rgb{204, 64, 128})) << "255 x 0.8, 255 x 0.25, 127.5";
    const auto [rough, grey] =
        shown(Channel::roughness, {rowFrame(Channel::roughness, {0, 0.25f, 1, 0.75f})});
    EXPECT_EQ(grey, "grey, 0 to 1");
    EXPECT_EQ(pixelOf(rough, 1), (Rgb{64, 64, 64}));
    EXPECT_EQ(pixelOf(rough, 3), (Rgb{191, 191, 191}));
}

// ---- Light counts ----

// Dark blue, blue, teal, green, yellow, white at fifths of the top, interpolated linearly.
constexpr Rgb heatStops[] = {{20, 20, 90},   {40, 70, 155},  {30, 122, 145},
                             {75, 170, 110}, {220, 210, 85}, {255, 255, 255}};

TEST(HeatImage, CountsHaveTheLegendsColours) {
    const auto [image, words] =
        shown(Channel::light_count, {rowFrame(Channel::light_count, {0, 4, 8, 12, 16, 20, 2, 10})});
    EXPECT_EQ(words, "heat map, 0 to 20 lights");
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(pixelOf(image, i), heatStops[i]) << 4 * i << " of 20";
    EXPECT_EQ(pixelOf(image, 6), (Rgb{30, 45, 123})) << "a tenth: half way from dark blue to blue";
    EXPECT_EQ(pixelOf(image, 7), (Rgb{53, 146, 128})) << "half: between teal and green";
}

TEST(HeatImage, TheTopIsTheNextRoundNumber) {
    for (const auto& [largest, top] : {std::pair{0.0, 1.0},
                                       {1.0, 1.0},
                                       {2.0, 2.0},
                                       {3.0, 5.0},
                                       {5.0, 5.0},
                                       {6.0, 10.0},
                                       {10.0, 10.0},
                                       {11.0, 20.0},
                                       {21.0, 50.0},
                                       {99.0, 100.0},
                                       {256.0, 500.0},
                                       {1000.0, 1000.0},
                                       {1001.0, 2000.0},
                                       {65536.0, 100000.0}})
        EXPECT_EQ(heatTop(largest), top) << largest;
}

// On a page the image has no legend inside. It is below, with title, unit and the map's colours.
TEST(HeatImage, ThePagesLegendStandsBelowWithTitleAndUnit) {
    std::vector<Frame> frames = withOnly({Channel::light_count, Channel::material_id}, bothFrames());
    for (Frame& frame : frames) {
        std::ranges::fill(frame.channels.at(Channel::material_id).data, 3.0f);  // all pixels show a surface
        Image& counts = frame.channels.at(Channel::light_count);
        for (std::size_t i = 0; i < counts.pixels(); ++i) counts.data[i] = static_cast<float>(i % 6 * 4);
    }
    const Report report = reportOf(std::move(frames));
    const Legend legend = legendOf(report, folder() / "report", "light_count", "<div class=\"pair ");
    EXPECT_EQ(legend.title, "lights evaluated per pixel");
    EXPECT_EQ(legend.words, (std::vector<std::string>{"0", "10", "20 lights"}));
    ASSERT_EQ(legend.stops.size(), 11u);
    ASSERT_EQ(legend.image.height, 3) << "no strip of a legend in it";
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(legend.stops[2 * i], heatStops[i]) << i;
        EXPECT_EQ(pixelOf(legend.image, i), heatStops[i]) << 4 * i << " of 20";
    }
}

// Reads the legend's text back from its pixels.
TEST(HeatImage, TheLegendInTheImageStatesTheScale) {
    static const std::map<std::string, char> font{{"###"
                                                   "# #"
                                                   "# #"
                                                   "# #"
                                                   "###",
                                                   '0'},
                                                  {" # "
                                                   "## "
                                                   " # "
                                                   " # "
                                                   "###",
                                                   '1'},
                                                  {"###"
                                                   "  #"
                                                   "###"
                                                   "#  "
                                                   "###",
                                                   '2'},
                                                  {"###"
                                                   "#  "
                                                   "###"
                                                   "  #"
                                                   "###",
                                                   '5'},
                                                  {"#  "
                                                   "# #"
                                                   "## "
                                                   "## "
                                                   "# #",
                                                   'k'}};
    constexpr Rgb white{255, 255, 255};
    for (const auto& [top, expected] :
         {std::pair{20.0, "0 10 20"}, {50.0, "0 25 50"}, {20000.0, "0 10k 20k"}}) {
        const Image8 image =
            withHeatLegend({240, 40, 3, std::vector<std::uint8_t>(std::size_t{3} * 240 * 40, 77)}, top);
        ASSERT_EQ(image.height, 65) << "25 rows more";
        const auto at = [&](int x, int y) {
            return pixelOf(image, static_cast<std::size_t>(y) * 240 + static_cast<std::size_t>(x));
        };
        // Five rows of glyphs end 3 pixels above the bottom.
        std::string words;
        int last = -9;
        for (int x = 0; x < 106; ++x) {
            bool begins = false;
            std::string glyph;
            for (int y = 57; y < 62; ++y) {
                begins = begins || at(x, y) == white;
                for (int k = 0; k < 3; ++k) glyph += at(x + k, y) == white ? '#' : ' ';
            }
            if (!begins) continue;
            if (last >= 0 && x > last + 4) words += ' ';
            const auto found = font.find(glyph);
            words += found == font.end() ? '.' : found->second;
            last = x;
            x += 2;
        }
        EXPECT_EQ(words, expected);
        // The bar above: 100 pixels, each with the colour of its centre.
        for (int x = 0; x < 100; ++x) EXPECT_EQ(at(3 + x, 52), heatColor((x + 0.5) / 100)) << x;
        for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(heatColor(static_cast<double>(i) / 5), heatStops[i]);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 240; ++x)
                ASSERT_EQ(at(x, y), (Rgb{77, 77, 77})) << "the picture itself stays";
        EXPECT_EQ(at(3, 43), white) << "a title, in capitals: the L's stroke";
        EXPECT_EQ(at(5, 43), (Rgb{0, 0, 0}));
    }
}

}  // namespace
}  // namespace diptych
