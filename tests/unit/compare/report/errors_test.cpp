// SPDX-License-Identifier: MIT
// The distribution of errors over magnitude and image, and its presentation on the page.
#include "compare/page/text.h"
#include "compare/plot/plot.h"
#include "compare/report/error_metrics.h"
#include "compare/report/report.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

namespace diptych {
namespace {

Image errorsOf(int width, int height, const std::vector<std::pair<int, float>>& set) {
    Image errors(width, height, 1);
    for (const auto& [pixel, error] : set) errors.data[static_cast<std::size_t>(pixel)] = error;
    return errors;
}
std::uint64_t sumOf(const ErrorHistogram& histogram) {
    return std::accumulate(histogram.bins.begin(), histogram.bins.end(), std::uint64_t{0});
}

TEST(ErrorHistogram, EveryCoveredPixelIsCountedOnceWhereItBelongs) {
    const Image errors = errorsOf(10, 1, {{0, 0.002f}, {1, 0.0019f}, {2, 0.5f}, {3, HUGE_VALF}, {9, 0.7f}});
    Coverage coverage = everyPixel(10);
    coverage.covered[9] = 0;
    const ErrorHistogram histogram = errorHistogram(errors, coverage);
    EXPECT_EQ(histogram.equal, 5u);
    EXPECT_EQ(histogram.infinite, 1u);
    EXPECT_EQ(sumOf(histogram), 3u) << "the background's 0.7 is none";
    EXPECT_EQ(histogram.first_decade, -3);
    EXPECT_DOUBLE_EQ(histogram.edge(histogram.bins.size()), 1);
    for (std::size_t i = 0; i < histogram.bins.size(); ++i)
        for (const auto& [error, count] : {std::pair{0.002, 2u}, {0.5, 1u}})
            if (histogram.edge(i) <= error && error < histogram.edge(i + 1)) {
                EXPECT_EQ(histogram.bins[i], count) << error;
            }
}

TEST(ErrorHistogram, ItsRangeIsLimitedAndSaysHowManyAreBelow) {
    const ErrorHistogram histogram =
        errorHistogram(errorsOf(3, 1, {{0, 1e-30f}, {1, 1e-11f}, {2, 0.9f}}), everyPixel(3));
    EXPECT_EQ(histogram.first_decade, -12);
    EXPECT_EQ(histogram.smaller, 1u);
    EXPECT_EQ(histogram.bins.front(), 1u);
    EXPECT_EQ(sumOf(histogram), 3u);
}

TEST(ErrorHistogram, OneErrorOrNoneHasABinOrNone) {
    for (const float error : {1e-6f, 1.0f, 10.0f, 180.0f, 3e38f}) {
        const ErrorHistogram histogram = errorHistogram(errorsOf(1, 1, {{0, error}}), everyPixel(1));
        EXPECT_EQ(sumOf(histogram), 1u) << error;
        EXPECT_GE(histogram.edge(histogram.bins.size()), double{error} * (1 - 1e-6));
        EXPECT_EQ(histogram.smaller, 0u);
    }
    const ErrorHistogram none = errorHistogram(errorsOf(4, 1, {{1, HUGE_VALF}}), everyPixel(4));
    EXPECT_TRUE(none.bins.empty());
    EXPECT_EQ(none.equal, 3u);
    EXPECT_EQ(none.infinite, 1u);
}

// Edges are those of decades: as many bins as fit 48, from 4 to 24 of a decade.
TEST(ErrorHistogram, BinsAreFractionsOfDecades) {
    struct Binned {
        float low, high;
        int first, per_decade;
        std::size_t bins, at_low, at_high;
    };
    for (const auto& [low, high, first, per_decade, bins, at_low, at_high] :
         {Binned{1, 1, -1, 24, 24, 23, 23},        // the upper edge is in the last bin
          Binned{0.25f, 0.5f, -1, 24, 24, 9, 16},  // 24 log10(2.5) = 9.6, 24 log10(5) = 16.8
          Binned{0.02f, 0.5f, -2, 24, 48, 7, 40}, Binned{0.002f, 0.5f, -3, 16, 48, 4, 43},
          Binned{2e-12f, 0.5f, -12, 4, 48, 1, 46}, Binned{2e-13f, 0.5f, -12, 4, 48, 0, 46},
          Binned{2, 50, 0, 24, 48, 7, 40}}) {
        const ErrorHistogram histogram = errorHistogram(errorsOf(2, 1, {{0, low}, {1, high}}), everyPixel(2));
        EXPECT_EQ(histogram.first_decade, first) << low;
        EXPECT_EQ(histogram.bins_per_decade, per_decade) << low;
        ASSERT_EQ(histogram.bins.size(), bins) << low;
        std::vector<std::uint64_t> expected(bins);
        ++expected[at_low];
        ++expected[at_high];
        EXPECT_EQ(histogram.bins, expected) << low << " " << high;
        EXPECT_EQ(histogram.smaller, low < 1e-12f ? 1u : 0u) << low;
    }
}

TEST(WorstPixels, AreApartAndLargestFirst) {
    // A spot of 5 x 5 around (10, 10), and smaller ones beside it: just too close and just far enough.
    Image errors(40, 20, 1);
    for (int y = 8; y <= 12; ++y)
        for (int x = 8; x <= 12; ++x) errors.at(x, y) = 1;
    errors.at(10, 10) = 2;
    errors.at(17, 10) = 0.5f;
    errors.at(18, 10) = 0.25f;
    errors.at(39, 19) = 0.75f;
    const std::vector<WorstPixel> worst = worstPixels(errors, 10, 8);
    ASSERT_EQ(worst.size(), 3u);
    const auto is = [&](std::size_t i, int x, int y, double error) {
        EXPECT_EQ(worst[i].x, x);
        EXPECT_EQ(worst[i].y, y);
        EXPECT_EQ(worst[i].error, error);
    };
    is(0, 10, 10, 2);
    is(1, 39, 19, 0.75);
    is(2, 18, 10, 0.25);
    EXPECT_EQ(worstPixels(errors, 1, 8).size(), 1u);
    EXPECT_EQ(worstPixels(errors, 10, 8, 12, 12)[0].x, 12) << "the statistics' own stands first";
    EXPECT_TRUE(worstPixels(Image(3, 3, 1), 10, 8).empty());
}

TEST(WorstPixels, InfinityIsTheWorst) {
    const std::vector<WorstPixel> worst = worstPixels(errorsOf(40, 1, {{3, 1e30f}, {30, HUGE_VALF}}), 10, 8);
    ASSERT_EQ(worst.size(), 2u);
    EXPECT_EQ(worst[0].x, 30);
    EXPECT_TRUE(std::isinf(worst[0].error));
}

std::string cardOf(const std::string& page, const std::string& channel) {
    const std::size_t start = page.find("id=\"c0-" + channel + "\"");
    return page.substr(start, page.find("<details class=\"box card", start) - start);
}

TEST(ReportErrors, ThePageTellsThem) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames)  // no background
        std::ranges::fill(frame.channels.at(Channel::material_id).data, 3.0f);
    frames[1].channels[Channel::roughness].at(1, 2) = 0.75f;
    frames[1].channels[Channel::material_id].at(0, 0) = 4;
    const std::filesystem::path out = folder() / "report";
    writeReport(reportOf(std::move(frames)), out, {});
    const std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    const std::string rough = cardOf(page, "roughness"), id = cardOf(page, "material_id"),
                      lit = cardOf(page, "lit");
    EXPECT_NE(rough.find("11 of 12 pixels are equal"), std::string::npos) << rough;
    EXPECT_NE(rough.find(": 1 pixel</title>"), std::string::npos);
    EXPECT_NE(rough.find("class=\"part past\""), std::string::npos) << "0.25 is beyond the tolerance";
    EXPECT_NE(rough.find("href=\"#c0-roughness@1,2\" data-pixel=\"1,2\""), std::string::npos);
    EXPECT_NE(id.find("data-pixel=\"0,0\""), std::string::npos);
    EXPECT_EQ(id.find("class=\"histogram\""), std::string::npos) << "an exact channel's errors are all 1";
    EXPECT_EQ(lit.find("data-pixel"), std::string::npos) << "nothing differs";
}

