// SPDX-License-Identifier: MIT
// The page's address restores the view, and a keyboard reaches everything in few steps.
#include "tests/support/campaign.h"
#include "tests/tool/page_builder.h"

#include <fmt/format.h>

namespace diptych {
namespace {

using nlohmann::json;

// Visible state of a card: comparison mode, visible part of the images, and the pixel whose values are
// shown.
constexpr const char* cardLook = R"(
  const card = $('#c0-roughness'), pair = card.querySelector('.pair'), panel = card.querySelector('.panel');
  const seen = () => { const f = panel.getBoundingClientRect(),
    i = panel.querySelector('img').getBoundingClientRect();
    return [card.open, pair.dataset.mode, pair.style.getPropertyValue('--w'),
      card.querySelector('.readout').textContent.slice(0, 6),
            ...[(f.left - i.left) / i.width, (f.top - i.top) / i.height, f.width / i.width]
              .map(v => +v.toFixed(2))]; };
  await until(() => document.readyState === 'complete'); await wait(300);
)";

// Both paths of `count` scenes: scenes/0.glb and on.
std::vector<Frame> framesOfScenes(int count) {
    std::vector<Frame> frames;
    for (int i = 0; i < count; ++i)
        for (Frame& frame : bothFrames(fmt::format("scenes/{}.glb", i))) frames.push_back(std::move(frame));
    return frames;
}

TEST(PageAddress, LeadsBackToWhatWasSeen) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const fs::path page = written(folder, reportOf(rampFrames()));
    const std::vector<const char*> all{
        "key('s');",
        "await wait(600); key('s');",  // alone, while no other change is pending
        "pair.querySelector('input').value = 30; pair.querySelector('input').dispatchEvent(new "
        "Event('input', { bubbles: true }));",
        "key('+'); key('+'); key('+');",
        "key('+'); key('+'); key('+'); for (let i = 0; i < 9; ++i) key('ArrowRight'); key('2');",
        "card.querySelectorAll('[data-pixel]')[1].click();",
        "card.querySelectorAll('[data-pixel]')[0].click(); key('-'); key('1');",
    };
    const Rows rows(3);
    for (std::size_t row = 0; row < all.size();
         row = static_cast<std::size_t>(rows.after(static_cast<int>(row)))) {
        const char* const actions = all[row];
        const Visit first = visit(folder, page, std::string(cardLook) + R"(
          pointer('pointerdown', panel, .3, .6, { button: 0, pointerType: 'touch' });
          pointer('pointerup', panel, .3, .6, { pointerType: 'touch' });
          )" + actions + R"(
          await wait(600); tell({ hash: location.hash, seen: seen() });)");
        EXPECT_EQ(first.console, "");
        ASSERT_TRUE(first.told.is_object()) << actions << first.told;
        const std::string hash = first.told["hash"];
        ASSERT_TRUE(hash.starts_with("#c0-roughness@")) << actions << hash;
        const Visit again =
            visit(folder, page, std::string(cardLook) + "await wait(300); tell(seen());", hash);
        EXPECT_EQ(again.console, "");
        EXPECT_EQ(again.told, first.told["seen"]) << actions << hash;
    }
}

// Hovering over an image does not change the address: a link contains the clicked pixel.
TEST(PageAddress, PointingAloneDoesNotChangeIt) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const fs::path page = written(folder, reportOf(rampFrames()));
    const Visit seen = visit(folder, page, std::string(cardLook) + R"(
      pointer('pointermove', panel, .5, .5); await wait(400); const pointed = location.hash;
      $('#c0-normals > summary').click(); await wait(400); const opened = location.hash;
      tell([pointed, opened]);)");
    EXPECT_EQ(seen.told, (json{"", "#c0-normals"}));
}

// A table page's filter and order precede the "#": opening the address restores them.
TEST(PageAddress, AnIndexKeepsItsFilterAndOrder) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const fs::path page = written(folder, reportOf(framesOfScenes(12)));
    const std::string seeing = R"(
      await until(() => document.readyState === 'complete');
      const seen = () => $$('.index tbody tr').filter(line => line.offsetHeight > 0)
        .map(line => line.cells[1].textContent);
      const sorted = () => $$('.index th[aria-sort]')
        .map(head => head.textContent + ' ' + head.getAttribute('aria-sort'));
    )";
    const Visit chosen = visit(folder, page, seeing + R"(
      const told = { all: seen().length };
      const filter = $('.index [type=search]'),
        head = $$('.index th').find(th => th.textContent === 'scene').firstChild;
      filter.value = '1'; filter.dispatchEvent(new Event('input', { bubbles: true }));
      head.click(); told.up = seen(); head.click(); told.down = seen();
      await wait(400); told.search = location.search; told.hash = location.hash;
      filter.value = ''; filter.dispatchEvent(new Event('input', { bubbles: true }));
      await wait(400); told.without = location.search;
      tell(told);)",
                               "#c0-lit");
    EXPECT_EQ(chosen.console, "");
    ASSERT_TRUE(chosen.told.is_object()) << chosen.told;
    EXPECT_EQ(chosen.told["all"], 12);
    EXPECT_EQ(chosen.told["up"], (json{"1.glb", "10.glb", "11.glb"}));
    EXPECT_EQ(chosen.told["down"], (json{"11.glb", "10.glb", "1.glb"}));
    EXPECT_EQ(chosen.told["search"], "?filter=1&sort=-scene");
    EXPECT_EQ(chosen.told["hash"], "#c0-lit") << "what is enlarged stays";
    EXPECT_EQ(chosen.told["without"], "?sort=-scene");
    const Visit again = visit(
        folder, page, seeing + "tell({ seen: seen(), sorted: sorted(), filter: $('[type=search]').value });",
        "?filter=1&sort=-scene#c0-lit");
    ASSERT_TRUE(again.told.is_object()) << again.told;
    EXPECT_EQ(again.told["seen"], chosen.told["down"]);
    EXPECT_EQ(again.told["sorted"], json{"scene descending"});
    EXPECT_EQ(again.told["filter"], "1");
}

