// SPDX-License-Identifier: MIT
// Whole reports as they are sent and opened: in a single file, as the tool writes them, and made again.
#include "shared/frame/debug_modes.h"
#include "tests/tool/page_builder.h"

namespace diptych {
namespace {

TEST(PageReport, ASingleFileLoadsNoOther) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    ReportOptions options;
    options.single_file = true;
    const fs::path page = written(folder, reportOf(rampFrames()), options);
    const fs::path alone = folder / "mail/attached.html";
    fs::create_directories(alone.parent_path());
    fs::copy_file(page, alone);
    const Visit seen = visit(folder, alone, R"(
      $$('details').forEach(d => d.open = true);
      const images = $$('img, image'); images.forEach(i => i.loading = 'eager');
      await until(() => $$('img').every(i => i.complete));
      pointer('pointermove', $('#c0-roughness .panel'), .5, .5); await wait(100);
      const panel = $('#c0-roughness .panel img');
      tell({ sources: images.filter(i => !(i.getAttribute('src')
        || i.getAttribute('href')).startsWith('data:')).length,
             broken: $$('img').filter(i => !i.naturalWidth).length,
               half: [panel.naturalWidth, panel.naturalHeight],
             scripts: $$('script[src], link').length, says: $('#c0-roughness .readout').textContent,
             fetched: performance.getEntriesByType('resource').map(e => e.name)
               .filter(n => !n.startsWith('data:')) });)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told;
    EXPECT_EQ(seen.told["sources"], 0);
    EXPECT_EQ(seen.told["broken"], 0);
    EXPECT_EQ(seen.told["half"], (nlohmann::json{48, 27}));
    EXPECT_EQ(seen.told["scripts"], 0);
    EXPECT_EQ(seen.told["fetched"], nlohmann::json::array());
    EXPECT_EQ(seen.told["says"], "a single-file report has no values under the cursor");
}

// As the tool writes it: everything opens, and every image is there.
TEST(PageReport, ARealReportIsWholeAndSilent) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Ran ran = runTool(folder, "compare builtin:gallery builtin:cutout --size 96x54 --runs 1 -o report");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Visit seen = visit(folder, folder / "report/index.html", R"(
      $$('details').forEach(d => d.open = true);
      $$('.comparison').forEach(s => s.style.contentVisibility = 'visible');
      const images = $$('img'); images.forEach(image => image.loading = 'eager');
      await until(() => images.every(image => image.complete));
      const cards = $$('.card'), bars = $$('.bar').map(bar => bar.getBoundingClientRect().width);
      for (const card of cards) { card.scrollIntoView();
        pointer('pointermove', card.querySelector('.panel'), .5, .5);
        await until(() => card.querySelector('.readout').children.length > 1); }
      tell({ images: images.length, broken: images.filter(image => !image.naturalWidth)
        .map(image => image.src), cards: cards.length,
             unread: cards.filter(card => card.querySelector('.readout').children.length < 2)
               .map(card => card.id),
             timed: bars.filter(width => width > 20).length, plots: $$('.histogram rect').length > 50,
             marks: $$('.checks tr').length > 5 });)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told;
    EXPECT_GT(seen.told["images"], 60);
    EXPECT_EQ(seen.told["broken"], nlohmann::json::array());
    EXPECT_EQ(seen.told["cards"], 2 * std::ranges::count_if(debugModes(), [](const DebugMode& mode) {
                                      return mode.supported_by != SupportedBy::deferred_only &&
                                             layerOf(mode.channel) == 0;
                                  }));
    EXPECT_EQ(seen.told["unread"], nlohmann::json::array());
    EXPECT_GE(seen.told["timed"], 4) << "a bar for each path of each scene at least";
    EXPECT_EQ(seen.told["plots"], true);
    EXPECT_EQ(seen.told["marks"], true);
}

