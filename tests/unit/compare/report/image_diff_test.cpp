// SPDX-License-Identifier: MIT
// Reports of two image files: JSON of one pair and of folders, the table, error files, commands.
#include "compare/files/frame_json.h"
#include "compare/image/channel_image.h"
#include "compare/report/image_diff_json.h"
#include "compare/report/image_diff_report.h"
#include "shared/image/exr.h"
#include "shared/image/png.h"
#include "tests/support/files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using DiffJson = nlohmann::ordered_json;

// Two files of 4 x 3 pixels: grey channels that differ by 1/4 and 1/8 at two pixels, or not; and colours.
struct DiffFiles {
    fs::path here = folder();
    std::string a = (here / "a.exr").string(), b = (here / "b.exr").string();

    DiffFiles() {
        const Image half(4, 3, 1, 0.5f), color(4, 3, 3, 0.25f);
        Image other = half, red = color;
        other.at(1, 2) = 0.75f;
        other.at(2, 0) = 0.375f;
        red.at(3, 1, 0) = 0.5f;
        writeExr(a, {{{"equal.Y"}, &half}, {{"roughness.Y"}, &half}, {{"R", "G", "B"}, &color}});
        writeExr(b, {{{"equal.Y"}, &half}, {{"roughness.Y"}, &other}, {{"R", "G", "B"}, &red}});
    }
    ImageDiff diff(const std::vector<std::string>& channels, double tolerance,
                   std::optional<double> warn = {}) const {
        ImageDiffOptions options;
        options.metric = "max";
        options.metric_requested = options.tolerance_requested = true;
        options.tolerance = tolerance;
        options.warn = warn;
        options.channels = channels;
        return diffImages(a, b, options);
    }
};

DiffJson metricsOfDiff(const ImageChannelDiff& channel) {
    DiffJson all = DiffJson::object();
    for (const auto& [name, value] : channel.measurement->all()) all[name] = finiteOrNull(value);
    return all;
}

TEST(ImageDiffJson, IsWhole) {
    const DiffFiles files;
    for (const auto& [tolerance, warn, verdict] : {std::tuple{0.125, std::optional<double>(), "fail"},
                                                   {0.25, std::optional<double>(0.125), "warn"},
                                                   {0.25, std::optional<double>(), "pass"}}) {
        ImageDiff diff = files.diff({"equal", "roughness"}, tolerance, warn);
        diff.notes = {"a note"};
        const ImageChannelDiff &equal = *diff.channels.at(0), &rough = *diff.channels.at(1);
        ASSERT_EQ(rough.pair.name, "roughness");
        const auto channel = [&](const ImageChannelDiff& of, double max, double mean, double rmse, double p99,
                                 const DiffJson& worst, const DiffJson& share, int different) {
            DiffJson json{{"name", of.pair.name},
                          {"channels", {of.pair.name + ".Y"}},
                          {"reference_type", "float"},
                          {"test_type", "float"},
                          {"metric", "absolute"},
                          {"max", max},
                          {"mean", mean},
                          {"rmse", rmse},
                          {"p99", p99},
                          {"p999", p99},
                          {"flip", nullptr},
                          {"worst_pixel", worst},
                          {"tolerance", tolerance},
                          {"criterion", {{"figure", "max"}, {"measured", max}, {"share_beyond", share}}},
                          {"rule", fmt::format("command line: max <= {}", tolerance)},
                          {"because", ""},
                          {"verdict", max > tolerance ? "fail" : "pass"}};
            if (max > 0 && warn) json["warning"] = "max 0.25 exceeds 0.125, at 8.33 % of the pixels";
            if (max > tolerance) json["reason"] = "max 0.25 exceeds 0.125, at 8.33 % of the pixels";
            json["different_pixels"] = different;
            json["infinite_pixels"] = 0;
            json["nonfinite_pixels"] = {{"reference", 0}, {"test", 0}};
            json["metrics"] = metricsOfDiff(of);
            return json;
        };
        const double beyond = tolerance < 0.25 ? 1.0 / 12 : 0.0;
        DiffJson channels{channel(rough, 0.25, 0.375 / 12, std::sqrt(0.078125 / 12), 0.25, {1, 2}, beyond, 2),
                          channel(equal, 0, 0, 0, 0, nullptr, 0.0, 0)};
        if (verdict == std::string("pass")) std::swap(channels[0], channels[1]);
        const DiffJson expected{{"schema", 1},
                                {"software", "diptych"},
                                {"verdict", verdict == std::string("fail") ? "fail" : "pass"},
                                {"reference", files.a},
                                {"test", files.b},
                                {"reference_format", "OpenEXR"},
                                {"test_format", "OpenEXR"},
                                {"size", {4, 3}},
                                {"pixels", 12},
                                {"metrics", metricsOfDiff(verdict == std::string("pass") ? equal : rough)},
                                {"emptiness", nullptr},
                                {"failures", DiffJson::array()},
                                {"notes", {"a note"}},
                                {"channels", channels}};
        EXPECT_EQ(imageDiffJson(diff), expected.dump(2) + "\n") << verdict;
        diff.failures = {"differs"};
        diff.emptiness = "black";
        const auto failing = DiffJson::parse(imageDiffJson(diff));
        EXPECT_EQ(failing["verdict"], "fail");
        EXPECT_EQ(failing["emptiness"], "black");
        EXPECT_EQ(failing["failures"], DiffJson{"differs"});
    }
}

