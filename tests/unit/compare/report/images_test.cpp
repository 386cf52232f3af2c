// SPDX-License-Identifier: MIT
// Position of images on a page: the baseline left, the other right, and their difference. Checked by the
// pixels of the files and data URIs. And the scale of the error map.
#include "compare/report/report.h"
#include "compare/verdict/rules.h"
#include "shared/image/png.h"
#include "tests/support/base64.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// Contents of one card: the upper left pixel of each image, in bytes, and the name on each side.
struct CardImages {
    std::array<int, 3> left{}, right{}, difference{};
    std::string left_name, right_name, left_button, right_button;
    bool operator==(const CardImages&) const = default;
};

std::array<int, 3> firstPixel(const fs::path& folder, const std::string& source) {
    fs::path file = folder / source;
    const std::string uri = "data:image/png;base64,";
    if (source.starts_with(uri)) {
        file = folder / "embedded.png";
        std::ofstream(file, std::ios::binary) << fromBase64(source.substr(uri.size()));
    }
    const Image8 image = readPng(file);
    return {image.data[0], image.data[1], image.data[2]};
}

std::string between(const std::string& text, const std::string& start, const std::string& end,
                    std::size_t from = 0) {
    const std::size_t at = text.find(start, from);
    if (at == std::string::npos) return "nothing";
    return text.substr(at + start.size(), text.find(end, at + start.size()) - at - start.size());
}

CardImages cardIn(const std::string& page, const fs::path& folder, const std::string& id) {
    const std::size_t start = page.find("id=\"" + id + "\"");
    const std::string card = page.substr(start, page.find("<details class=\"box card", start + 1) - start);
    CardImages shown;
    const auto stage = [&](const std::string& side, std::array<int, 3>& pixel, std::string& name) {
        const std::size_t at = card.find("<div class=\"stage" + side + "\">");
        EXPECT_NE(at, std::string::npos) << id << side;
        pixel = firstPixel(folder, between(card, "src=\"", "\"", at));
        name = between(card, "<span class=\"tag\">", "<", at);
    };
    std::string none;
    stage(" left", shown.left, shown.left_name);
    stage(" right", shown.right, shown.right_name);
    stage("", shown.difference, none);
    shown.left_button = between(card, "<button data-show=\"left\" title=\"1\">", "<");
    shown.right_button = between(card, "<button data-show=\"right\" title=\"2\">", "<");
    return shown;
}

// In failing channels the baseline is 0.25 everywhere and the other is 0.75; in a second scene 0 and 1.
std::vector<Frame> greyFrames(float deferred, float forward, const std::string& scene) {
    std::vector<Frame> frames =
        withOnly({Channel::roughness, Channel::metallic, Channel::material_id}, bothFrames(scene));
    for (Frame& frame : frames) {
        const float value = frame.settings.path == Path::deferred ? deferred : forward;
        for (auto& [mode, image] : frame.channels)
            std::ranges::fill(image.data, debugMode(mode).kind == ChannelKind::id ? 3.0f : value);
    }
    return frames;
}

constexpr std::array<int, 3> quarter{64, 64, 64}, max{191, 191, 191}, black{0, 0, 0}, white{255, 255, 255};

// Colour of an error of 0.5, many times the channel's tolerance.
std::array<int, 3> errorOfHalf(const Report& report, const std::string& name) {
    for (const ChannelDiff& channel : report.comparisons[0].channels)
        if (channel.mode->name == name) {
            const Image8 pixel = errorMap(Image(1, 1, 1, 0.5f), channel.tolerance.max);
            return {pixel.data[0], pixel.data[1], pixel.data[2]};
        }
    return {};
}

TEST(ReportImages, LeftIsTheBaselineRightTheOther) {
    for (const Path baseline : {Path::deferred, Path::forward_plus})
        for (const bool single : {false, true}) {
            CompareOptions options;
            options.baseline = baseline;
            const Report report =
                makeReport({{greyFrames(0.25f, 0.75f, "builtin:one")}}, {"a CPU", "1.0", "cpu"}, options);
            ReportOptions how;
            how.single_file = single;
            const fs::path out = folder() / "report";
            writeReport(report, out, how);
            const std::string page = contentsOf(out / "index.html");
            for (const char* channel : {"c0-roughness", "c0-metallic"}) {
                const std::array<int, 3> apart = errorOfHalf(report, channel + 3);
                CardImages expected{quarter,        max,        apart,         "deferred",
                                    "forward_plus", "deferred", "forward_plus"};
                if (baseline == Path::forward_plus)
                    expected = {max, quarter, apart, "forward_plus", "deferred", "forward_plus", "deferred"};
                const CardImages shown = cardIn(page, out, channel);
                EXPECT_EQ(shown.left, expected.left) << channel << single;
                EXPECT_EQ(shown.right, expected.right) << channel << single;
                EXPECT_TRUE(shown == expected) << channel << single;
            }
        }
}

