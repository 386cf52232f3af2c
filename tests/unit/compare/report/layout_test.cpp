// SPDX-License-Identifier: MIT
// Names of a report's files, which of them are kept, and the limits of error maps. Exposures' line.
#include "compare/report/layout.h"
#include "compare/report/exposure_line.h"
#include "shared/image/exr.h"
#include "shared/image/png.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>

namespace diptych {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

// One channel of a pixel that differs.
Report ofOnePixel(Channel mode) {
    Report report;
    report.device.name = "a CPU";
    for (const float value : {1.0f, 1.5f}) {
        Frame& frame = report.frames.emplace_back();
        frame.name = value == 1 ? "left" : "right";
        frame.settings.size = {2, 1};
        frame.channels[mode] = Image(2, 1, debugMode(mode).width, value);
    }
    Comparison& one = report.comparisons.emplace_back();
    one.test = 1;
    one.coverage = everyPixel(2);
    ChannelDiff& channel = one.channels.emplace_back();
    channel.mode = &debugMode(mode);
    channel.stats.different = 2;
    channel.stats.max = 0.5;
    return report;
}

// A rule's limit is shown where its metric is a maximum or percentile of the errors that the image shows.
TEST(ReportLayout, ARulesLimitIsOnErrorsThatAreDrawn) {
    struct Drawn {
        Channel channel;
        const char* shown;  // "": the channel's error
        std::set<std::string> metrics;
    };
    const std::set<std::string> own{"max", "p99", "p999"},
        relative{"relative_max", "relative_p99", "relative_p999"};
    std::set<std::string> both = own, angles = own;
    both.insert(relative.begin(), relative.end());
    angles.insert("angle_max");
    for (const auto& [channel, shown, metrics] : {Drawn{Channel::roughness, "", own},
                                                  {Channel::lit, "", both},
                                                  {Channel::normals, "", angles},
                                                  {Channel::anisotropy_direction, "", angles},
                                                  {Channel::roughness, "FLIP", {"flip_max"}},
                                                  {Channel::lit, "FLIP", {"flip_max"}},
                                                  {Channel::roughness, "relative", relative},
                                                  {Channel::lit, "relative", both},
                                                  {Channel::normals, "relative", relative}})
        for (const char* metric :
             {"max", "p99", "p999", "mean", "rmse", "relative_max", "relative_p99", "relative_p999",
              "relative_mse", "angle_max", "flip", "flip_max", "psnr"}) {
            Report report = ofOnePixel(channel);
            ChannelDiff& diff = report.comparisons[0].channels[0];
            diff.rule = "rule 1";
            diff.criterion = {.metric = metric, .measured = 1, .limit = 0.125};
            if (*shown) diff.shown_error = std::make_shared<Image>(2, 1, 1);
            diff.shown_error_name = shown;
            EXPECT_EQ(layoutOf(report, {}).images[0][0].error_limit.has_value(), metrics.contains(metric))
                << debugMode(channel).name << " " << shown << " " << metric;
        }
}

TEST(ReportLayout, AnErrorMapHasALimitAndAnEnd) {
    const auto images = [](const auto& change) {
        Report report = ofOnePixel(Channel::roughness);
        ChannelDiff& diff = report.comparisons[0].channels[0];
        diff.tolerance.max = 0.25;
        diff.criterion = {.metric = "max", .measured = 1, .limit = 0.125};
        change(diff);
        const ChannelImages found = layoutOf(report, {}).images[0][0];
        return std::pair{found.error_limit.value_or(-1), found.error_top};
    };
    using Map = std::pair<double, double>;
    const auto ruled = [](auto& c) { c.rule = "rule 1"; };
    const auto shows = [](auto& c) {
        c.shown_error = std::make_shared<Image>(2, 1, 1);
        c.shown_error_name = "FLIP";
        c.shown_error_top = 3;
    };
    EXPECT_EQ(images([](auto&) {}), (Map{0.25, 0.25})) << "the tolerance";
    EXPECT_EQ(images([](auto& c) { c.tolerance.max = 0; }), (Map{0, 0.5}));
    EXPECT_EQ(images([](auto& c) { c.tolerance.max = unlimited; }), (Map{-1, 0.5}));
    EXPECT_EQ(images([](auto& c) {
                  c.tolerance.max = unlimited;
                  c.stats.max = unlimited;
              }),
              (Map{-1, 0.5}))
        << "the largest finite error";
    EXPECT_EQ(images([&](auto& c) { shows(c); }), (Map{0.25, 0.25}));
    EXPECT_EQ(images([&](auto& c) {
                  shows(c);
                  c.tolerance.max = 0;
              }),
              (Map{0, 3}));
    EXPECT_EQ(images([&](auto& c) { ruled(c); }), (Map{0.125, 0.125}));
    EXPECT_EQ(images([&](auto& c) {
                  ruled(c);
                  c.criterion.reset();
              }),
              (Map{-1, 0.5}));
    // A fraction of pixels has their threshold, on the channel's own errors.
    const auto fraction = [&](auto& c) {
        ruled(c);
        c.criterion->metric = "failing";
        c.criterion->above = 0.0625;
    };
    EXPECT_EQ(images([&](auto& c) { fraction(c); }), (Map{0.0625, 0.0625}));
    EXPECT_EQ(images([&](auto& c) {
                  fraction(c);
                  shows(c);
              }),
              (Map{-1, 3}));
}

TEST(ReportLayout, FilesAreThoseThatAreKept) {
    Report report = ofOnePixel(Channel::roughness);
    Comparison& one = report.comparisons[0];
    one.explained = Explained{{}, "{}", Image8{}};
    report.closer_paths = {{0, {0, 1}, {}}};
    report.closer_paths[0].channels.emplace_back().mode = &debugMode(Channel::lit);
    const auto files = [&](Keep keep, bool single = false) {
        ReportOptions options;
        options.keep = keep;
        options.single_file = single;
        const ReportLayout layout = layoutOf(report, options);
        EXPECT_EQ(layout.keep, keep);
        EXPECT_EQ(layout.single_file, single);
        return layout.files();
    };
    using Names = std::vector<std::string>;
    const Names none{"index.html", "junit.xml", "report.json"},
        closer{"index.html", "junit.xml", "lit.nearer.png", "report.json"},
        all{"causes.png",         "index.html",          "junit.xml",          "left.exr",
            "lit.nearer.png",     "report.json",         "right.exr",          "roughness.difference.png",
            "roughness.left.png", "roughness.right.png", "roughness.values.js"};
    EXPECT_EQ(files(Keep::all), all);
    EXPECT_EQ(files(Keep::failing), closer) << "it passes";
    EXPECT_EQ(files(Keep::none), none);
    EXPECT_EQ(files(Keep::all, true), none);
    one.failures = {"differs"};
    EXPECT_EQ(files(Keep::failing), all);
    // Of a file there is an EXR only if another renderer made it now.
    for (const bool external : {false, true}) {
        report.frames[0].origin.file = "a.exr";
        report.frames[0].origin.external = external;
        const Names names = files(Keep::all);
        EXPECT_EQ(std::ranges::count(names, "left.exr"), external);
        EXPECT_EQ(std::ranges::count(names, "right.exr"), 1);
    }
    // Channels of one side, and those that are equal.
    report.frames[1].channels.clear();
    one.channels[0].verdict = Verdict::forward_only;
    ChannelImages images = layoutOf(report, {}).images[0][0];
    EXPECT_EQ(images.baseline, "roughness.left.png");
    EXPECT_EQ(images.test + images.same + images.difference, "");
    EXPECT_FALSE(images.differ);
    EXPECT_TRUE(images.kept);
    report = ofOnePixel(Channel::roughness);
    report.comparisons[0].channels[0].stats.different = 0;
    images = layoutOf(report, {}).images[0][0];
    EXPECT_EQ(images.same, "roughness.png");
    EXPECT_EQ(images.difference, "");
    EXPECT_FALSE(images.differ);
}

// junit.xml names no embedded images.
TEST(ReportLayout, OnlyFilesAreOnDisk) {
    ReportLayout layout;
    layout.images = {std::vector<ChannelImages>(1)};
    layout.images[0][0].baseline = "a.png";
    for (const bool single : {false, true}) {
        layout.single_file = single;
        EXPECT_EQ(onDisk(layout).images[0][0].baseline, single ? "" : "a.png");
    }
}

TEST(ExposureLine, IsOneOrARange) {
    const auto line = [](const std::vector<Exposure>& all) { return exposureLine(all); };
    const Exposure one{1, true, "one"}, other{1, true, "other"}, half{0.5, true, "half"},
        third{1.0 / 3, true, "third"};
    EXPECT_EQ(line({}), "");
    EXPECT_EQ(line({one}), "one");
    EXPECT_EQ(line({one, other}), "one");
    const std::string end = ", automatic; --exposure or --match-exposure FILE sets one for all pictures";
    EXPECT_EQ(line({half, one, third}), "exposures from 0.3333 to 1" + end);
    EXPECT_EQ(line({third, half}), "exposures from 0.3333 to 0.5" + end);
    // Of the baseline's lit, over the compared pixels.
    Report report = ofOnePixel(Channel::lit);
    report.comparisons[0].coverage.covered[1] = 0;
    report.comparisons[0].coverage.count = 1;
    report.frames[0].channels[Channel::lit].at(1, 0) = 100;
    const double expected = 0.18;  // of luminance 1
    EXPECT_NEAR(exposureOf(report, report.comparisons[0], {}).factor, expected, 1e-6);
    EXPECT_EQ(exposureLine(report, {}), exposureOf(report, report.comparisons[0], {}).because);
    ImageChoice choice;
    choice.exposure = 3;
    EXPECT_EQ(exposureOf(report, report.comparisons[0], choice).factor, 3);
}

// The first colours of any EXR; of ours, lit of the covered pixels.
TEST(ExposureLine, AFileGivesItsExposure) {
    const std::filesystem::path here = folder();
    const auto fault = [&](const char* name) { return faultOf([&] { exposureOfFile(here / name); }); };
    const std::string start = "--match-exposure " + here.string();
    Image8 pixel{1, 1, 3, {1, 2, 3}};
    writePng(here / "a.png", pixel);
    EXPECT_EQ(fault("a.png"),
              start + "/a.png: PNG holds display colours; give the EXR that it was made from");
    const Image grey(2, 1, 1, 0.5f), colors(2, 1, 3, 0.5f), darker(2, 1, 3, 0.25f);
    writeExr(here / "grey.exr", {{{"depth.Z"}, &grey}});
    EXPECT_EQ(fault("grey.exr"), start + "/grey.exr: holds no colours");
    writeExr(here / "b.exr",
             {{{"depth.Z"}, &grey}, {{"b.R", "b.G", "b.B"}, &colors}, {{"c.R", "c.G", "c.B"}, &darker}});
    EXPECT_NEAR(exposureOfFile(here / "b.exr"), 0.36, 1e-6) << "0.18 of luminance 0.5";
}

}  // namespace
}  // namespace diptych