// FLIP's pooled values; only high dynamic range has exposures.
TEST(ImageDiffJson, HasThePooledValuesOfFlip) {
    const DiffFiles files;
    ImageDiff diff = files.diff({"lit"}, 1);
    ImageChannelDiff& channel = *diff.channels.at(0);
    const HdrFlipResult& flip = *channel.measurement->flip();
    DiffJson expected{{"mean", flip.mean},
                      {"weighted_median", flip.weighted_median},
                      {"weighted_first_quartile", flip.weighted_first_quartile},
                      {"weighted_third_quartile", flip.weighted_third_quartile},
                      {"min", flip.min},
                      {"max", flip.max},
                      {"kind", "LDR"}};
    ASSERT_GT(flip.mean, 0);
    const auto json = [&] { return DiffJson::parse(imageDiffJson(diff))["channels"][0]; };
    channel.display = true;
    EXPECT_EQ(json()["flip_pooled"].dump(), expected.dump());
    EXPECT_EQ(json()["flip"], flip.mean);
    channel.display = false;
    expected["kind"] = "HDR";
    expected["start_exposure"] = flip.start_exposure;
    expected["stop_exposure"] = flip.stop_exposure;
    expected["exposures"] = flip.exposures;
    EXPECT_EQ(json()["flip_pooled"].dump(), expected.dump());
    // Without a single bound there is no tolerance; a metric of all pixels counts those that differ.
    channel.rule.fail = {Condition::Kind::all, {}, 0, {}};
    channel.decision.criterion->differing = true;
    EXPECT_TRUE(json()["tolerance"].is_null());
    EXPECT_EQ(json()["criterion"]["differing_share"], channel.decision.criterion->fraction);
    channel.decision.criterion.reset();
    EXPECT_FALSE(json().contains("criterion"));
}

TEST(FolderDiffJson, IsWhole) {
    const DiffFiles files;
    FolderDiff diff{"left", "right", {}, {}, {}, {}};
    diff.images.push_back(files.diff({"equal"}, 0));
    diff.images[0].name = "x/a.exr";
    const auto expected = [&](const char* verdict, const DiffJson& left, const DiffJson& right,
                              const DiffJson& errors) {
        DiffJson image = DiffJson::parse(imageDiffJson(diff.images[0]));
        image["name"] = "x/a.exr";
        const DiffJson all{{"schema", 1},
                           {"software", "diptych"},
                           {"verdict", verdict},
                           {"reference", "left"},
                           {"test", "right"},
                           {"pictures", DiffJson::array({image})},
                           {"reference_alone", left},
                           {"test_alone", right},
                           {"errors", errors}};
        return all.dump(2) + "\n";
    };
    const DiffJson none = DiffJson::array();
    EXPECT_EQ(folderDiffJson(diff), expected("pass", none, none, none));
    diff.errors = {{"z.exr", "is short"}};
    EXPECT_EQ(folderDiffJson(diff),
              expected("fail", none, none, {{{"name", "z.exr"}, {"message", "is short"}}}));
    EXPECT_TRUE(diff.passed()) << "an error is no difference";
    diff.errors.clear();
    diff.reference_alone = {"u.exr"};
    EXPECT_EQ(folderDiffJson(diff), expected("fail", {"u.exr"}, none, none));
    EXPECT_FALSE(diff.passed());
    diff.reference_alone.clear();
    diff.test_alone = {"v.exr"};
    EXPECT_EQ(folderDiffJson(diff), expected("fail", none, {"v.exr"}, none));
    diff.test_alone.clear();
    diff.images.push_back(files.diff({"roughness"}, 0));
    EXPECT_FALSE(diff.passed());
}