// The card of roughness evaluated by a rule; one pixel is off by 0.25. `shown` is the FLIP map.
std::string evaluatedCard(const Criterion& criterion, const Image* shown = nullptr) {
    std::vector<Frame> frames = withOnly({Channel::roughness, Channel::material_id}, bothFrames());
    frames[1].channels[Channel::roughness].at(1, 2) = 0.75f;
    Report report = reportOf(std::move(frames));
    for (ChannelDiff& channel : report.comparisons[0].channels) {
        if (channel.mode->name != "roughness") continue;
        channel.rule = "rules.json, rule 1";
        channel.tolerance.max = HUGE_VAL;
        channel.criterion = criterion;
        if (!shown) continue;
        channel.shown_error = std::make_shared<Image>(*shown);
        channel.shown_error_name = "FLIP";
    }
    const std::filesystem::path out = folder() / "report";
    writeReport(report, out, {});
    return cardOf(contentsOf(out / "index.html"), "roughness");
}

TEST(ReportErrors, ARulesLimitIsShownWhereItIsOnWhatIsDrawn) {
    const std::string largest = evaluatedCard({.metric = "max", .measured = 0.25, .limit = 0.002});
    EXPECT_NE(largest.find(">limit 0.002, beyond the left edge<"), std::string::npos) << largest;
    EXPECT_NE(largest.find("<rect class=\"part past\""), std::string::npos);
    EXPECT_NE(largest.find("</i>beyond the limit"), std::string::npos) << "in the difference's legend";
    const std::string within = evaluatedCard({.metric = "p999", .measured = 0.25, .limit = 50});
    EXPECT_NE(within.find(">limit 50, beyond the right edge<"), std::string::npos) << within;
    EXPECT_EQ(within.find("<rect class=\"part past\""), std::string::npos);
    for (const char* metric : {"mean", "flip", "relative_max", "angle_max"}) {
        const std::string other = evaluatedCard({.metric = metric, .measured = 0.25, .limit = 0.002});
        EXPECT_NE(other.find("class=\"part part7\""), std::string::npos) << "no colour says that it passes";
        EXPECT_NE(other.find(fmt::format("the limit applies to {}, not to these errors", metric)),
                  std::string::npos)
            << other;
        EXPECT_EQ(other.find("class=\"budget\""), std::string::npos);
    }
}

