// SPDX-License-Identifier: MIT
// The page of a sweep in a browser.
#include "tests/tool/page_builder.h"

namespace diptych {
namespace {

Visit visitSweep(const Folder& folder, const std::string& script, int width = 1200) {
    const Ran ran = runTool(folder, "tradeoff builtin:triangle --size 32x24 --runs 2 -q -o t");
    EXPECT_EQ(ran.code, 0) << ran.err;
    return visit(folder, folder / "t/index.html", script, "", width);
}

TEST(PageTradeoff, PointingFocusAndTapShowTheRowAndItsCommand) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visitSweep(folder, R"(
  const shown = () => $$('.row-card').filter(card => card.offsetHeight > 0).map(card => card.dataset.row);
  const point = row => $(`[data-figure=flip]:not([hidden]) .point[data-row="${row}"]`);
  const told = { first: shown() };
  point(2).dispatchEvent(new PointerEvent('pointerover', { bubbles: true })); told.hovered = shown();
  $('.plots svg .axis').dispatchEvent(new PointerEvent('pointerover', { bubbles: true }));
  told.left = shown();
  point(3).focus(); told.focused = shown();
  point(4).dispatchEvent(new MouseEvent('click', { bubbles: true })); told.tapped = shown();
  await until(() => $$('.row-card:not([hidden]) img').every(image => image.complete && image.naturalWidth));
  told.pictures = $$('.row-card:not([hidden]) img').map(image => image.naturalWidth);
  told.command = $('.row-card:not([hidden]) code').textContent;
  told.inTable = $('.rows tr.on').dataset.row;
  told.label = point(2).getAttribute('aria-label');
  $('.row-card:not([hidden]) [data-do=copy]').click(); await wait(50);
  told.copied = getSelection().toString();
  $('.rows tbody tr').click(); told.byLine = shown();
  tell(told);)");
    EXPECT_EQ(seen.console, "");
    using nlohmann::json;
    const json& told = seen.told;
    ASSERT_TRUE(told.is_object()) << told;
    ASSERT_EQ(told["first"].size(), 1u) << "one card, from the start";
    EXPECT_EQ(told["hovered"], json{"2"});
    EXPECT_EQ(told["left"], told["first"]) << "what is only pointed at does not stay";
    EXPECT_EQ(told["focused"], json{"3"});
    EXPECT_EQ(told["tapped"], json{"4"});
    EXPECT_EQ(told["pictures"], (json{32, 32, 32}));
    EXPECT_EQ(told["command"].get<std::string>().find("diptych tradeoff "), 0u);
    EXPECT_EQ(told["inTable"], "4");
    EXPECT_NE(told["label"].get<std::string>().find("row 2: deferred"), std::string::npos);
    EXPECT_EQ(told["copied"], told["command"]);
    EXPECT_EQ(told["byLine"], json{"1"});
}

// Reasons take the full width, however the page styles other definition lists.
TEST(PageTradeoff, WhatWasNotDrawnIsReadableOnAPhone) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visitSweep(folder, R"(
  const inner = $('.skips dl').getBoundingClientRect().width;
  tell($$('.skips dt, .skips dd').map(item => item.getBoundingClientRect().width / inner));)",
                                  390);
    ASSERT_TRUE(seen.told.is_array() && !seen.told.empty()) << seen.told;
    for (const double fraction : seen.told) EXPECT_GT(fraction, 0.95);
}

TEST(PageTradeoff, AnotherErrorAndAnotherOrder) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visitSweep(folder, R"(
  const plots = () => $$('svg.chart').filter(svg => svg.getBoundingClientRect().height > 0)
    .map(svg => svg.getAttribute('aria-label').split(' over')[0]);
  const told = { plots: plots(), width: document.documentElement.scrollWidth };
  $('[data-shows=relative_p99]').click(); told.others = plots();
  const column = head => $$('.rows tbody tr')
    .map(row => +row.cells[[...$$('.rows th')].indexOf(head)].dataset.value);
  const head = $$('.rows th').find(th => th.textContent === 'FLIP');
  head.querySelector('button').click(); told.up = column(head);
  head.querySelector('button').click(); told.down = column(head);
  told.sorted = head.getAttribute('aria-sort');
  tell(told);)",
                                  390);
    EXPECT_EQ(seen.console, "");
    using nlohmann::json;
    const json& told = seen.told;
    ASSERT_TRUE(told.is_object()) << told;
    EXPECT_EQ(told["plots"], (json{"FLIP", "FLIP", "FLIP"})) << "together, and each path";
    EXPECT_EQ(told["others"], (json{"relative p99", "relative p99", "relative p99"}));
    EXPECT_LE(told["width"], 500) << "no wider than a phone, or than the narrowest window of the browser";
    std::vector<double> up = told["up"], down = told["down"];
    EXPECT_TRUE(std::ranges::is_sorted(up));
    EXPECT_TRUE(std::ranges::is_sorted(down, std::greater<>()));
    EXPECT_GT(up.size(), 10u);
    EXPECT_LT(up.front(), up.back());
    EXPECT_EQ(told["sorted"], "descending");
}

TEST(PageTradeoff, TheAddressKeepsRowErrorAndOrder) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const std::string state = R"(
      const state = () => ({ row: $('.row-card:not([hidden])').dataset.row,
        line: $('.rows tr.on').dataset.row,
        error: $('[data-shows].on').dataset.shows, plot: $('[data-figure]:not([hidden])').dataset.figure,
        sorted: $$('.rows th[aria-sort]').map(th => th.textContent + ' ' + th.getAttribute('aria-sort')) });
    )";
    ASSERT_EQ(runTool(folder, "tradeoff builtin:triangle --size 32x24 --runs 2 -q -o t").code, 0);
    const fs::path page = folder / "t/index.html";
    const Visit chosen = visit(folder, page, state + R"(
      const told = { plain: location.search, first: state() };
      told.row = told.first.row === '4' ? '5' : '4';
      $(`.rows tr[data-row="${told.row}"]`).click(); $('[data-shows=relative_p99]').click();
      const head = $$('.rows th').find(th => th.textContent === 'relative RMSE').firstChild; head.click();
      head.click();
      await wait(400); told.search = location.search; told.state = state();
      tell(told);)");
    EXPECT_EQ(chosen.console, "");
    ASSERT_TRUE(chosen.told.is_object()) << chosen.told;
    EXPECT_EQ(chosen.told["plain"], "") << "what is shown without a choice needs no words";
    const std::string row = chosen.told["row"];
    EXPECT_EQ(chosen.told["search"], "?row=" + row + "&error=relative_p99&sort=-relative+RMSE");
    const Visit again = visit(folder, page, state + "tell(state());", chosen.told["search"]);
    EXPECT_EQ(again.told, chosen.told["state"]);
    EXPECT_EQ(again.told["row"], row);
    EXPECT_EQ(again.told["plot"], "relative_p99");
    EXPECT_EQ(again.told["sorted"], nlohmann::json{"relative RMSE descending"});
    EXPECT_NE(chosen.told["first"], chosen.told["state"]);
    // Unknown values are no error.
    const Visit other = visit(folder, page, state + "tell(state());", "?row=999&error=x&sort=y");
    EXPECT_EQ(other.console, "");
    EXPECT_EQ(other.told, chosen.told["first"]);
}

}  // namespace
}  // namespace diptych
