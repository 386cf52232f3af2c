// SPDX-License-Identifier: MIT
// The report's page as a browser shows it: real events go in, what stands on the page comes out.
#include "compare/report/report.h"
#include "tests/tool/browser.h"
#include "tests/unit/report_maker.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace diptych {
namespace {

#define SKIP_WITHOUT_BROWSER() \
    if (browser().empty()) GTEST_SKIP() << "no chromium here: the page is not looked at"

// Both paths of one scene, every pixel a surface: lit is a ramp that repeats in no row, roughness fails at
// (40, 20) and less so elsewhere.
std::vector<Frame> rampFrames(int width = 96, int height = 54) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames) {
        frame.settings.size = {width, height};
        for (auto& [number, image] : frame.channels) {
            const DebugMode& mode = debugMode(number);
            image = Image(width, height, mode.width, mode.kind == ChannelKind::id ? 3.0f : 0.5f);
        }
        Image& lit = frame.channels.at(gpu::DEBUG_lit);
        for (std::size_t i = 0; i < lit.data.size(); ++i) lit.data[i] = 0.1f + 1e-3f * static_cast<float>(i);
        frame.through_gbuffer.clear();
    }
    Image& roughness = frames[1].channels.at(gpu::DEBUG_roughness);
    roughness.at(40, 20) = 0.75f;
    roughness.at(80, 50) = 0.625f;
    for (const gpu::uint mode : {gpu::DEBUG_lit, gpu::DEBUG_lit_diffuse, gpu::DEBUG_lit_specular})
        frames[1].through_gbuffer[mode] = frames[0].channels.at(mode);
    return frames;
}

fs::path written(const Folder& folder, const Report& report, const ReportOptions& options = {}) {
    writeReport(report, folder / "report", options);
    return folder / "report/index.html";
}

TEST(Page, SliderKeysAndButtonsWork) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visit(folder, written(folder, reportOf(rampFrames())), R"(
      const card = $('#c0-roughness'), pair = card.querySelector('.pair'), slider = pair.querySelector('input');
      const film = pair.querySelector('.film');
      const state = () => [pair.dataset.mode, pair.style.getPropertyValue('--w'), card.querySelector('[data-show].on').dataset.show];
      const told = { open: card.open, first: state() };
      slider.value = 30; slider.dispatchEvent(new Event('input', { bubbles: true })); told.slid = state();
      pointer('pointerdown', film, .25, .5, { button: 0 }); pointer('pointermove', film, .75, .5); pointer('pointerup', film, .75, .5);
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
    is("first", "wipe", "50%", "wipe");
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
    is("stopped", "wipe", "74%", "wipe");
    is("still", "wipe", "74%", "wipe");
    is("ctrl", "wipe", "74%", "wipe");
}

