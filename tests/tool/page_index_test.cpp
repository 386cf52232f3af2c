// SPDX-License-Identifier: MIT
// A report of many comparisons in a browser: what it builds and loads at once, and what on demand.
#include "tests/tool/page_builder.h"

#include <fmt/format.h>

namespace diptych {
namespace {

// Channels lit and normals of each comparison, 4 x 3 pixels; normals differ in all whose index ends in 7.
Report several(std::size_t count) {
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<Frame> pair = bothFrames(fmt::format("scenes/{}.glb", i));
        for (Frame& frame : pair) {
            frame.requested = {Channel::lit, Channel::normals};
            std::erase_if(frame.channels, [&](const auto& channel) {
                return !frame.isRequested(channel.first) && channel.first != Channel::material_id;
            });
        }
        if (i % 10 == 7) pair[1].channels.at(Channel::normals).at(1, 2, 0) = -0.5f;
        std::ranges::move(pair, std::back_inserter(frames));
    }
    return reportOf(std::move(frames));
}

const char* const look = R"(
  await until(() => document.readyState === 'complete'); await wait(300);
  const lines = $$('.index tbody tr'), visible = () => lines.filter(line => line.offsetHeight > 0).length;
  const sections = () => $$('.comparison').map(section => section.id);
  const loaded = () => $$('img').filter(image => image.complete && image.naturalWidth).length;
  const told = { lines: lines.length, first: lines.slice(0, 2).map(line => line.cells[1].textContent),
    sections: sections(),
                 nodes: $$('*').length, images: $$('img').length, loaded: loaded(),
                   scripts: $$('script[src]').length,
                 laidOut: $$('.comparison').filter(s =>
                   s.querySelector('.card').checkVisibility({ contentVisibilityAuto: true })).length };
  const filter = $('.index [type=search]');
  filter.value = 'FAIL 97.glb'; filter.dispatchEvent(new Event('input', { bubbles: true }));
  told.filtered = visible(); told.shown = $('.index .shown').textContent;
  filter.value = ''; filter.dispatchEvent(new Event('input', { bubbles: true })); told.all = visible();
  // A line leads to its comparison, which was nowhere before; a link into it, too.
  location.hash = '#s90'; told.arrived = await until(() => $('#s90')) && $('#s90 h2').textContent;
  location.hash = '#c91-lit'; await until(() => $('#c91-lit'));
  told.open = $('#c91-lit').open;
  location.hash = '#s90'; await wait(100); told.again = sections();
  told.seen = Math.abs($('#s90').getBoundingClientRect().top) < 100;
  tell(told);)";

void expectFluent(const nlohmann::json& told, int count) {
    using nlohmann::json;
    ASSERT_TRUE(told.is_object()) << told;
    EXPECT_EQ(told["lines"], count);
    EXPECT_EQ(told["first"], (json{"7.glb", "17.glb"})) << "those that fail";
    EXPECT_EQ(told["sections"], (json{"s7", "s17", "s27", "s37"}));
    // A line has at most 17 elements: itself, 8 cells, two links, a verdict, up to four paddings of
    // numbers, and in a single file the text that loads later. Four comparisons of two channels, each with
    // its Settings, and the page around them have 2770. Each of 40 failures names its scene in an element
    // of its own.
    EXPECT_LT(told["nodes"], count * 17 + 3310) << "elements in the page";
    EXPECT_LT(told["images"], 50);
    EXPECT_LE(told["loaded"], told["images"]);
    EXPECT_LE(told["laidOut"], 2) << "what is far below the window is not laid out";
    EXPECT_EQ(told["filtered"], count / 100) << "97, 197, ...";
    EXPECT_EQ(told["shown"], std::to_string(count / 100) + " of " + std::to_string(count));
    EXPECT_EQ(told["all"], count);
    EXPECT_EQ(told["arrived"], "90.glb \u00b7 default view");
    EXPECT_EQ(told["open"], true);
    EXPECT_EQ(told["again"], (json{"s7", "s17", "s27", "s37", "s90", "s91"})) << "none twice";
    EXPECT_EQ(told["seen"], true);
}

TEST(PageIndex, HundredsOfComparisonsStayFluent) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    writeReport(several(400), folder / "report", {});
    const Visit seen = visit(folder, folder / "report/index.html", look);
    EXPECT_EQ(seen.console, "");
    EXPECT_EQ(seen.told.value("scripts", -1), 0);
    expectFluent(seen.told, 400);
}

TEST(PageIndex, ASingleFileBringsItsComparisonsAlong) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    ReportOptions options;
    options.single_file = true;
    writeReport(several(200), folder / "report", options);
    fs::create_directories(folder / "mail");
    fs::copy_file(folder / "report/index.html", folder / "mail/index.html");
    const Visit seen = visit(folder, folder / "mail/index.html", look);
    EXPECT_EQ(seen.console, "");
    expectFluent(seen.told, 200);
}

}  // namespace
}  // namespace diptych
