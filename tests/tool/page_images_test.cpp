// SPDX-License-Identifier: MIT
// The wipe as a browser paints it: the baseline's image left of the divider, the other's right of it.
#include "tests/tool/page_builder.h"

namespace diptych {
namespace {

using nlohmann::json;

// Roughness 0.25 and 0.75 everywhere: greys of 64 and 191.
Report twoGreys() {
    std::vector<Frame> frames = rampFrames();
    for (Frame& frame : frames)
        std::ranges::fill(frame.channels.at(Channel::roughness).data,
                          frame.settings.path == Path::deferred ? 0.25f : 0.75f);
    return reportOf(std::move(frames));
}

// The stage at a point of the pair, for several divider positions; and the colour of each side's image.
// A canvas reads pixels only of images embedded in the page.
constexpr const char* wipeProbe = R"(
  const card = $('#c0-roughness'), pair = card.querySelector('.pair'), slider = pair.querySelector('input');
  const show = () => pair.scrollIntoView({ behavior: 'instant', block: 'center' });
  const images = [...card.querySelectorAll('.stage .panel img')];
  images.forEach(image => image.loading = 'eager');
  await until(() => images.every(image => image.complete && image.naturalWidth));
  const under = x => { show(); const p = at(pair, x, .4),
      stage = document.elementFromPoint(p.clientX, p.clientY).closest('.stage');
    return stage.classList[1] + ' ' + stage.querySelector('.tag').textContent; };
  const grey = image => { const canvas = document.createElement('canvas'), draw = canvas.getContext('2d');
    canvas.width = image.naturalWidth; canvas.height = image.naturalHeight; draw.drawImage(image, 0, 0);
    return [...draw.getImageData(canvas.width - 1, canvas.height - 1, 1, 1).data].slice(0, 3); };
  const told = { files: images.map(image => image.getAttribute('src').slice(0, 40)) };
  for (const at of [30, 80]) {
    slider.value = at; slider.dispatchEvent(new Event('input', { bubbles: true })); await wait(50);
    told[at] = [.02, .28, .32, .78, .82, .98].map(under);
    const line = pair.querySelector('.divider').getBoundingClientRect(), box = pair.getBoundingClientRect();
    told['line' + at] = ((line.left + line.right) / 2 - box.left) / box.width;
  }
  card.querySelector('[data-show=left]').click(); await wait(50); told.left = [.02, .98].map(under);
  card.querySelector('[data-show=right]').click(); await wait(50); told.right = [.02, .98].map(under);
  card.querySelector('[data-show=side]').click(); await wait(50); told.side = [.02, .98].map(under);
  if (told.files.every(file => file.startsWith('data:'))) told.greys = images.map(grey);
  tell(told);)";

void expectOrder(const json& told) {
    ASSERT_TRUE(told.is_object()) << told;
    const std::string left = "left deferred", right = "right forward_plus";
    EXPECT_EQ(told["30"], (json{left, left, right, right, right, right}));
    EXPECT_EQ(told["80"], (json{left, left, left, left, right, right}));
    EXPECT_NEAR(told["line30"].get<double>(), 0.3, 2e-3);
    EXPECT_NEAR(told["line80"].get<double>(), 0.8, 2e-3);
    EXPECT_EQ(told["left"], (json{left, left}));
    EXPECT_EQ(told["right"], (json{right, right}));
    EXPECT_EQ(told["side"], (json{left, right}));
}

TEST(PageImages, TheWipeHasTheBaselineOnItsLeft) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    const Visit seen = visit(folder, written(folder, twoGreys()), wipeProbe);
    EXPECT_EQ(seen.console, "");
    expectOrder(seen.told);
    EXPECT_EQ(seen.told["files"],
              (json{"roughness.deferred.png", "roughness.forward_plus.png", "roughness.difference.png"}));
}

TEST(PageImages, ASingleFileHoldsBothAndTheirDifference) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    ReportOptions single;
    single.single_file = true;
    const Visit seen = visit(folder, written(folder, twoGreys(), single), wipeProbe);
    EXPECT_EQ(seen.console, "");
    expectOrder(seen.told);
    EXPECT_EQ(seen.told["greys"], (json{{64, 64, 64}, {191, 191, 191}, {255, 255, 255}}))
        << "0.25, 0.75, and white: beyond a thousand times the tolerance";
}

}  // namespace
}  // namespace diptych
