// SPDX-License-Identifier: MIT
// Columns of numbers on a page: decimal points are aligned, as measured by a browser.
#include "tests/tool/page_builder.h"

namespace diptych {
namespace {

using nlohmann::json;

// Right edge of each cell's decimal point, or of the number if it has none, from the left of the page.
constexpr const char* decimalPoints = R"(
  await until(() => document.readyState === 'complete');
  const point = cell => {
    const text = cell.firstChild, words = text.textContent, dot = words.match(/^-?\d+/)[0].length,
      range = document.createRange();
    range.setStart(text, 0); range.setEnd(text, dot);
    return range.getBoundingClientRect().right;
  };
  const spread = cells => { const all = cells.map(point); return Math.max(...all) - Math.min(...all); };
)";

TEST(PageTable, DecimalPointsStandOneBelowTheOther) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const fs::path page = written(folder, reportOf(rampFrames()));
    const Visit seen = visit(folder, page, std::string(decimalPoints) + R"(
      const rows = texts => '<table><thead><tr><th class=n>n</th></tr></thead>' + texts
        .map(t => `<tr><td class=n>${t}</td></tr>`).join('') + '</table>';
      const made = texts => {
        const box = document.createElement('div');
        box.innerHTML = rows(texts);
        document.body.append(box);
        const before = spread([...box.querySelectorAll('td')]);
        prepare(box);
        return [before, spread([...box.querySelectorAll('td')])];
      };
      const cells = [...$('.overview').querySelectorAll('tbody tr')].map(row => row.cells[2])
        .filter(cell => /^-?\d/.test(cell.textContent));
      tell({ numbers: made(['1', '12.5', '0.0039', '1.21e-05', '-3']),
        percent: made(['100 %', '99.6 %', '0.52 %']),
             bytes: made(['1.871 MiB', '763.7 KiB', '12 B']), page: spread(cells),
             cells: cells.map(cell => cell.textContent) });)");
    EXPECT_EQ(seen.console, "");
    const json& told = seen.told;
    ASSERT_TRUE(told.is_object()) << told;
    for (const char* what : {"numbers", "percent", "bytes"}) {
        EXPECT_GT(told[what][0], 5) << what << ": what stands on the right alone is ragged";
        EXPECT_LT(told[what][1], 0.6) << what;
    }
    EXPECT_GT(told["cells"].size(), 10u);
    EXPECT_LT(told["page"], 0.6) << told["cells"];
}

}  // namespace
}  // namespace diptych