// Every film of a card shows the same part of its picture.
TEST(Page, ZoomAndPanMoveAllPicturesOfACard) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visit(folder, written(folder, reportOf(rampFrames())), R"(
      const card = $('#c0-roughness'), films = [...card.querySelectorAll('.film')], pair = card.querySelector('.pair');
      await until(() => films.every(film => film.querySelector('img').complete));
      // Which part of the picture a film shows: left, top, width in parts of it, measured on the screen.
      const part = film => { const f = film.getBoundingClientRect(), i = film.querySelector('img').getBoundingClientRect();
        return [(f.left - i.left) / i.width, (f.top - i.top) / i.height, f.width / i.width].map(v => +v.toFixed(3)); };
      const parts = () => films.map(part);
      const told = { films: films.length, first: parts() };
      // Not clicked into: the wheel is the page's.
      const wheel = (film, x, y, more) => film.dispatchEvent(new WheelEvent('wheel', { bubbles: true, cancelable: true, deltaY: -240, ...at(film, x, y), ...more }));
      told.scrolls = wheel(films[0], .5, .5, {}); told.unzoomed = parts();
      told.taken = !wheel(films[0], .25, .5, { ctrlKey: true }); told.wheel = parts();
      key('0'); told.fit = parts();
      pointer('pointermove', films[0], .5, .5); for (let i = 0; i < 4; ++i) key('+'); told.keys = parts();
      told.pixelated = films.map(film => getComputedStyle(film.querySelector('img')).imageRendering);
      // A drag away from the divider pans by what it moved; the arrows do, too.
      pointer('pointerdown', films[2], .8, .5, { button: 0 }); pointer('pointermove', films[2], .6, .5); pointer('pointerup', films[2], .6, .5);
      told.panned = parts(); told.wipe = pair.style.getPropertyValue('--w');
      key('ArrowRight'); told.arrow = parts();
      for (let i = 0; i < 99; ++i) key('ArrowRight'); told.end = parts();
      key('0');
      // Two fingers, twice as far apart.
      const finger = (type, id, x) => pointer(type, films[0], x, .5, { pointerId: id, pointerType: 'touch', button: 0 });
      finger('pointerdown', 7, .4); finger('pointerdown', 8, .6); finger('pointermove', 7, .3); finger('pointermove', 8, .7);
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
    EXPECT_EQ(seen.told["films"], 3);
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
    EXPECT_EQ(seen.told["wipe"], "50%");
    together("arrow", corner + 0.25 / zoom, corner, 1 / zoom);
    together("end", 1 - 1 / zoom, corner, 1 / zoom);
    together("pinch", 0.25, 0.25, 0.5);
}

TEST(Page, TheValuesUnderTheCursorAreThoseOfTheFrames) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    std::vector<Frame> frames = rampFrames();
    frames[1].channels[gpu::DEBUG_albedo].at(3, 2, 1) = std::numeric_limits<float>::infinity();
    const Visit seen = visit(folder, written(folder, reportOf(frames)), R"(
      const read = async (id, x, y, width = 96, height = 54) => {
        const card = $(id); card.open = true;
        const film = card.querySelector('.film'), out = card.querySelector('.readout');
        pointer('pointermove', film, (x + .5) / width, (y + .5) / height);
        await until(() => out.children.length > 1);
        return [...out.children].map(row => row.textContent);
      };
      const scripts = () => $$('script[src]').map(script => script.getAttribute('src'));
      tell({ before: scripts(), lit: await read('#c0-lit', 5, 3), roughness: await read('#c0-roughness', 40, 20),
             albedo: await read('#c0-albedo', 3, 2), id: await read('#c0-material_id', 0, 0),
             only: await read('#c0-texcoords', 95, 53), after: scripts() });)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told;
    using nlohmann::json;
    EXPECT_EQ(seen.told["before"], json::array()) << "nothing is loaded before somebody points";
    const Image& lit = frames[0].channels.at(gpu::DEBUG_lit);
    const std::string triple = fmt::format("{} {} {}", lit.at(5, 3, 0), lit.at(5, 3, 1), lit.at(5, 3, 2));
    EXPECT_EQ(seen.told["lit"],
              (json{"5, 3 exact", "deferred " + triple, "forward_plus " + triple, "difference 0"}));
    EXPECT_EQ(seen.told["roughness"],
              (json{"40, 20 exact", "deferred 0.5", "forward_plus 0.75", "difference 0.25"}));
    EXPECT_EQ(seen.told["albedo"], (json{"3, 2 exact", "deferred 0.5 0.5 0.5",
                                         "forward_plus 0.5 Infinity 0.5", "difference Infinity"}));
    EXPECT_EQ(seen.told["id"], (json{"0, 0 exact", "deferred 3", "forward_plus 3", "difference 0"}));
    EXPECT_EQ(seen.told["only"], (json{"95, 53 exact", "forward_plus 0.5 0.5"}));
    EXPECT_EQ(seen.told["after"].size(), 5u) << "each channel's own file";
}