TEST(ImageDiffTable, IsWhole) {
    const DiffFiles files;
    ImageDiff diff = files.diff({"equal", "roughness"}, 0.125);
    const std::string table =
        "  channel    metric     max    mean    rmse  p99.9  psnr  ssim  judged by  measured  limit  "
        "verdict\n"
        "  roughness  absolute  0.25  0.0312  0.0807   0.25  15.8     -  max            0.25  0.125  FAIL\n"
        "  equal      absolute     0       0       0      0   inf     -  max               0  0.125  pass\n"
        "  FAIL b.exr, roughness: max 0.25 exceeds 0.125, at 8.33 % of the pixels, worst at 1,2 (command "
        "line: max <= "
        "0.125)\n";
    const std::string start = files.b + " against " + files.a + ", 4x3\n";
    EXPECT_EQ(diffTable({&diff, 1}), start + std::string(table).replace(table.find("b.exr"), 5, "a.exr") +
                                         "FAIL: roughness beyond tolerance\n");
    diff = files.diff({"roughness"}, 0.25, 0.125);
    EXPECT_TRUE(
        diffTable({&diff, 1})
            .ends_with(
                "  roughness: max 0.25, at most 0.25 allowed, worst at 1,2 (command line: max <= 0.25)\n"
                "  warning a.exr, roughness: max 0.25 exceeds 0.125, at 8.33 % of the pixels (command line: "
                "max <= 0.25)\n"
                "pass: the one compared channel is within tolerance\n"))
        << diffTable({&diff, 1});
    diff.name = "x/y.exr";
    diff.failures = {"one"};
    diff.notes = {"two"};
    diff.emptiness = "three";
    EXPECT_TRUE(
        diffTable({&diff, 1}, {{"e", "is short"}}, {{"f", "is alone"}})
            .ends_with(
                "  warning x/y.exr, roughness: max 0.25 exceeds 0.125, at 8.33 % of the pixels (command "
                "line: max <= 0.25)\n"
                "FAIL f: is alone\nERROR e: is short\nnote: two\nERROR: 1 picture could not be compared: "
                "e; FAIL: one; f: is alone, but three\n"))
        << diffTable({&diff, 1}, {{"e", "is short"}}, {{"f", "is alone"}});
}

// The EXR has every channel's errors, the image those of the deciding channel.
TEST(ImageDiffErrors, AreThoseThatDecide) {
    const DiffFiles files;
    const ImageDiff diff = files.diff({"equal", "roughness", "lit"}, 0.125);
    writeDiffErrors(diff, {OutputKind::exr, files.here / "errors.exr"});
    const ImageFile errors = readExr(files.here / "errors.exr");
    ASSERT_EQ(errors.layers.size(), 3u);
    for (const ImageLayer& layer : errors.layers) {
        EXPECT_EQ(layer.channels, std::vector<std::string>{layer.name + ".Y"});
        for (int i = 0; i < 12; ++i) {
            const int x = i % 4, y = i / 4;
            const float rough = x == 1 && y == 2 ? 0.25f : x == 2 && y == 0 ? 0.125f : 0.0f;
            EXPECT_EQ(layer.image.at(x, y), layer.name == "roughness"                 ? rough
                                            : layer.name == "lit" && x == 3 && y == 1 ? 0.25f
                                                                                      : 0.0f)
                << layer.name << i;
        }
    }
    const ImageChannelDiff& rough =
        **std::ranges::find_if(diff.channels, [](const auto& c) { return c->decision.level == Level::fail; });
    writeDiffErrors(diff, {OutputKind::png, files.here / "errors.png"});
    const DecidingErrors deciding = decidingErrors(diff, rough);
    const Image8 map = errorMap(*deciding.image, deciding.top), read = readPng(files.here / "errors.png");
    ASSERT_EQ(read.data.size(), 4 * 12u) << "with alpha";
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(read.data[4 * i + c], map.data[3 * i + c]) << i;
}

// A report repeats its command into another folder. Channels of our names and widths are ours.
TEST(ImageDiffReport, HasItsCommandAndChannels) {
    const DiffFiles files;
    std::vector<ImageDiff> diffs;
    diffs.push_back(files.diff({}, 0.125));
    writeDiffs(diffs, files.here / "out", {}, {"--metric", "max"}, {{"e", "is short"}}, {{"f", "is alone"}});
    const auto json = nlohmann::json::parse(contentsOf(files.here / "out" / "report.json"));
    EXPECT_EQ(json["verdict"], "fail");
    EXPECT_EQ(json["errors"][0]["scene"], "e");
    EXPECT_EQ(json["failures"][0]["scene"], "f");
    const nlohmann::json& one = json["comparisons"][0];
    EXPECT_EQ(one["covered_pixels"], 12);
    EXPECT_EQ(one["baseline"], "reference");
    EXPECT_EQ(one["test"], "test");
    EXPECT_EQ(one["scene"], "a.exr");
    std::vector<std::string> words = one["command"];
    std::ranges::sort(words);
    std::vector<std::string> expected{
        "diff", files.a, files.b, "--metric", "max", "-o", (files.here / "out-again").string()};
    std::ranges::sort(expected);
    EXPECT_EQ(words, expected);
    for (const auto& channel : one["channels"]) {
        const std::string name = channel["name"];
        const bool ours = name != "equal";
        EXPECT_EQ(findDebugMode(std::to_string(channel["number"].get<int>())) != nullptr, ours) << name;
        EXPECT_EQ(channel["flip"].is_null(), name != "lit");
        EXPECT_GT(channel["figures"].size(), 5u);
        EXPECT_EQ(channel.contains("worst_values"), name != "equal");
    }
    const std::string page = contentsOf(files.here / "out" / "index.html");
    EXPECT_NE(page.find("4 \u00b7 absolute \u00b7 perceptual roughness, 0 to 1"), std::string::npos);
    EXPECT_NE(page.find(" \u00b7 absolute \u00b7 float</span>"), std::string::npos) << "of equal.Y, its type";
}

}  // namespace
}  // namespace diptych
