// SPDX-License-Identifier: MIT
// No page scrolls sideways, and on a phone neither does anything in it. The printed page needs no mouse.
#include "tests/support/campaign.h"
#include "tests/tool/page_builder.h"

#include <fmt/format.h>

namespace diptych {
namespace {

using nlohmann::json;

// Measures a page of the given width with everything open: its excess over the window's width, boxes that
// scroll sideways, and elements and words beyond the right edge.
constexpr const char* measure = R"(
addEventListener('load', () => setTimeout(() => {
  const all = s => [...document.querySelectorAll(s)], seen = e => e.getClientRects().length > 0;
  all('details').forEach(d => d.open = true);
  const name = e => e.tagName + '.' + (e.className.baseVal ?? e.className), wide = innerWidth + 1;
  const scrolls = all('body *').filter(e => seen(e) && e.scrollWidth > e.clientWidth + 1
    && /auto|scroll/.test(getComputedStyle(e).overflowX));
  const over = all('body *').filter(e => seen(e) && !e.closest('.scroll, .panel, svg, .skip')
    && e.getBoundingClientRect().right > wide);
  const cut = all('.buttons, .readout, .again, dl, .box, summary')
    .filter(e => seen(e) && e.scrollWidth > e.clientWidth + 1);
  const hidden = all('.overview .verdict').filter(e => seen(e)
    && e.getBoundingClientRect().right > e.closest('.box').getBoundingClientRect().right + 1);
  parent.postMessage({ which: WHICH, verdicts: hidden.length,
    body: document.scrollingElement.scrollWidth - innerWidth,
                       scrolls: scrolls.map(name), over: [...over, ...cut].map(name).slice(0, 5) }, '*');
}, 300));)";

// A phone, a sheet of paper, and a desktop; a campaign has more.
const std::vector<int> pageWidths =
    isCampaign() ? std::vector{390, 768, 900, 1400, 2560} : std::vector{390, 768, 1400};

// Opens the page in frames of several widths, for screen and print, and returns each one's result.
json measured(const Folder& scratch, const fs::path& page, const std::string& planted = "") {
    const std::string text = contentsOf(page);
    const fs::path home = page.parent_path();
    std::string frames;
    for (const bool print : {false, true})
        for (const int width : pageWidths) {
            if (print && width != 768 && !isCampaign()) continue;
            std::string copy = text;
            const std::string which = fmt::format("{}{}", print ? "print" : "screen", width);
            for (std::size_t i = copy.find("@media print"); print && i != std::string::npos;
                 i = copy.find("@media print", i))
                copy.replace(i, 12, "@media all");
            std::string script = measure;
            script.replace(script.find("WHICH"), 5, "'" + which + "'");
            copy.insert(copy.rfind("</body>"), planted);
            addScript(copy, script);
            std::ofstream(home / (which + ".html"), std::ios::binary) << copy;
            frames += fmt::format("<iframe width={} height=900 src='{}.html'></iframe>", width, which);
        }
    std::ofstream(home / "host.html")
        << "<!doctype html><body><script>const told = {}; onmessage = event => { "
           "told[event.data.which] = event.data; };</script>"
        << frames << "</body>";
    const Visit seen = visit(scratch, home / "host.html",
                             "await until(() => Object.keys(told).length === "
                             "document.querySelectorAll('iframe').length); tell(told);");
    EXPECT_EQ(seen.console, "") << page;
    return seen.told;
}

void expectFits(const json& told, const std::string& page) {
    ASSERT_EQ(told.size(), isCampaign() ? 2 * pageWidths.size() : pageWidths.size() + 1) << page << told;
    for (const auto& [which, of] : told.items()) {
        EXPECT_LE(of["body"], 0) << page << " " << which << of;
        EXPECT_EQ(of["verdicts"], 0) << page << " " << which << ": verdicts out of sight";
        if (which.ends_with("390")) {
            EXPECT_EQ(of["scrolls"], json::array()) << page << " " << which;
            EXPECT_EQ(of["over"], json::array()) << page << " " << which;
        }
    }
}

std::vector<Frame> longNames(int count) {
    std::vector<Frame> frames;
    for (int i = 0; i < count; ++i)
        for (Frame frame : rampFrames()) {
            frame.scene =
                fmt::format("/a/very/long/path/of/folders/scene_number_{}/{}.glb", i, std::string(80, 'm'));
            frame.camera.name = std::string(60, 'c');
            frames.push_back(std::move(frame));
        }
    return frames;
}

TEST(PageWidth, NoReportScrollsSideways) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    writeReport(reportOf(rampFrames()), folder / "one", {});
    expectFits(measured(folder, folder / "one/index.html"), "a comparison");
    writeReport(reportOf(longNames(5)), folder / "index", {});
    expectFits(measured(folder, folder / "index/index.html"), "an index");
    ASSERT_EQ(runTool(folder, "diff one/deferred.exr one/forward_plus.exr -q -o diff").code, 1);
    expectFits(measured(folder, folder / "diff/index.html"), "a difference of two files");
    ASSERT_EQ(
        runTool(folder, "compare builtin:points --size 64x36 --baseline reference -q -o reference").code, 0);
    expectFits(measured(folder, folder / "reference/index.html"), "errors against the reference");
}

