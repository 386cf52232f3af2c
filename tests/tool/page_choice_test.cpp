// SPDX-License-Identifier: MIT
// The page of a choice in a browser.
#include "tests/tool/page_builder.h"

namespace diptych {
namespace {

// Labels of a plot that overlap or extend outside it, and how far the page scrolls sideways.
constexpr const char* lookAtChoice = R"(
  const words = $$('svg.chart text').filter(text => text.textContent).map(text =>
    [text.textContent, text.getBoundingClientRect(), text.closest('svg').getBoundingClientRect()]);
  const told = { overlaps: [], outside: [], wide: document.documentElement.scrollWidth - innerWidth };
  words.forEach(([a, x, svg], i) => {
    if (x.left < svg.left - 1 || x.right > svg.right + 1 || x.top < svg.top - 1 || x.bottom > svg.bottom + 1)
      told.outside.push(a);
    for (const [b, y] of words.slice(i + 1))
      if (x.left < y.right - 1 && y.left < x.right - 1 && x.top < y.bottom - 1 && y.top < x.bottom - 1)
        told.overlaps.push([a, b]);
  });
  told.names = $$('svg.chart .name').map(name => name.textContent);
  const svg = $('svg.chart'), unit = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
  told.letter = Math.max(...$$('.rows-named text').map(text =>
    text.getBoundingClientRect().width / unit / text.textContent.length));
  told.limits = $$('svg.chart .budget').length;
  told.points = $$('svg.chart .point[data-row]').length;
  told.rows = $$('body > .rows tbody tr').length;
  const head = $$('.rows th').find(th => th.textContent === 'FLIP');
  head.querySelector('button').click();
  told.errors = $$('body > .rows tbody tr').map(row => +row.cells[2].dataset.value);
  $('.again [data-do=copy]').click(); await wait(50);
  told.copied = getSelection().toString();
  tell(told);)";

void expectGoodPage(const Visit& seen, bool narrow) {
    EXPECT_EQ(seen.console, "");
    const nlohmann::json& told = seen.told;
    ASSERT_TRUE(told.is_object()) << told;
    EXPECT_EQ(told["overlaps"], nlohmann::json::array()) << narrow;
    EXPECT_EQ(told["outside"], nlohmann::json::array()) << narrow;
    EXPECT_LE(told["wide"].get<int>(), 0) << narrow;
    EXPECT_EQ(told["names"], (nlohmann::json{"time of a frame, ms", "FLIP against the reference"}));
    EXPECT_LE(told["letter"].get<double>(), 11.5) << "the room that the plot gives each; " << narrow;
    EXPECT_EQ(told["limits"], 2) << "and its name in the legend";
    EXPECT_EQ(told["rows"], 8);
    EXPECT_GE(told["points"].get<int>(), 2);
    std::vector<double> errors;
    for (const nlohmann::json& error : told["errors"])
        errors.push_back(error.is_null() ? std::numeric_limits<double>::infinity() : error.get<double>());
    EXPECT_TRUE(std::ranges::is_sorted(errors)) << told["errors"];
    EXPECT_EQ(told["copied"].get<std::string>().find("diptych render "), 0u);
}

TEST(PageChoice, NothingOverlapsAndTheTableIsSorted) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Ran ran = runTool(
        folder,
        "choose builtin:spots --size 64x36 --max-error 0.02 -q -o c --grid '{\"settings\":{\"path\":"
        "[\"deferred\",\"forward_plus\"],\"gbuffer\":[\"compact\",\"full\"],\"size\":[\"1/2\",\"1/1\"]}}'");
    ASSERT_EQ(ran.code, 0) << ran.err;
    for (const int width : {1300, 390})
        expectGoodPage(visit(folder, folder / "c/index.html", lookAtChoice, "", width), width < 500);
}

}  // namespace
}  // namespace diptych
