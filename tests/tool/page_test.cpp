// SPDX-License-Identifier: MIT
// The report's page in a browser: sends real events and checks the page.
#include "tests/tool/page_builder.h"

#include <cmath>

namespace diptych {
namespace {

TEST(Page, SliderKeysAndButtonsWork) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visit(folder, written(folder, reportOf(rampFrames())), R"(
      const card = $('#c0-roughness'), pair = card.querySelector('.pair'),
        slider = pair.querySelector('input');
      const panel = pair.querySelector('.panel');
      const state = () => [pair.dataset.mode, pair.style.getPropertyValue('--w'),
        card.querySelector('[data-show].on').dataset.show];
      const told = { open: card.open, first: state() };
      slider.value = 30; slider.dispatchEvent(new Event('input', { bubbles: true })); told.slid = state();
      pointer('pointerdown', panel, .25, .5, { button: 0 }); pointer('pointermove', panel, .75, .5);
      pointer('pointerup', panel, .75, .5);
      told.dragged = state(); told.focused = document.activeElement === slider;
      key('ArrowLeft'); told.arrow = state();
      key('1'); told.left = state(); key('2'); told.right = state(); key('s'); told.side = state();
      told.columns = getComputedStyle(pair).gridTemplateColumns.split(' ').length;
      key('w'); told.wipe = state();
      card.querySelector('[data-show=left]').click(); told.button = state();
      // Flicker shows one, then the other, and stops.
      key('f'); const shown = new Set(); told.flicker = state()[0];
      for (let i = 0; i < 30; ++i) { shown.add(pair.style.getPropertyValue('--w')); await wait(40); }
      told.shown = [...shown].sort(); key('Escape'); told.stopped = state();
      await wait(600); told.still = state();
      // Typing into a field is no command, and a held Ctrl is the browser's.
      key('2', { ctrlKey: true }); told.ctrl = state();
      tell(told);)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told << seen.dom.substr(0, 400);
    const auto is = [&](const char* what, const char* mode, const std::string& at, const char* button) {
        EXPECT_EQ(seen.told[what], (nlohmann::json{mode, at, button})) << what;
    };
    EXPECT_EQ(seen.told["open"], true);
    is("first", "side", "100%", "side");
    is("slid", "wipe", "30%", "wipe");
    is("dragged", "wipe", "75%", "wipe");
    EXPECT_EQ(seen.told["focused"], true);
    is("arrow", "wipe", "74%", "wipe");
    is("left", "left", "100%", "left");
    is("right", "right", "0%", "right");
    is("side", "side", "100%", "side");
    EXPECT_EQ(seen.told["columns"], 2);
    is("wipe", "wipe", "74%", "wipe");
    is("button", "left", "100%", "left");
    EXPECT_EQ(seen.told["flicker"], "flicker");
    EXPECT_EQ(seen.told["shown"], (nlohmann::json{"0%", "100%"}));
    is("stopped", "left", "100%", "left");
    is("still", "left", "100%", "left");
    is("ctrl", "left", "100%", "left");
}

// Every panel of a card shows the same part of its image.
TEST(Page, ZoomAndPanMoveAllImagesOfACard) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visit(folder, written(folder, reportOf(rampFrames())), R"(
      const card = $('#c0-roughness'), panels = [...card.querySelectorAll('.panel')],
        pair = card.querySelector('.pair');
      await until(() => panels.every(panel => panel.querySelector('img').complete));
      // The part of the picture that a panel shows: left, top, width in parts of it, measured on the screen.
      const part = panel => { const f = panel.getBoundingClientRect(),
        i = panel.querySelector('img').getBoundingClientRect();
        return [(f.left - i.left) / i.width, (f.top - i.top) / i.height, f.width / i.width]
          .map(v => +v.toFixed(3)); };
      const parts = () => panels.map(part);
      const told = { panels: panels.length, first: parts() };
      // Not clicked into: the wheel is the page's.
      const wheel = (panel, x, y, more) => panel.dispatchEvent(new WheelEvent('wheel',
        { bubbles: true, cancelable: true, deltaY: -240, ...at(panel, x, y), ...more }));
      told.scrolls = wheel(panels[0], .5, .5, {}); told.unzoomed = parts();
      told.taken = !wheel(panels[0], .25, .5, { ctrlKey: true }); told.wheel = parts();
      key('0'); told.fit = parts();
      pointer('pointermove', panels[0], .5, .5); for (let i = 0; i < 4; ++i) key('+'); told.keys = parts();
      told.pixelated = panels.map(panel => getComputedStyle(panel.querySelector('img')).imageRendering);
      // A drag away from the divider pans by what it moved; the arrows do, too.
      pointer('pointerdown', panels[0], .8, .5, { button: 0 }); pointer('pointermove', panels[0], .6, .5);
      pointer('pointerup', panels[0], .6, .5);
      told.panned = parts(); told.wipe = pair.style.getPropertyValue('--w');
      key('ArrowRight'); told.arrow = parts();
      for (let i = 0; i < 99; ++i) key('ArrowRight'); told.end = parts();
      key('0');
      // Two fingers, twice as far apart.
      const finger = (type, id, x) => pointer(type, panels[0], x, .5,
        { pointerId: id, pointerType: 'touch', button: 0 });
      finger('pointerdown', 7, .4); finger('pointerdown', 8, .6); finger('pointermove', 7, .3);
      finger('pointermove', 8, .7);
      finger('pointerup', 7, .3); finger('pointerup', 8, .7); told.pinch = parts();
      tell(told);)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told;
    const auto together = [&](const char* what, double left, double top, double width) {
        for (const auto& part : seen.told[what]) {
            EXPECT_NEAR(part[0].get<double>(), left, 2e-3) << what << part;
            EXPECT_NEAR(part[1].get<double>(), top, 2e-3) << what << part;
            EXPECT_NEAR(part[2].get<double>(), width, 2e-3) << what << part;
        }
    };
    EXPECT_EQ(seen.told["panels"], 3);
    together("first", 0, 0, 1);
    EXPECT_EQ(seen.told["scrolls"], true);
    together("unzoomed", 0, 0, 1);
    EXPECT_EQ(seen.told["taken"], true);
    together("wheel", 0.125, 0.25, 0.5);  // twice as large, and the point under the wheel stays
    together("fit", 0, 0, 1);
    const double zoom = std::pow(1.5, 4), corner = 0.5 - 0.5 / zoom;
    together("keys", corner, corner, 1 / zoom);
    EXPECT_EQ(seen.told["pixelated"], (nlohmann::json{"pixelated", "pixelated", "pixelated"}));
    together("panned", corner + 0.2 / zoom, corner, 1 / zoom);
    EXPECT_EQ(seen.told["wipe"], "100%");
    together("arrow", corner + 0.25 / zoom, corner, 1 / zoom);
    together("end", 1 - 1 / zoom, corner, 1 / zoom);
    together("pinch", 0.25, 0.25, 0.5);
}

