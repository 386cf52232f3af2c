// SPDX-License-Identifier: MIT
// A window of `diptych view` on a virtual screen, and its images.
#pragma once

#include "compare/viewer/drawing/canvas.h"
#include "compare/viewer/interface/interface_state.h"
#include "shared/image/png.h"
#include "tests/tool/display.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace diptych {

inline constexpr int windowWidth = 1280,
                     windowHeight = 760;  // as view opens it, without a window manager at 0,0

// A window that has rendered everything requested.
class ViewTest : public testing::Test {
protected:
    void SetUp() override {
        if (!Display::isThere())
            GTEST_SKIP() << "Xvfb and xdotool are not installed: nothing is proved here of the window";
        display_.emplace(folder_);
    }

    // Starts `view` with --size 320x180, which is enlarged to fit, and waits until it is still. The first
    // panel is the deferred path's.
    void open(std::vector<std::string> words, const std::string& size = "320x180") {
        words.insert(words.begin(), {"view", "-v", "--size", size});
        start(words);
        settle();
        display_->events("mousemove 60 650");
    }

    // Its output goes to its own file, apart from other programs of the test.
    void start(const std::vector<std::string>& words) { view_.emplace(folder_, words, folder_ / "view.log"); }

    std::size_t times(const std::string& what) const {
        const std::string said = view_->err();
        std::size_t count = 0;
        for (std::size_t at = 0; (at = said.find(what, at)) != said.npos; ++at) ++count;
        return count;
    }
    // Waits until it has printed `what` more than `before` times.
    void await(const std::string& what, std::size_t before) {
        EXPECT_TRUE(soon([&] { return times(what) > before || view_->ended(); })) << what << "\n"
                                                                                  << view_->err();
        ASSERT_FALSE(view_->ended()) << view_->err();
    }
    // Waits until nothing more is rendered.
    void settle() {
        await("view: still", stills_);
        // Rendering requested just before prints it once more.
        for (std::size_t now = 0; now != times("view: still");) {
            now = stills_ = times("view: still");
            std::this_thread::sleep_for(std::chrono::milliseconds(400));
        }
    }
    // Presses a key and waits until it is handled.
    void key(const std::string& name) {
        const std::size_t before = times("view: key ");
        display_->events("key " + name);
        await("view: key ", before);
    }
    // And until all rendering is done.
    void keyAndSettle(const std::string& name) {
        stills_ = times("view: still");
        key(name);
        settle();
    }
    std::string lastLine(const std::string& with) const {
        const std::string said = view_->err();
        const std::size_t at = said.rfind(with);
        return at == said.npos ? "" : said.substr(at, said.find('\n', at) - at);
    }
    void close() {
        display_->events("key ctrl+q");
        EXPECT_TRUE(soon([&] { return view_->ended(); }));
        const int status = view_->wait();
        EXPECT_TRUE(WIFEXITED(status)) << status << view_->err();
        EXPECT_EQ(WEXITSTATUS(status), 0) << view_->err();
    }

    // The image that render writes for `words`.
    PngImage rendered(const std::string& words) {
        const Ran ran = runTool(folder_, "render " + words + " --runs 0 --force -o rendered.png");
        EXPECT_EQ(ran.code, 0) << ran.err;
        const std::string bytes = contentsOf(folder_ / "rendered.png");
        return readPngImage(std::as_bytes(std::span(bytes)), "rendered.png");
    }

    // Number of image pixels that differ from the panel by more than one display level. `image` may have
    // a strip below.
    int differing(const PngImage& image, std::size_t panel, const viewer::CanvasView& view,
                  bool difference = false) {
        const Screen screen = display_->screen();
        viewer::InterfaceState state;
        const viewer::CanvasRect canvas = viewer::canvasOf(state, windowWidth, windowHeight, 1);
        Size size;
        size.width = 320;
        size.height = 180;
        const double line = canvas.x + view.wipe * canvas.width;
        int count = 0, seen = 0;
        for (const viewer::PanelRect& panel_rect : viewer::panelRectsOf(canvas, size, view, difference)) {
            if (panel_rect.panel != panel) continue;
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const double px = panel_rect.placement.left + (x + 0.5) * panel_rect.placement.scale,
                                 py = panel_rect.placement.top + (y + 0.5) * panel_rect.placement.scale;
                    // The wipe's line and its handle.
                    if (!panel_rect.rect.contains(px, py) ||
                        (view.layout == viewer::Layout::wipe && std::abs(px - line) < 14))
                        continue;
                    ++seen;
                    const auto& shown = screen.at(static_cast<int>(px), static_cast<int>(py));
                    for (int c = 0; c < 3; ++c)
                        if (std::abs(shown[static_cast<std::size_t>(c)] - 255 * image.image.at(x, y, c)) >
                            1.01) {
                            ++count;
                            break;
                        }
                }
        }
        EXPECT_GT(seen, 1000);
        return count;
    }

    Folder folder_;
    std::optional<Display> display_;
    std::optional<Running> view_;
    std::size_t stills_ = 0;
};

inline viewer::CanvasView wipe() {
    return {};
}
inline viewer::CanvasView single() {
    viewer::CanvasView view;
    view.layout = viewer::Layout::single;
    return view;
}

}  // namespace diptych