TEST(PageKeys, ATableIsOneStopAndArrowsMoveInIt) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visit(folder, written(folder, reportOf(framesOfScenes(12))), R"(
      await until(() => document.readyState === 'complete');
      const table = $('.index table'), stops = () => [...table.querySelectorAll('a, button')]
        .filter(e => e.tabIndex === 0).length;
      const told = { links: table.querySelectorAll('a').length, first: stops() };
      const here = () => document.activeElement.textContent;
      table.querySelector('tbody a').focus(); told.start = here();
      key('ArrowDown'); told.down = here(); key('ArrowDown'); key('ArrowUp'); told.up = here();
      key('ArrowRight'); told.right = here(); key('End');
      told.end = here() === [...table.querySelectorAll('a')].at(-1).textContent;
      told.still = stops();
      told.toolbar = $$('.card .buttons').map(group => [...group.querySelectorAll('button')]
        .filter(b => b.tabIndex === 0).length);
      // The first stop of the page leads past everything before the channels.
      const first = $$('a[href], button, input, summary').find(e => e.tabIndex >= 0);
      told.skip = [first.className, !!$(first.getAttribute('href'))];
      // Before each table of several links there is a link that leads past it, and nothing else is passed.
      const past = [...$$('.skip.here')].find(link => link.nextElementSibling.contains(table)),
        address = location.href;
      told.skips = $$('table').filter(t => t.querySelectorAll('a, button').length > 1).length
        - $$('.skip.here').length;
      told.hidden = getComputedStyle(past).clipPath; past.focus();
      told.seen = getComputedStyle(past).clipPath;
      past.click(); const after = document.activeElement;
      told.past = past.nextElementSibling.nextElementSibling === after;
      told.address = location.href === address;
      tell(told);)");
    EXPECT_EQ(seen.console, "");
    const json& told = seen.told;
    ASSERT_TRUE(told.is_object()) << told;
    EXPECT_EQ(told["links"], 24);
    EXPECT_EQ(told["first"], 1);
    EXPECT_EQ(told["start"], "0.glb");
    EXPECT_EQ(told["down"], "1.glb");
    EXPECT_EQ(told["up"], "1.glb");
    EXPECT_NE(told["right"], "1.glb");
    EXPECT_EQ(told["end"], true);
    EXPECT_EQ(told["still"], 1) << "the one where the focus was last";
    for (const json& group : told["toolbar"]) EXPECT_EQ(group, 1);
    EXPECT_EQ(told["skip"], (json{"skip", true}));
    EXPECT_EQ(told["skips"], 0) << "as many as tables of several links";
    EXPECT_EQ(told["hidden"], "inset(50%)");
    EXPECT_EQ(told["seen"], "none") << "while it has the focus";
    EXPECT_EQ(told["past"], true) << "the focus stands behind the table";
    EXPECT_EQ(told["address"], true) << "and the address is still that of what is seen";
}

TEST(PageKeys, APlotIsOneStop) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    ASSERT_EQ(runTool(folder, "tradeoff builtin:triangle --size 32x24 --runs 2 -q -o t").code, 0);
    const Visit seen = visit(folder, folder / "t/index.html", R"(
      const plot = $('svg.chart'), points = [...plot.querySelectorAll('.point[tabindex]')];
      const stops = () => points.filter(point => point.tabIndex === 0).length,
        x = () => document.activeElement.getBoundingClientRect().left;
      const told = { points: points.length, first: stops() }, times = [];
      points[0].focus(); key('Home');
      const order = points.map(point => { const box = point.getBoundingClientRect();
        return box.left + box.width / 2; });
      points[order.indexOf(Math.min(...order))].focus();
      for (let i = 0; i < points.length - 1; ++i) { const before = document.activeElement; key('ArrowRight');
        times.push(document.activeElement !== before); }
      told.reached = times.every(Boolean); told.last = stops();
      told.card = $$('.row-card').filter(card => card.offsetHeight > 0)
        .map(card => card.dataset.row)[0] === document.activeElement.dataset.row;
      tell(told);)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told;
    EXPECT_GT(seen.told["points"], 10);
    EXPECT_EQ(seen.told["first"], 1);
    EXPECT_EQ(seen.told["reached"], true) << "every point, by its time";
    EXPECT_EQ(seen.told["last"], 1);
    EXPECT_EQ(seen.told["card"], true) << "and its row is shown";
}

}  // namespace
}  // namespace diptych