TEST(Page, WorstPixelsLeadIntoTheImage) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const std::string script = R"(
      const card = $('#c0-roughness'), panel = card.querySelector('.panel');
      await until(() => card.querySelector('.readout').children.length > 1);
      // The pixel at the middle of the panel, and how many stand side by side in it.
      const where = () => { const f = panel.getBoundingClientRect(),
        i = panel.querySelector('img').getBoundingClientRect();
        return [Math.floor((f.left + f.width / 2 - i.left) / i.width * 96),
          Math.floor((f.top + f.height / 2 - i.top) / i.height * 54), Math.round(f.width / i.width * 96)]; };
      const first = where(), says = () => card.querySelector('.readout').firstChild.textContent;
      const told = { links: [...card.querySelectorAll('[data-pixel]')].map(link => link.dataset.pixel),
        first, says: says() };
      pointer('pointermove', panel, .5, .5);
      card.querySelectorAll('[data-pixel]')[1].click(); told.second = where(); await wait(400);
      told.hash = location.hash;
      key('n'); told.next = where(); key('p'); told.previous = where();
      tell(told);)";
    const Visit seen = visit(folder, written(folder, reportOf(rampFrames())), script, "#c0-roughness@40,20");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told;
    using nlohmann::json;
    EXPECT_EQ(seen.told["links"], (json{"40,20", "80,50"})) << "largest first";
    EXPECT_EQ(seen.told["first"], (json{40, 20, 24})) << "the address leads there";
    EXPECT_EQ(seen.told["says"], "40, 20 exact");
    EXPECT_EQ(seen.told["second"], (json{80, 47, 24})) << "as near as the picture's edge lets it";
    EXPECT_EQ(seen.told["hash"], "#c0-roughness@80,50");
    EXPECT_EQ(seen.told["next"], (json{40, 20, 24})) << "around";
    EXPECT_EQ(seen.told["previous"], (json{80, 47, 24}));
}

// If the system asks for reduced motion, a key alone starts no flicker; a click does.
TEST(Page, FlickerNeedsAClickWhereMotionIsUnwelcome) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visit(folder, written(folder, reportOf(rampFrames())), R"(
      const card = $('#c0-roughness'), pair = card.querySelector('.pair');
      pointer('pointermove', card.querySelector('.panel'), .5, .5);
      key('f'); const byKey = pair.dataset.mode;
      card.querySelector('[data-show=flicker]').click(); const byClick = pair.dataset.mode;
      card.open = false; await wait(50);
      tell([matchMedia('(prefers-reduced-motion: reduce)').matches, byKey, byClick, pair.dataset.mode]);)",
                             "", 1200, "--force-prefers-reduced-motion");
    EXPECT_EQ(seen.console, "");
    EXPECT_EQ(seen.told, (nlohmann::json{true, "side", "flicker", "side"})) << "a closed card stops it, too";
}

}  // namespace
}  // namespace diptych
