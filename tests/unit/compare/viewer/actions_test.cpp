// SPDX-License-Identifier: MIT
// Keys, dropped files and the window's size change the interface's state.
#include "compare/viewer/interface/actions.h"
#include "shared/image/exr.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace diptych::viewer {
namespace {

// ---- keys ----------------------------------------------------------------------------------------------

std::optional<std::string> act(Action action, InterfaceState& state, const Contents& contents = {}) {
    return actOnState({action}, false, contents, state);
}

TEST(ViewerActions, TheNextCameraFollowsTheOneInUse) {
    const struct {
        std::vector<std::string> cameras;
        const char* now;
        const char* next;
        const char* message;
    } rows[] = {{{"front", "back"}, "", "1", "camera 1 back"},  // the first is the scene's own
                {{"front", "back"}, "0", "1", "camera 1 back"},
                {{"front", "back"}, "1", "0", "camera 0 front"},
                {{"front", "back"}, "eye=1,2,3 target=0,0,0", "0", "camera 0 front"},
                {{"front", "", "top"}, "1", "2", "camera 2 top"},
                {{"only"}, "", "0", "camera 0 only"},
                {{"only"}, "0", "0", "camera 0 only"},
                {{}, "", "", "the default view: this scene has no camera"},
                {{}, "eye=1,2,3 target=0,0,0", "", "the default view: this scene has no camera"}};
    for (const auto& [cameras, now, next, message] : rows) {
        SceneProperties properties;
        properties.cameras = cameras;
        Contents contents;
        contents.properties = std::make_shared<const SceneProperties>(properties);
        InterfaceState state;
        state.subject.settings.camera = now;
        EXPECT_EQ(act(Action::next_camera, state, contents), message) << now;
        EXPECT_EQ(state.requests.camera, next) << now << " of " << cameras.size();
    }
    InterfaceState state;
    EXPECT_EQ(act(Action::next_camera, state), "the default view: this scene has no camera");
}

// Only of the verdict on this view, whichever path is on the right, and of the visible channel.
TEST(ViewerActions, TheWorstPixelIsThatOfTheVisibleChannel) {
    std::vector<Frame> frames = withOnly({Channel::lit, Channel::material_id, Channel::depth}, bothFrames());
    for (Frame& frame : frames) frame.channels.at(Channel::material_id).at(2, 1) = 3;  // a surface too
    frames[0].channels.at(Channel::depth).at(2, 1) = 0.5f;
    frames[1].channels.at(Channel::depth).at(2, 1) = 1;
    frames[1].channels.at(Channel::lit).at(1, 2, 0) = 0.75f;
    frames[1].through_gbuffer.at(Channel::lit).at(1, 2) = 0.25f;
    InterfaceState state;
    Contents contents;
    EXPECT_EQ(act(Action::worst_pixel, state, contents), "no verdict for this view yet");
    contents.evaluated =
        std::make_shared<const EvaluatedPair>(EvaluatedPair{ofBothPaths(state.subject), reportOf(frames)});
    for (const Path path : drawn_paths) {
        state.subject.settings.path = path;
        state.requests = {};
        EXPECT_EQ(act(Action::worst_pixel, state, contents), "");
        EXPECT_EQ(state.requests.flight, (PixelFlight{{1, 2}, surroundingsZoom}));
    }
    state.view_options.mode = Channel::depth;
    EXPECT_EQ(act(Action::worst_pixel, state, contents), "");
    EXPECT_EQ(state.requests.flight, (PixelFlight{{2, 1}, surroundingsZoom}));
    state.requests = {};
    state.view_options.mode = Channel::normals;
    EXPECT_EQ(act(Action::worst_pixel, state, contents), "no pixel of normals differs");
    state.subject.settings.time = 1;
    EXPECT_EQ(act(Action::worst_pixel, state, contents), "no verdict for this view yet");
    EXPECT_EQ(state.requests.flight, std::nullopt);
}

TEST(ViewerActions, ZoomGoesToThePixelUnderTheCursorOrTheMiddleAndBack) {
    InterfaceState state;
    state.subject.settings.size = {65, 36};
    Contents contents;
    EXPECT_EQ(act(Action::zoom, state, contents), "");
    EXPECT_EQ(state.requests.flight, (PixelFlight{{32, 18}, digitsZoom}));
    contents.under = PixelUnder{1, {3, 4}};
    EXPECT_EQ(act(Action::zoom, state, contents), "");
    EXPECT_EQ(state.requests.flight, (PixelFlight{{3, 4}, digitsZoom}));
    state.requests = {};
    state.canvas.zoom = 1;
    EXPECT_EQ(act(Action::zoom, state, contents), "");
    EXPECT_EQ(state.canvas.zoom, 0);
    EXPECT_EQ(state.requests.flight, std::nullopt);
    EXPECT_GE(digitsZoom, valuesFrom) << "where values are written into pixels";
}

TEST(ViewerActions, EscapeLeavesTheInnermostFirst) {
    InterfaceState state;
    state.help = true;
    state.canvas.zoom = 2;
    state.pixel = PixelPosition{1, 2};
    const auto left = [&] { return std::tuple(state.help, state.canvas.zoom, state.pixel.has_value()); };
    EXPECT_EQ(act(Action::leave, state), "");
    EXPECT_EQ(left(), std::tuple(false, 2.0, true));
    EXPECT_EQ(act(Action::leave, state), "");
    EXPECT_EQ(left(), std::tuple(false, 0.0, true));
    EXPECT_EQ(act(Action::leave, state), "");
    EXPECT_EQ(left(), std::tuple(false, 0.0, false));
    EXPECT_EQ(act(Action::leave, state), std::nullopt) << "the window leaves full screen";
}

TEST(ViewerActions, KeysAskTheWindowForWhatNeedsIt) {
    InterfaceState state;
    state.subject.scene = "a.glb";
    EXPECT_EQ(act(Action::copy_command, state), "");
    EXPECT_EQ(state.requests.copy, "diptych render a.glb");
    EXPECT_FALSE(state.requests.reload);
    EXPECT_EQ(act(Action::reload, state), "");
    EXPECT_TRUE(state.requests.reload);
    for (const Action own :
         {Action::forward, Action::flicker, Action::screenshot, Action::full_screen, Action::quit})
        EXPECT_EQ(act(own, state), std::nullopt) << static_cast<int>(own);
}

TEST(ViewerTitle, NamesTheSceneAndTheChannel) {
    InterfaceState state;
    state.subject.scene = "a.glb";
    Contents contents;
    EXPECT_EQ(titleOf(state, contents), "Diptych - a.glb - lit") << "until it is read";
    SceneProperties properties;
    properties.name = "A box";
    contents.properties = std::make_shared<const SceneProperties>(properties);
    state.view_options.mode = Channel::normals;
    EXPECT_EQ(titleOf(state, contents), "Diptych - A box - normals");
    state.view_options.heat = true;
    EXPECT_EQ(titleOf(state, contents), "Diptych - A box - light_count");
}

// ---- sizes that follow the window -----------------------------------------------------------------------

// As large as the panel that shows them: of the whole canvas, or each of two beside one another.
TEST(ViewerFit, ImagesAreAsLargeAsTheirPanel) {
    for (const CanvasRect canvas : {CanvasRect{0, 34, 735, 700}, CanvasRect{0, 34, 736, 701}})
        for (const Layout layout : {Layout::wipe, Layout::side_by_side, Layout::single})
            for (const Difference difference : {Difference::none, Difference::flip}) {
                InterfaceState state;
                state.canvas.layout = layout;
                state.view_options.difference = difference;
                state.subject.settings.camera = "drawn";
                state.edited.camera = "edited";
                EXPECT_TRUE(fitToCanvas(canvas, state));
                const Size size = state.subject.settings.size;
                EXPECT_EQ(state.edited.size, size);
                for (const PanelRect& panel : panelRectsOf(canvas, state)) {
                    EXPECT_EQ(panel.placement.scale, 1);
                    EXPECT_EQ(panel.rect.height, size.height);
                    if (layout != Layout::wipe || difference != Difference::none) {
                        EXPECT_EQ(panel.rect.width, size.width);
                    }
                }
                EXPECT_EQ(state.edited.camera, "edited");
                EXPECT_FALSE(fitToCanvas(canvas, state)) << "nothing has changed";
            }
}

TEST(ViewerFit, NoImageIsEmptyAndARequestedSizeStays) {
    InterfaceState state;
    state.canvas.layout = Layout::side_by_side;
    EXPECT_TRUE(fitToCanvas({0, 0, 1, 0}, state));
    EXPECT_EQ(state.subject.settings.size, (Size{1, 1}));
    state.follow = false;
    state.subject.settings.size = {64, 36};
    state.edited.size = {32, 18};  // not drawn: it has a problem
    EXPECT_FALSE(fitToCanvas({0, 0, 100, 100}, state));
    EXPECT_EQ(state.subject.settings.size, (Size{64, 36}));
    EXPECT_EQ(state.edited.size, (Size{32, 18}));
}

TEST(ViewerFit, APixelOutsideTheImagesIsNoLongerInspected) {
    for (const bool follow : {false, true})
        for (const auto& [x, y, stays] : {std::tuple{63, 35, true}, {64, 0, false}, {0, 36, false}}) {
            InterfaceState state;
            state.follow = follow;
            state.subject.settings.size = follow ? Size{200, 200} : Size{64, 36};
            state.pixel = PixelPosition{x, y};
            fitToCanvas({0, 0, 64, 36}, state);
            EXPECT_EQ(state.pixel.has_value(), stays) << x << "," << y;
        }
}

// ---- files that are dropped ----------------------------------------------------------------------------

TEST(ViewerDropped, AnEndingSaysWhatAFileIs) {
    const std::filesystem::path made = folder(), ours = made / "Ours.EXR", sky = made / "sky.exr";
    const Image image(1, 1, 3, 0.5f);
    writeExr(ours, {{{"R", "G", "B"}, &image}}, {{"software", "diptych"}});
    writeExr(sky, {{{"R", "G", "B"}, &image}}, {});
    InterfaceState state;
    EXPECT_EQ(openDropped("c.txt", state), "c.txt: not a .gltf, .glb, .exr or .hdr file");
    EXPECT_EQ(state.view_options, ViewOptions());
    EXPECT_EQ(openDropped(ours, state), "left: " + ours.string());
    EXPECT_EQ(state.stored, ours);
    EXPECT_EQ(state.view_options.file, ours);
    EXPECT_EQ(state.view_options.against, Against::file);
    for (const std::filesystem::path& environment : {sky, std::filesystem::path("d.hdr")}) {
        EXPECT_EQ(openDropped(environment, state), "environment: " + environment.string());
        EXPECT_EQ(state.subject.settings.env, environment.string());
        EXPECT_EQ(state.edited.env, environment.string());
    }
    EXPECT_EQ(state.view_options.file, ours) << "an environment leaves the panels";
    // A scene is shown from its own camera, from the start and without what belongs to another one.
    Subject expected = state.subject;
    expected.settings.gbuffer = state.subject.settings.gbuffer = state.edited.gbuffer =
        GBufferEncoding::compact;
    for (const char* scene : {"a.gltf", "b.GLB"}) {
        for (Settings* s : {&state.subject.settings, &state.edited}) {
            s->camera = "1";
            s->time = 2;
            s->animation = "walk";
            s->variant = "red";
        }
        state.pixel = PixelPosition{1, 2};
        state.canvas.zoom = 4;
        state.requests = {};
        EXPECT_EQ(openDropped(scene, state), "");
        expected.scene = scene;
        EXPECT_EQ(state.subject, expected) << scene;
        EXPECT_EQ(state.edited, expected.settings);
        EXPECT_EQ(state.pixel, std::nullopt);
        EXPECT_EQ(state.canvas.zoom, 0);
        EXPECT_EQ(state.requests.camera, "") << "the window takes it over, even if it was the last one too";
        EXPECT_TRUE(state.requests.reload);
    }
}

}  // namespace
}  // namespace diptych::viewer