// Larger pictures are rounded, and the page says so; the difference keeps its digits.
TEST(Page, LargerPicturesAreQuantisedAndSaySo) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    std::vector<Frame> frames = rampFrames(256, 192);
    for (Frame& frame : frames) {
        Image& position = frame.channels.at(gpu::DEBUG_position);
        for (std::size_t i = 0; i < position.data.size(); ++i)
            position.data[i] = 1e6f + 16 * static_cast<float>(i % 977);  // beyond float16's own range
    }
    frames[1].channels.at(gpu::DEBUG_position).at(200, 100, 2) += 0.25f;
    const Visit seen = visit(folder, written(folder, reportOf(frames)), R"(
      const card = $('#c0-position'), out = card.querySelector('.readout');
      location.hash = '#c0-position@200,100';
      await until(() => out.children.length > 1);
      tell([...out.children].map(row => row.textContent));)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_array() && seen.told.size() == 4) << seen.told;
    EXPECT_EQ(seen.told[0], "200, 100 quantised: float16, 11 bits");
    const Image& position = frames[0].channels.at(gpu::DEBUG_position);
    for (const int row : {1, 2}) {
        std::istringstream words(seen.told[row].get<std::string>());
        std::string name;
        words >> name;
        for (int c = 0; c < 3; ++c) {
            double value = 0;
            words >> value;
            // half a step of 11 bits, and half a unit of the fourth digit
            const double exact = position.at(200, 100, c);
            EXPECT_NEAR(value, exact, exact / 4096 + 500) << seen.told;
        }
    }
    const Image errors =
        errorImage(Metric::relative, ChannelKind::vector, position,
                   frames[1].channels.at(gpu::DEBUG_position), everyPixel(position.pixels()));
    const std::string difference = seen.told[3];
    ASSERT_TRUE(difference.starts_with("difference ")) << difference;
    EXPECT_NEAR(std::stod(difference.substr(11)), errors.at(200, 100), errors.at(200, 100) * 6e-4);
}

TEST(Page, WorstPixelsLeadIntoThePicture) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const std::string script = R"(
      const card = $('#c0-roughness'), film = card.querySelector('.film');
      await until(() => card.querySelector('.readout').children.length > 1);
      // The pixel at the middle of the film, and how many stand side by side in it.
      const where = () => { const f = film.getBoundingClientRect(), i = film.querySelector('img').getBoundingClientRect();
        return [Math.floor((f.left + f.width / 2 - i.left) / i.width * 96), Math.floor((f.top + f.height / 2 - i.top) / i.height * 54), Math.round(f.width / i.width * 96)]; };
      const first = where(), says = () => card.querySelector('.readout').firstChild.textContent;
      const told = { links: [...card.querySelectorAll('[data-pixel]')].map(link => link.dataset.pixel), first, says: says() };
      pointer('pointermove', film, .5, .5);
      card.querySelectorAll('[data-pixel]')[1].click(); told.second = where(); told.hash = location.hash;
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

// As the tool leaves it: whatever can be opened is open, and every picture is there.
TEST(Page, ARealReportIsWholeAndSilent) {
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
      for (const card of cards) { card.scrollIntoView(); pointer('pointermove', card.querySelector('.film'), .5, .5);
        await until(() => card.querySelector('.readout').children.length > 1); }
      tell({ images: images.length, broken: images.filter(image => !image.naturalWidth).map(image => image.src), cards: cards.length,
             unread: cards.filter(card => card.querySelector('.readout').children.length < 2).map(card => card.id),
             timed: bars.filter(width => width > 20).length, plots: $$('.plot rect').length > 50,
             marks: $$('.marks tr').length > 5 });)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told;
    EXPECT_GT(seen.told["images"], 60);
    EXPECT_EQ(seen.told["broken"], nlohmann::json::array());
    EXPECT_EQ(seen.told["cards"], 30);
    EXPECT_EQ(seen.told["unread"], nlohmann::json::array());
    EXPECT_GE(seen.told["timed"], 4) << "a bar for each path of each scene at least";
    EXPECT_EQ(seen.told["plots"], true);
    EXPECT_EQ(seen.told["marks"], true);
}