// One ranking: by the error that the image shows, listed beside each pixel.
TEST(ReportErrors, TheWorstPixelsAreOfTheImageThatIsDrawn) {
    Image flip(4, 3, 1, 0.0f);
    flip.at(1, 2) = 0.125f;
    const std::string card = evaluatedCard({.metric = "flip", .measured = 0.25, .limit = 0.002}, &flip);
    EXPECT_NE(card.find("<h4>Worst pixels, by FLIP</h4>"), std::string::npos) << card;
    EXPECT_NE(card.find("data-pixel=\"1,2\">1, 2</a><span>0.125</span>"), std::string::npos) << card;
    EXPECT_NE(card.find(">FLIP</text>"), std::string::npos);
    EXPECT_NE(card.find("<title>0.121 to 0.133: 1 pixel</title>"), std::string::npos)
        << "and not where 0.25 lies: " << card;
    EXPECT_NE(card.find("the limit applies to flip, not to these errors"), std::string::npos)
        << "it is a mean";
    EXPECT_EQ(
        evaluatedCard({.metric = "flip"}, std::make_unique<Image>(4, 3, 1, 0.0f).get()).find("Worst pixels"),
        std::string::npos)
        << "nothing of it is worst";
}

TEST(ReportErrors, OnlyAFailingChannelHasItsCommand) {
    std::vector<Frame> frames = bothFrames("my scene.glb");
    for (Frame& frame : frames) frame.settings.gbuffer = GBufferEncoding::compact;
    frames[1].channels[Channel::roughness].at(1, 2) = 0.75f;
    const std::filesystem::path out = folder() / "report";
    writeReport(reportOf(std::move(frames)), out, {});
    const std::string page = contentsOf(out / "index.html"),
                      command =
                          "diptych compare --channels roughness --gbuffer compact --size 4x3 &#39;my "
                          "scene.glb&#39;";
    EXPECT_NE(cardOf(page, "roughness").find("<code>" + command + "</code>"), std::string::npos)
        << cardOf(page, "roughness");
    EXPECT_EQ(cardOf(page, "albedo").find("<code>"), std::string::npos);
    EXPECT_NE(contentsOf(out / "junit.xml").find("reproduce: " + command + "\n"), std::string::npos);
}

