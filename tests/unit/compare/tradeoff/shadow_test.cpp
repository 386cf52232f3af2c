// SPDX-License-Identifier: MIT
// Errors of the sun's shadow, and the dominated rows of a sweep.
#include "compare/output/writers.h"
#include "compare/tradeoff/captured_errors.h"
#include "compare/tradeoff/tables.h"
#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace diptych::tradeoff {
namespace {

Image pixelRow(const std::vector<float>& values, int components = 1) {
    Image image(static_cast<int>(values.size()) / components, 1, components);
    image.data.assign(values.begin(), values.end());
    return image;
}

// Four surface pixels: two lit by the sun with 1 and 3 W/m^2, and two in shadow with 2 and 4. The second
// and third are 0.01 m from an edge, the others 1 m.
Frame tracedRow() {
    Frame reference;
    reference.settings.path = Path::reference;
    reference.settings.size = {4, 1};
    reference.channels[Channel::material_id] = pixelRow({0, 0, 0, 0});
    reference.channels[Channel::shadow_visibility] = pixelRow({1, 1, 0, 0});
    reference.shadow_edge = pixelRow({1, 9, 1, 0.01f, 9, 3, 0.01f, 9, 2, 1, 9, 4}, 3);
    return reference;
}

// A path's result for it, with texels of 5 mm and a filter radius of 2 cm.
Frame filteredRow(const std::vector<float>& visibility) {
    Frame path;
    path.settings.path = Path::deferred;
    path.settings.size = {4, 1};
    path.channels[Channel::shadow_visibility] = pixelRow(visibility);
    path.channels[Channel::depth] = pixelRow({1, 1, 1, 1});
    path.shadow_filter_radii = {{10, 0.02, 0.005}};
    return path;
}

TEST(TradeoffShadow, ErrorsAreOfLightThatIsWrong) {
    const Frame traced = tracedRow();
    const auto errors = shadowErrorsOf(traced, filteredRow({1, 1, 0, 0}));
    ASSERT_TRUE(errors);
    EXPECT_EQ(*errors, ShadowErrors{}) << "what is right has none";
    // error, false lit, false dark, leak, gap
    EXPECT_EQ(*shadowErrorsOf(traced, filteredRow({1, 0.5f, 0.5f, 0})),
              (ShadowErrors{(1.5 + 1.0) / 4, 0, 0, 1.0 / 4, 0}))
        << "near an edge";
    const ShadowErrors wrong = *shadowErrorsOf(traced, filteredRow({0.25f, 1, 0, 0.75f}));
    EXPECT_EQ(wrong[0], (0.75 + 3.0) / 4);
    EXPECT_EQ(wrong[1], 0.5) << "of the two that are away from edges";
    EXPECT_EQ(wrong[2], 0.5);
    EXPECT_EQ(wrong[3], 3.0 / 4);
    EXPECT_NEAR(wrong[4], 200, 1e-9) << "a metre in texels of 5 mm";
    EXPECT_NEAR((*shadowErrorsOf(traced, filteredRow({1, 1, 1, 0})))[4], 2, 1e-6);
}

TEST(TradeoffShadow, AFrameWithoutMapsShowsTheSunEverywhere) {
    Frame open = filteredRow({1, 1, 1, 1});
    open.shadow_filter_radii.clear();
    const auto errors = shadowErrorsOf(tracedRow(), open);
    ASSERT_TRUE(errors);
    EXPECT_EQ((*errors)[1], 0.5) << "every pixel counts";
    EXPECT_EQ((*errors)[3], 6.0 / 4);
    EXPECT_TRUE(std::isinf((*errors)[4])) << "it has no texels";
    Frame unlit = tracedRow();
    unlit.channels[Channel::shadow_visibility] = pixelRow({0, 0, 0, 0});
    EXPECT_TRUE(std::isinf((*shadowErrorsOf(unlit, open))[3])) << "nothing should be lit";
}

TEST(TradeoffShadow, WhatCannotBeEvaluatedIsNot) {
    Frame other = filteredRow({1, 1});
    EXPECT_FALSE(shadowErrorsOf(tracedRow(), other)) << "of another size";
    other.channels.clear();
    EXPECT_FALSE(shadowErrorsOf(tracedRow(), other)) << "without the channel";
    Frame sunless = tracedRow();
    sunless.shadow_edge = {};
    EXPECT_FALSE(shadowErrorsOf(sunless, filteredRow({1, 1, 0, 0})));
}

// Rows with an error, a time (ms) and a size (bytes) each.
Tradeoff sweptRows(const std::vector<std::array<double, 3>>& rows) {
    Tradeoff sweep;
    for (const auto& [error, ms, bytes] : rows) {
        TradeoffRow& row = sweep.rows.emplace_back();
        row.measured.set(FrameTime{ms, ms, ms, 1});
        row.measured.set(FrameBytes{static_cast<std::uint64_t>(bytes), 0});
        row.measured.set(Measure::shadow_error, ShadowErrors{error, 0, 0, 0, 0});
    }
    return sweep;
}

TEST(TradeoffShadow, RowsAreInTheOrderOfTheirErrorAndMarkedWhereOthersBeatThem) {
    //                                   best but slow, small and fast, beaten in both, in memory alone
    const Tradeoff sweep = sweptRows({{0.1, 50, 400}, {0.3, 10, 100}, {0.4, 20, 200}, {0.2, 5, 500}});
    const std::vector<ShadowRow> rows = shadowRowsOf(sweep);
    ASSERT_EQ(rows.size(), 4u);
    std::vector<std::size_t> order;
    std::vector<bool> time, memory;
    for (const ShadowRow& row : rows) {
        order.push_back(row.row);
        time.push_back(row.dominated_in_time);
        memory.push_back(row.dominated_in_memory);
    }
    EXPECT_EQ(order, (std::vector<std::size_t>{0, 3, 1, 2}));
    EXPECT_EQ(time, (std::vector{false, false, true, true}));
    EXPECT_EQ(memory, (std::vector{false, true, false, true}));
    const std::string text = inText(shadowBlocks(sweep)), page = inHtml(shadowBlocks(sweep));
    EXPECT_NE(text.find("time, memory"), std::string::npos) << text;
    EXPECT_NE(page.find("time, memory"), std::string::npos) << page;
    for (const experiment::NamedMeasure& metric : shadowMetrics)
        EXPECT_NE(page.find(metric.title), std::string::npos) << metric.title;
}

TEST(TradeoffShadow, WithoutADifferenceThereIsNoTable) {
    const Tradeoff alike = sweptRows({{0.1, 50, 400}, {0.1, 10, 100}});
    EXPECT_TRUE(shadowRowsOf(alike).empty());
    EXPECT_TRUE(shadowBlocks(alike).empty());
    EXPECT_TRUE(shadowBlocks(Tradeoff()).empty());
}

}  // namespace
}  // namespace diptych::tradeoff