// What a failing channel's card prints makes the same comparison, of that channel alone.
TEST(Page, TheCommandOfAReportMakesItAgain) {
    const Folder folder;
    const Ran first = runTool(folder,
                              "compare builtin:cutout --size 96x54 --runs 0 --gbuffer compact --baseline "
                              "forward_plus --json -o report");
    ASSERT_EQ(first.code, 0) << first.err;
    const std::string junit = contentsOf(folder / "report/junit.xml"),
                      start = "name=\"command\" value=\"diptych ";
    const std::size_t at = junit.find(start) + start.size();
    const std::string command = junit.substr(at, junit.find('"', at) - at);
    EXPECT_EQ(command, "compare --baseline forward_plus --gbuffer compact --size 96x54 builtin:cutout");
    for (const std::string channel : {"lit", "normals"}) {
        const Ran again = runTool(folder, command + " --channels " + channel + " --json --runs 0 -o again");
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
}

// Where the system asks for less motion, a key alone starts none; a click is a wish.
TEST(Page, FlickerNeedsAClickWhereMotionIsUnwelcome) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visit(folder, written(folder, reportOf(rampFrames())), R"(
      const card = $('#c0-roughness'), pair = card.querySelector('.pair');
      pointer('pointermove', card.querySelector('.film'), .5, .5);
      key('f'); const byKey = pair.dataset.mode;
      card.querySelector('[data-show=flicker]').click(); const byClick = pair.dataset.mode;
      card.open = false; await wait(50);
      tell([matchMedia('(prefers-reduced-motion: reduce)').matches, byKey, byClick, pair.dataset.mode]);)",
                             "", 1200, "--force-prefers-reduced-motion");
    EXPECT_EQ(seen.console, "");
    EXPECT_EQ(seen.told, (nlohmann::json{true, "wipe", "flicker", "wipe"})) << "a closed card stops it, too";
}

TEST(Page, NothingIsWiderThanAPhone) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    // Chromium's window is at least 500 wide: the page itself is made narrower.
    const fs::path page = written(folder, reportOf(rampFrames()));
    const Visit seen = visit(folder, page, R"(
      $$('details').forEach(d => d.open = true); document.documentElement.style.width = '390px'; await wait(100);
      const wide = () => $$('body *').filter(e => !e.closest('.scroll, .loupe, .film, svg, .axis') && e.getBoundingClientRect().right > 391 && getComputedStyle(e).display !== 'none');
      const cut = () => $$('.buttons, .readout, .again, dl').filter(e => e.scrollWidth > e.clientWidth + 1);
      const found = () => [...wide(), ...cut()].map(e => e.tagName + '.' + e.className).slice(0, 5), clean = found();
      // and what is too wide would be found
      $('.card .body').insertAdjacentHTML('beforeend', '<p class="planted" style="width:500px">wide</p>');
      $('.buttons').style.cssText = 'flex-wrap:nowrap;width:100px';
      tell([clean, found()]);)",
                             "", 500);
    EXPECT_EQ(seen.console, "");
    EXPECT_EQ(seen.told, (nlohmann::json{nlohmann::json::array(), {"P.planted", "SPAN.buttons"}}));
}

TEST(Page, ASingleFileLoadsNoOther) {
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
      pointer('pointermove', $('#c0-roughness .film'), .5, .5); await wait(100);
      const film = $('#c0-roughness .film img');
      tell({ sources: images.filter(i => !(i.getAttribute('src') || i.getAttribute('href')).startsWith('data:')).length,
             broken: $$('img').filter(i => !i.naturalWidth).length, half: [film.naturalWidth, film.naturalHeight],
             scripts: $$('script[src], link').length, says: $('#c0-roughness .readout').textContent,
             fetched: performance.getEntriesByType('resource').map(e => e.name).filter(n => !n.startsWith('data:')) });)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told;
    EXPECT_EQ(seen.told["sources"], 0);
    EXPECT_EQ(seen.told["broken"], 0);
    EXPECT_EQ(seen.told["half"], (nlohmann::json{48, 27}));
    EXPECT_EQ(seen.told["scripts"], 0);
    EXPECT_EQ(seen.told["fetched"], nlohmann::json::array());
    EXPECT_EQ(seen.told["says"], "a single file leaves out the values under the cursor");
}

}  // namespace
}  // namespace diptych