// A window of 1400 x 900 pixels, before any scrolling, opening or hovering.
TEST(PageReport, TheFirstScreenShowsImages) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    for (const bool fails : {false, true}) {
        std::vector<Frame> frames = rampFrames();
        if (!fails) frames[1].channels.at(Channel::roughness) = frames[0].channels.at(Channel::roughness);
        // A difference within tolerance, so that lit has a difference image.
        frames[1].channels.at(Channel::lit).at(3, 4) += 1e-5f;
        const Report report = reportOf(std::move(frames));
        ASSERT_EQ(report.passed(), !fails);
        writeReport(report, folder / (fails ? "fail" : "pass"), {});
        const Visit seen = visit(folder, folder / (fails ? "fail/index.html" : "pass/index.html"), R"(
          await until(() => document.readyState === 'complete');
          const whole = (s, part = 1) => $$(s).filter(e => { const box = e.getBoundingClientRect();
            return box.height > 8 && box.top >= 0 && box.top + part * box.height <= 900; }).length;
          tell({ verdict: whole('h1 .verdict'), lit: whole('#c0-lit .panel img'),
                 lit_seen: whole('#c0-lit .panel img', .5),
                 failing: whole('#c0-roughness .panel img'), finding: whole('#c0-roughness .finding'),
                 says: ($('#c0-roughness .finding') || {}).textContent, sideways: scrollX,
                 wipe: whole('.card [data-show=wipe]'), table: $('.overview').getBoundingClientRect().top
                   > $('#c0-lit .panel img').getBoundingClientRect().bottom });)",
                                 "", 1400);
        ASSERT_TRUE(seen.told.is_object()) << seen.told;
        EXPECT_EQ(seen.told["verdict"], 1);
        EXPECT_EQ(seen.told["table"], true);
        EXPECT_GE(seen.told["wipe"], 1);
        EXPECT_EQ(seen.told["lit_seen"], 3) << "both pictures and their difference";
        if (!fails) {
            EXPECT_EQ(seen.told["lit"], 3);
            continue;
        }
        EXPECT_EQ(seen.told["failing"], 3);
        EXPECT_EQ(seen.told["finding"], 1);
        const std::string says = seen.told["says"];
        for (const char* part : {"max 0.25 exceeds", "worst at 40,20", "half a step of 12 bits"})
            EXPECT_NE(says.find(part), std::string::npos) << says;
    }
}

// A failing channel's card prints a command that repeats the comparison for that channel alone.
TEST(PageReport, TheCommandOfAReportMakesItAgain) {
    const Folder folder;
    const Ran first = runTool(folder,
                              "compare builtin:cutout --size 96x54 --runs 0 --gbuffer compact --baseline "
                              "forward_plus --json -o report");
    ASSERT_EQ(first.code, 0) << first.err;
    const std::string junit = contentsOf(folder / "report/junit.xml"),
                      start = "name=\"command\" value=\"diptych ";
    const std::size_t at = junit.find(start) + start.size();
    const std::string command = junit.substr(at, junit.find('"', at) - at);
    EXPECT_EQ(
        command,
        "compare -o report-again --baseline forward_plus --gbuffer compact --size 96x54 builtin:cutout");
    const std::string kept = contentsOf(folder / "report/report.json");
    for (const std::string channel : {"lit", "normals"}) {
        const Ran again = runTool(folder, command + " --channels " + channel + " --json --runs 0");
        ASSERT_EQ(again.code, 0) << again.err;
        const auto of = [&](const Ran& ran) {
            const nlohmann::json report = nlohmann::json::parse(ran.out);
            for (const auto& one : report["comparisons"][0]["channels"])
                if (one["name"] == channel) return one;
            return nlohmann::json();
        };
        EXPECT_EQ(of(again), of(first)) << channel;
        EXPECT_TRUE(of(first).is_object());
    }
    EXPECT_EQ(contentsOf(folder / "report/report.json"), kept)
        << "the report that it stands in is not replaced";
    EXPECT_TRUE(fs::exists(folder / "report-again/index.html"));
}

// The command on a failing channel's card fails again by the same amount, by the same rules.
TEST(PageReport, TheCommandOfAFailingCardFailsAgain) {
    const Folder folder;
    folder.write("t.json", R"({"rules": [{"channel": "normals", "max": 0, "because": "to fail"}]})");
    const Ran first =
        runTool(folder, "compare builtin:cutout --size 96x54 --runs 0 --tolerances t.json --json -o report");
    ASSERT_EQ(first.code, 1) << first.err;
    const std::string page = contentsOf(folder / "report/index.html"), start = "<code>diptych ";
    // One command renders it again, one shows it in a window.
    ASSERT_EQ(countOf(page, start), 2u);
    EXPECT_EQ(countOf(page, "<code>diptych view --debug normals --tolerances t.json"), 1u);
    const std::size_t at = page.find(start) + start.size();
    const std::string copied = page.substr(at, page.find("</code>", at) - at);
    const Ran again = runTool(folder, copied + " --json --runs 0");
    EXPECT_EQ(again.code, 1) << copied << again.err;
    const auto normalsOf = [](const Ran& ran) {
        const nlohmann::json report = nlohmann::json::parse(ran.out);
        for (const auto& one : report["comparisons"][0]["channels"])
            if (one["name"] == "normals") return one;
        return nlohmann::json();
    };
    EXPECT_EQ(normalsOf(again), normalsOf(first)) << copied;
    EXPECT_EQ(normalsOf(first)["verdict"], "fail");
}

}  // namespace
}  // namespace diptych