// Two bins of a decade; the limit splits the bin in which it lies.
TEST(ReportErrors, TheHistogramIsThePlotOfItsBins) {
    ChannelDiff c;
    c.mode = &debugMode(Channel::normals);
    ChannelImages images;
    ErrorHistogram& bins = images.histogram;
    bins = {.first_decade = -1,
            .bins_per_decade = 2,
            .bins = {5, 0, 1, 2},
            .equal = 3,
            .infinite = 0,
            .smaller = 4};
    images.worst = {{1, 2, 9.5}, {3, 0, 0.25}};
    const double root = std::pow(10.0, 0.5);
    const auto bar = [](double left, double right, double count, std::size_t part, const std::string& text,
                        bool beyond = false) {
        return PlotBar{{left, right}, {0, count}, part, text, beyond};
    };
    const std::string first = "0.1\u00b0 to 0.316\u00b0: 5 pixels, 4 of them below",
                      third = "1\u00b0 to 3.16\u00b0: 1 pixel", last = "3.16\u00b0 to 10\u00b0: 2 pixels";
    const auto expected = [&](const std::vector<PlotBar>& bars, const std::string& limit, double at,
                              const std::string& text, const std::string& across = "angle, \u00b0") {
        PlotPanel panel{.across = {.name = across, .shown = {0.1, 10}},
                        .up = {.name = "pixels", .shown = {1}}};
        panel.bars = bars;
        if (!limit.empty()) panel.limits = {{.x = at, .name = limit}};
        return "<div class=\"spread\"><figure class=\"histogram\">" +
               svgOf({.title = "histogram of error", .panels = {panel}, .height = 240}, PlotTarget::page) +
               "<figcaption>" + text + "</figcaption></figure>\n";
    };
    const auto list = [](const std::string& by, const std::string& items) {
        return "<div class=\"worst\" title=\"at least 8 pixels apart\"><h4>Worst pixels" + by + "</h4><ol>" +
               items + "</ol></div>\n</div>\n";
    };
    const std::string items =
        "<li><a href=\"#id@1,2\" data-pixel=\"1,2\">1, 2</a><span>9.5\u00b0</span></li>"
        "<li><a href=\"#id@3,0\" data-pixel=\"3,0\">3, 0</a><span>0.25\u00b0</span></li>";
    const auto metrics = [&] { return errorMetrics(c, images, "id"); };
    const double lowest = std::pow(10.0, -0.5);
    const auto free = [&](std::size_t part) {
        return std::vector<PlotBar>{bar(0.1, lowest, 5, part, first), bar(1, root, 1, part, third),
                                    bar(root, 10, 2, part, last)};
    };
    EXPECT_EQ(metrics(), expected(free(7), "", 0, "3 of 11 pixels are equal") + list("", items));
    bins.infinite = 2;
    c.criterion = {.metric = "mean"};
    EXPECT_EQ(metrics(),
              expected(free(7), "", 0,
                       "3 of 13 pixels are equal; 2 have an infinite error; the limit applies to mean, not "
                       "to these errors") +
                  list("", items));
    images.error_limit = 2;
    const std::string text = "3 of 13 pixels are equal; 2 have an infinite error";
    EXPECT_EQ(metrics(), expected({bar(0.1, lowest, 5, 0, first), bar(1, 2, 1, 0, third),
                                   bar(2, root, 1, 0, third, true), bar(root, 10, 2, 0, last, true)},
                                  "tolerance 2\u00b0", 2, text) +
                             list("", items));
    images.worst[0].error = 2;
    EXPECT_EQ(metrics(),
              expected(free(0), "tolerance 2\u00b0", 2, text) +
                  list("", items.substr(0, items.find("9.5")) + "2" + items.substr(items.find("9.5") + 3)))
        << "nothing is beyond";
    images.worst[0].error = 9.5;
    c.rule = "t.json, rule 1";
    images.error_limit = 11;
    EXPECT_EQ(metrics(),
              expected(free(0), "limit 11\u00b0, beyond the right edge", 11, text) + list("", items));
    images.error_limit = 0.05;
    EXPECT_EQ(metrics(), expected({bar(0.1, lowest, 5, 0, first, true), bar(1, root, 1, 0, third, true),
                                   bar(root, 10, 2, 0, last, true)},
                                  "limit 0.05\u00b0, beyond the left edge", 0.05, text) +
                             list("", items));
    images.error_limit = 0;
    EXPECT_EQ(metrics(), expected({bar(0.1, lowest, 5, 0, first, true), bar(1, root, 1, 0, third, true),
                                   bar(root, 10, 2, 0, last, true)},
                                  "", 0, text) +
                             list("", items));
    // Names of errors; pixels without pictures are no links.
    images.error_limit.reset();
    c.criterion.reset();
    bins.infinite = 0;
    c.shown_error = std::make_shared<Image>(4, 3, 1);
    for (const auto& [name, kind] : {std::pair{"F<LIP", "F<LIP"}, {"relative", "relative error"}}) {
        c.shown_error_name = name;
        EXPECT_EQ(metrics(),
                  expected(free(7), "", 0, "3 of 11 pixels are equal", kind + std::string(", \u00b0")) +
                      list(", by " + page::markup(name), items));
    }
    images.kept = false;
    bins.bins.clear();
    EXPECT_EQ(metrics(), "<div class=\"spread\">" +
                             list(", by relative",
                                  "<li><span>1, 2</span> <span>9.5\u00b0</span></li><li><span>3, 0"
                                  "</span> <span>0.25\u00b0</span></li>"));
    images.worst.clear();
    EXPECT_EQ(metrics(), "");
}

}  // namespace
}  // namespace diptych