TEST(PageWidth, NeitherDoPagesOfTimes) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    ASSERT_EQ(runTool(folder, "tradeoff builtin:triangle --size 32x24 --runs 2 -q -o t").code, 0);
    expectFits(measured(folder, folder / "t/index.html"), "a sweep");
    ASSERT_EQ(runTool(folder, "bench builtin:triangle --size 32x24 --runs 2 -q -o b").code, 0);
    expectFits(measured(folder, folder / "b/index.html"), "a benchmark");
}

// Negative control: excess width is detected in every form.
TEST(PageWidth, WhatIsTooWideIsFound) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const fs::path page = written(folder, reportOf(rampFrames()));
    const json wide = measured(folder, page, "<p class='planted' style='width:800px'>wide</p>");
    EXPECT_GT(wide["screen390"]["body"], 0);
    EXPECT_GT(wide["print768"]["body"], 0);
    EXPECT_LE(wide["screen1400"]["body"], 0);
    EXPECT_EQ(wide["screen390"]["over"][0], "P.planted");
    const json scrolls =
        measured(folder, page,
                 "<div class='scroll'><p style='width:800px'>wide</p></div><div class='box'>&nbsp;</div>");
    EXPECT_LE(scrolls["screen390"]["body"], 0);
    EXPECT_EQ(scrolls["screen390"]["scrolls"], json{"DIV.scroll"});
}

TEST(PagePrint, LeavesOutWhatNeedsAMouse) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const fs::path page = written(folder, reportOf(rampFrames()));
    for (const bool print : {false, true}) {
        std::string text = contentsOf(page);
        for (std::size_t i = text.find("@media print"); print && i != std::string::npos;
             i = text.find("@media print", i))
            text.replace(i, 12, "@media all");
        std::ofstream(page.parent_path() / "copy.html", std::ios::binary) << text;
        const Visit seen = visit(folder, page.parent_path() / "copy.html", R"(
          await until(() => document.readyState === 'complete');
          for (const wipe of $$('[data-show=wipe]')) wipe.click();
          dispatchEvent(new Event('beforeprint'));
          const shown = s => $$(s).filter(e => e.getClientRects().length > 0).length;
          const box = s => $('#c0-roughness ' + s).getBoundingClientRect();
          const cut = getComputedStyle($('#c0-roughness .left')).clipPath;
          tell({ buttons: shown('button'), readouts: shown('.readout'), sliders: shown('.pair input'),
            keys: shown('.keys'),
                 dividers: shown('.divider'), pictures: shown('.card[open] .panel img'),
                   whole: cut === 'none',
                 beside: box('.right').left >= box('.left').right, commands: shown('.again code'),
                 facts: shown('.more dl'),
                 closed: shown('.card[open] details:not([open])') });)");
        EXPECT_EQ(seen.console, "");
        const json& told = seen.told;
        ASSERT_TRUE(told.is_object()) << told;
        for (const char* what : {"buttons", "readouts", "sliders", "keys", "dividers", "closed"})
            EXPECT_EQ(told[what] > 0, !print) << what;
        EXPECT_EQ(told["whole"], print);
        EXPECT_EQ(told["beside"], print) << "both pictures, not one over the other";
        EXPECT_GT(told["pictures"], 2);
        EXPECT_EQ(told["commands"], 2) << "a person can type them";
        EXPECT_GT(told["facts"], 1) << "no click opens numbers on paper";
    }
}

}  // namespace
}  // namespace diptych
