// SPDX-License-Identifier: MIT
// Every word of a page is readable on a light and a dark screen: WCAG 2.2's contrast (success criterion
// 1.4.3), 4.5 to 1, and 3 to 1 for large text.
#include "tests/tool/page_builder.h"

namespace diptych {
namespace {

using nlohmann::json;

// Texts with insufficient contrast, each with its ratio, and the number of texts checked. Skips text over
// images, whose background is the image.
constexpr const char* lookAtWords = R"(
  await until(() => document.readyState === 'complete');
  $$('details').forEach(d => d.open = true);
  const paint = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const rgba = color => { paint.clearRect(0, 0, 1, 1); paint.fillStyle = color; paint.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = paint.getImageData(0, 0, 1, 1).data; return [r, g, b, a / 255]; };
  const over = (top, below) => [0, 1, 2].map(i => top[i] * top[3] + below[i] * (1 - top[3])).concat(1);
  const linear = c => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  const luminance = c => 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
  const canvas = rgba(getComputedStyle(document.documentElement).backgroundColor);
  const page = canvas[3] > 0 ? canvas : rgba('Canvas');
  const groundOf = e => { const layers = [];
    for (let at = e; at; at = at.parentElement) {
      const of = rgba(getComputedStyle(at).backgroundColor);
      layers.push(of); if (of[3] === 1) break; }
    return layers.reduceRight((below, top) => over(top, below), page); };
  const words = $$('body *').filter(e => e.getClientRects().length > 0
    && !e.closest('.panel, script, .skip')
    && [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()));
  const pale = [];
  for (const e of words) {
    const style = getComputedStyle(e), inPlot = e.closest('svg');
    let opacity = 1; for (let at = e; at; at = at.parentElement) opacity *= +getComputedStyle(at).opacity;
    const ground = groundOf(e), ink = rgba(inPlot ? style.fill : style.color); ink[3] *= opacity;
    const a = luminance(over(ink, ground)), b = luminance(ground);
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), size = parseFloat(style.fontSize);
    const large = size >= 24 || (size >= 18.66 && +style.fontWeight >= 700);
    if (contrast < (large ? 3 : 4.5))
      pale.push(e.textContent.trim().slice(0, 30) + ': ' + contrast.toFixed(2));
  }
  tell({ words: words.length, dark: luminance(groundOf(document.body)) < 0.2, pale: [...new Set(pale)] });)";

json seenOn(const Folder& scratch, const fs::path& page, bool dark, const std::string& planted = "") {
    std::string text = contentsOf(page);
    const std::string query = "@media (prefers-color-scheme: dark)";
    for (std::size_t i = text.find(query); dark && i != std::string::npos; i = text.find(query, i))
        text.replace(i, query.size(), "@media all");
    text.insert(text.rfind("</body>"), planted);
    const fs::path copy = page.parent_path() / (dark ? "dark.html" : "light.html");
    std::ofstream(copy, std::ios::binary) << text;
    const Visit seen = visit(scratch, copy, lookAtWords);
    EXPECT_EQ(seen.console, "") << page;
    return seen.told;
}

void expectReadable(const Folder& scratch, const fs::path& page, const std::vector<bool>& screens) {
    for (const bool dark : screens) {
        const json told = seenOn(scratch, page, dark);
        ASSERT_TRUE(told.is_object()) << page << told;
        EXPECT_EQ(told["dark"], dark) << page;
        EXPECT_GT(told["words"], 30) << page;
        EXPECT_EQ(told["pale"], json::array()) << page << (dark ? " dark" : " light");
    }
}

TEST(PageDark, EveryWordCanBeRead) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    writeReport(reportOf(rampFrames()), folder / "one", {});
    expectReadable(folder, folder / "one/index.html", {false, true});
    ASSERT_EQ(runTool(folder, "diff one/deferred.exr one/forward_plus.exr -q -o diff").code, 1);
    // Pages share their colours on a light screen.
    expectReadable(folder, folder / "diff/index.html", {true});
    ASSERT_EQ(runTool(folder, "tradeoff builtin:triangle --size 32x24 --runs 1 -q -o t").code, 0);
    expectReadable(folder, folder / "t/index.html", {false, true});
    ASSERT_EQ(runTool(folder, "bench builtin:triangle --size 32x24 --runs 1 --light-counts 1,4 -q -o b").code,
              0);
    expectReadable(folder, folder / "b/index.html", {true});
}

// Negative control.
TEST(PageDark, APaleWordIsFound) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const fs::path page = written(folder, reportOf(rampFrames()));
    const json told = seenOn(folder, page, true, "<p style='color:#333'>planted</p>");
    ASSERT_TRUE(told.is_object()) << told;
    ASSERT_FALSE(told["pale"].empty());
    EXPECT_TRUE(told["pale"].back().get<std::string>().starts_with("planted")) << told;
}

}  // namespace
}  // namespace diptych