// The reference first, then both paths against each other; each scene has its own images.
TEST(ReportImages, EveryPairHasItsOwnImages) {
    std::vector<Frame> frames = greyFrames(0.25f, 0.75f, "builtin:one");
    for (Frame& frame : greyFrames(0, 1, "builtin:two")) frames.push_back(std::move(frame));
    const fs::path out = folder() / "report";
    writeReport(reportOf(frames), out, {});
    std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(cardIn(page, out, "c0-roughness").left, quarter);
    EXPECT_EQ(cardIn(page, out, "c0-roughness").right, max);
    EXPECT_EQ(cardIn(page, out, "c1-roughness").left, black);
    EXPECT_EQ(cardIn(page, out, "c1-roughness").right, white);

    Frame reference = frames[2];
    reference.name = "reference";
    reference.settings.path = Path::reference;
    std::vector<Frame> three{reference, frames[0], frames[1]};
    for (Frame& frame : three) frame.scene = "builtin:one";
    writeReport(makeReport({{three}}, {"a CPU", "1.0", "cpu"}), out, {});
    page = contentsOf(out / "index.html");
    for (const auto& [card, left, right, first, second] :
         {std::tuple{"c0-roughness", black, quarter, "reference", "deferred"},
          {"c1-roughness", black, max, "reference", "forward_plus"},
          {"c2-roughness", quarter, max, "deferred", "forward_plus"}}) {
        const CardImages shown = cardIn(page, out, card);
        EXPECT_EQ(shown.left, left) << card;
        EXPECT_EQ(shown.right, right) << card;
        EXPECT_EQ(shown.left_name, first) << card;
        EXPECT_EQ(shown.right_name, second) << card;
    }
}

// It ends at the limit of single errors; without one, at the largest finite error.
TEST(ReportImages, AnErrorMapEndsAtTheLimitOrTheLargestFiniteError) {
    struct Bounded {
        const char* bound;
        float first;  // at the first pixel of the test
        std::optional<double> limit;
        double top;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const auto& [bound, first, limit, top] : {Bounded{R"("max": 0.125)", 0.25f, 0.125, 0.125},
                                                   {R"("max": 0.125)", nan, 0.125, 0.125},
                                                   {R"("rmse": 1)", 0.25f, {}, 0.5},
                                                   {R"("rmse": 1)", 1.25f, {}, 1},
                                                   {R"("rmse": 1)", nan, {}, 0.5}}) {
        std::vector<Frame> frames = greyFrames(0.25f, 0.5f, "builtin:one");
        Image& test = frames[1].channels[Channel::roughness];
        test.at(0, 0) = first;
        test.at(2, 1) = 0.75f;
        CompareOptions options;
        options.rules = rulesFromJson(
            fmt::format(R"({{"rules": [{{"channel": "*", {}, "because": "any"}}]}})", bound), "t.json");
        const Report report = makeReport({{frames}}, {"a CPU", "1.0", "cpu"}, options);
        const auto& channels = report.comparisons[0].channels;
        const auto at = std::ranges::find(channels, &debugMode(Channel::roughness), &ChannelDiff::mode);
        ASSERT_NE(at, channels.end());
        const ChannelImages images =
            layoutOf(report, {}).images[0][static_cast<std::size_t>(at - channels.begin())];
        EXPECT_EQ(images.error_limit, limit) << bound << " " << first;
        EXPECT_EQ(images.error_top, top) << bound << " " << first;
    }
}

// Negative control: with one file for both sides the cards differ from the expectation.
TEST(ReportImages, OneFileOnBothSidesIsSeen) {
    const fs::path out = folder() / "report";
    writeReport(reportOf(greyFrames(0.25f, 0.75f, "builtin:one")), out, {});
    std::string page = contentsOf(out / "index.html");
    const std::string wrong = "src=\"roughness.forward_plus.png\"";
    const std::size_t at = page.find(wrong, page.find("id=\"c0-roughness\""));
    ASSERT_NE(at, std::string::npos);
    page.replace(at, wrong.size(), "src=\"roughness.deferred.png\"");
    EXPECT_EQ(cardIn(page, out, "c0-roughness").right, quarter);
}

}  // namespace
}  // namespace diptych
