// SPDX-License-Identifier: MIT
// The window's interface shows the state and its contents, and each control changes what it names.
#include "compare/viewer/interface/keys.h"
#include "tests/support/interface_screen.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace diptych::viewer {
namespace {

class ViewerInterface : public testing::Test {
protected:
    ViewerInterface() {
        screen_.state.subject.scene = "builtin:points";
        screen_.state.subject.settings.size = {64, 36};
        screen_.state.edited = screen_.state.subject.settings;
    }

    // A view of 64x36 in which deferred is 0.25 and forward+ 0.5 everywhere.
    DrawnView drawn() const {
        DrawnView view;
        view.request.subject = screen_.state.subject;
        view.request.view_options = screen_.state.view_options;
        view.size = {64, 36};
        for (std::size_t i = 0; i < 2; ++i) {
            view.panels[i].name = nameOf(drawn_paths[i]);
            view.panels[i].values = Image(64, 36, 3, i == 0 ? 0.25f : 0.5f);
            PathProperties& path = view.paths[i];
            path.name = view.panels[i].name;
            path.ms = i == 0 ? 1.5 : 2.25;
            path.bytes.images = 3 << 20;
            path.bytes.buffers = 1 << 20;
            path.bytes.gbuffer_per_pixel = 24;
            path.passes = {{"geometry", 0.5}, {"shade", 1.5}};
            path.counters.lights = 3;
        }
        return view;
    }
    void show(DrawnView view) { screen_.contents.shown = std::make_shared<const DrawnView>(std::move(view)); }
    void show(SceneProperties properties) {
        screen_.contents.properties = std::make_shared<const SceneProperties>(std::move(properties));
    }

    InterfaceScreen screen_;
    InterfaceState& state_ = screen_.state;
    Contents& contents_ = screen_.contents;
    const Settings& settings_ = screen_.state.subject.settings;
};

// ---- the bar -------------------------------------------------------------------------------------------

TEST_F(ViewerInterface, TheBarChoosesWhatIsShown) {
    state_.stored = "stored.exr";
    screen_.draw();
    screen_.click("0 lit");
    screen_.choose("2 normals");
    EXPECT_EQ(state_.view_options.mode, Channel::normals);
    screen_.click("heat map");
    EXPECT_EQ(state_.view_options.channel(), Channel::light_count);
    screen_.click("heat map");
    EXPECT_EQ(state_.view_options.channel(), Channel::normals);
    screen_.click("wipe");
    screen_.choose("side by side");
    EXPECT_EQ(state_.canvas.layout, Layout::side_by_side);
    screen_.click("side by side");
    screen_.choose("one panel");
    EXPECT_EQ(state_.canvas.layout, Layout::single);
    screen_.click("the other path");
    screen_.choose("a stored image");
    EXPECT_EQ(state_.view_options.against, Against::file);
    EXPECT_EQ(state_.view_options.file, "stored.exr");
    screen_.click("a stored image");
    screen_.choose("the reference");
    EXPECT_EQ(state_.view_options.against, Against::reference);
    EXPECT_EQ(state_.view_options.file, "");
    screen_.click("none");
    screen_.choose("FLIP");
    EXPECT_EQ(state_.view_options.difference, Difference::flip);
    screen_.click("keys: H");
    EXPECT_TRUE(state_.help);
    screen_.draw();
    for (const KeyBinding& binding : keyBindings())
        EXPECT_TRUE(screen_.shows(std::string(binding.does))) << binding.name;
    EXPECT_TRUE(screen_.shows("drop a file"));
}

TEST_F(ViewerInterface, WithoutAStoredImageThereIsNoneToChoose) {
    screen_.draw();
    screen_.click("the other path");
    EXPECT_TRUE(screen_.shows("the reference"));
    EXPECT_FALSE(screen_.shows("a stored image"));
}

// Dragging by 40 pixels at 1 % each multiplies the factor by about 1.4.
TEST_F(ViewerInterface, TheExposureIsAutomaticOrAFactor) {
    screen_.draw();
    EXPECT_FALSE(screen_.shows("x 1"));
    screen_.click("auto");
    EXPECT_EQ(state_.view_options.exposure, 1.0);
    screen_.draw();
    screen_.pointAt("x 1");
    screen_.drag(40);
    EXPECT_GT(state_.view_options.exposure.value_or(0), 1.05);
    screen_.click("auto");
    EXPECT_EQ(state_.view_options.exposure, std::nullopt);
    state_.view_options.ev100 = 3;
    screen_.draw();
    EXPECT_FALSE(screen_.shows("x "));
    screen_.click("auto");
    EXPECT_EQ(state_.view_options.ev100, std::nullopt);
    show([&] {
        DrawnView view = drawn();
        view.scale = "black 0, white 2";
        return view;
    }());
    screen_.pointAt("auto");
    screen_.draw(10);
    EXPECT_TRUE(screen_.shows("exposure: black 0, white 2"));
}

// ---- the footer and the images -------------------------------------------------------------------------

TEST_F(ViewerInterface, TheFooterSaysAnErrorOrAMessageOrThePixelAndWhatIsBeingDone) {
    screen_.draw();
    EXPECT_TRUE(screen_.shows("no pixel under the cursor"));
    EXPECT_TRUE(screen_.shows("drawing"));
    contents_.idle = true;
    show(drawn());
    contents_.under = PixelUnder{0, {3, 4}};
    screen_.draw();
    EXPECT_TRUE(screen_.shows("3,4  deferred: 0.25 0.25 0.25  forward_plus: 0.5 0.5 0.5"));
    EXPECT_TRUE(screen_.shows("done"));
    state_.message = "copied";
    state_.message_until = ImGui::GetTime() + 1;
    contents_.status.doing = "read images";
    contents_.status.fraction = 0.25;
    screen_.draw();
    EXPECT_TRUE(screen_.shows("copied"));
    EXPECT_TRUE(screen_.shows("read images 25 %"));
    EXPECT_FALSE(screen_.shows("3,4"));
    contents_.status.error = "it is broken";
    screen_.draw();
    EXPECT_TRUE(screen_.shows("it is broken"));
    EXPECT_FALSE(screen_.shows("copied"));
    contents_.status = {};
    screen_.draw(12);
    EXPECT_FALSE(screen_.shows("copied")) << "a message is shown for a while";
    state_.canvas.zoom = 4;
    screen_.draw();
    EXPECT_TRUE(screen_.shows("zoom 400 %"));
}

TEST_F(ViewerInterface, WhatIsReadIsShownUntilThereIsAnImage) {
    contents_.status.doing = "read buffers";
    contents_.status.loading = true;
    screen_.draw();
    EXPECT_TRUE(screen_.shows("read buffers\n"));
    show(drawn());
    screen_.draw();
    EXPECT_TRUE(screen_.shows("read buffers\n"));
    contents_.status.loading = false;
    screen_.draw();
    EXPECT_FALSE(screen_.shows("read buffers\n"));
}

TEST_F(ViewerInterface, ImagesHaveTitlesAndALegend) {
    state_.canvas.layout = Layout::side_by_side;
    state_.view_options.mode = Channel::depth;
    DrawnView view = drawn();
    view.scale = "black 0 m, white 9 m";
    view.panels[0].missing = "the reference is being drawn";
    show(view);
    screen_.draw();
    EXPECT_LT(screen_.at("deferred: depth").x, screen_.at("forward_plus: depth").x);
    EXPECT_TRUE(screen_.shows("the reference is being drawn"));
    EXPECT_TRUE(screen_.shows("black 0 m, white 9 m"));
    view.heat_top = 6;
    show(view);
    screen_.draw();
    EXPECT_LT(screen_.at("0").x, screen_.at("3").x);
    EXPECT_LT(screen_.at("3").x, screen_.at("6").x);
    EXPECT_TRUE(screen_.shows("lights per pixel"));

    state_.view_options.difference = Difference::signed_difference;
    view.request.view_options = state_.view_options;
    view.difference.emplace();
    view.difference->top = 0.5;
    view.difference->is_signed = true;
    view.difference->text = "right - left, m";
    show(view);
    screen_.draw();
    EXPECT_TRUE(screen_.shows("signed difference of depth: forward_plus (right) and deferred (left)"));
    EXPECT_LT(screen_.at("-0.5").x, screen_.at("0.5").x);
    EXPECT_TRUE(screen_.shows("right - left, m"));
    EXPECT_FALSE(screen_.shows("lights per pixel"));
    view.difference->is_signed = false;
    show(view);
    screen_.draw();
    EXPECT_LT(screen_.at("0.125").x, screen_.at("0.5").x);
    view.difference->top = 0;
    show(view);
    screen_.draw();
    EXPECT_TRUE(screen_.shows("right - left, m: 0 everywhere"));
    view.difference->missing = "of another size";
    show(view);
    screen_.draw();
    EXPECT_TRUE(screen_.shows("of another size"));
    EXPECT_FALSE(screen_.shows("0 everywhere"));
}

// Each pixel's components, below one another, in the pixel and nowhere else.
TEST_F(ViewerInterface, LargePixelsHaveTheirValues) {
    state_.canvas.layout = Layout::single;
    state_.canvas.zoom = 80;
    state_.canvas.centre_x = 2;
    state_.canvas.centre_y = 2;
    DrawnView view = drawn();
    view.panels[1].values.at(1, 2, 0) = 0.0625f;
    view.panels[1].values.at(1, 2, 2) = 7;
    show(view);
    screen_.draw();
    const auto rects = panelRectsOf(canvasOf(state_, 1280, 900, 1), state_);
    ASSERT_EQ(rects.size(), 1u);
    const Placement at = rects[0].placement;
    const DrawnText red = screen_.at("0.0625"), blue = screen_.at("7");
    EXPECT_EQ(std::floor((red.x - at.left) / at.scale), 1);
    EXPECT_EQ(std::floor((red.y - at.top) / at.scale), 2);
    EXPECT_EQ(blue.x, red.x);
    EXPECT_NEAR(blue.y, red.y + 2 * red.height, 2) << "outlines are a pixel away";
}

// They cut no other text off: the description of the colours stays.
TEST_F(ViewerInterface, LightsAreShownInEachPanel) {
    state_.light_debug = true;
    state_.canvas.layout = Layout::side_by_side;
    state_.view_options.mode = Channel::depth;
    DrawnView view = drawn();
    view.scale = "black 0 m, white 9 m";
    Light sun;
    sun.kind = LightKind::directional;
    sun.name = "sun";
    sun.direction = {0, -1, 0};
    view.lights = {sun};
    show(view);
    screen_.draw();
    std::set<bool> right;
    const int middle = canvasOf(state_, 1280, 900, 1).width / 2;
    for (const DrawnText& text : screen_.texts)
        if (text.text == "directional sun towards 0.00,-1.00,0.00")
            right.insert(text.x > static_cast<float>(middle));
    EXPECT_EQ(right, (std::set{false, true}));
    EXPECT_TRUE(screen_.shows("black 0 m, white 9 m"));
}

// ---- panels --------------------------------------------------------------------------------------------

TEST_F(ViewerInterface, TabsOpenByAClick) {
    screen_.draw();
    const std::pair<const char*, const char*> tabs[] = {{"Settings", "reset to defaults"},
                                                        {"Scene", "read again (R)"},
                                                        {"Pixel", "Right-click a picture to inspect a pixel"},
                                                        {"Cost", "rendering device: "},
                                                        {"Verdict", "Both paths are compared"}};
    for (const auto& [name, own] : tabs) {
        screen_.click(name);
        EXPECT_TRUE(screen_.shows(own)) << screen_.all();
        for (const auto& [other, hidden] : tabs)
            EXPECT_EQ(screen_.shows(hidden), other == name) << name << " and " << other;
    }
    state_.panels = false;
    screen_.draw();
    EXPECT_FALSE(screen_.shows("Verdict"));
}

TEST_F(ViewerInterface, AChannelOfTheVerdictIsShownAtItsWorstPixel) {
    std::vector<Frame> frames = withOnly({Channel::lit, Channel::material_id, Channel::depth}, bothFrames());
    frames[1].channels.at(Channel::lit).at(1, 2, 0) = 0.75f;
    frames[1].through_gbuffer.at(Channel::lit).at(1, 2) = 0.25f;
    contents_.evaluated =
        std::make_shared<const EvaluatedPair>(EvaluatedPair{ofBothPaths(state_.subject), reportOf(frames)});
    screen_.open(Tab::verdict);
    EXPECT_TRUE(screen_.shows("Click a channel to show its difference at its worst pixel"));
    EXPECT_TRUE(screen_.shows("FAIL"));
    EXPECT_LT(screen_.at("lit").y, screen_.at("depth").y) << "what fails comes first";
    for (const char* head : {"channel", "metric", "measured", "limit", "verdict"})
        EXPECT_TRUE(screen_.shows(head));
    EXPECT_EQ(state_.requests.flight, std::nullopt);
    screen_.click("lit");
    EXPECT_EQ(state_.view_options.mode, Channel::lit);
    EXPECT_EQ(state_.view_options.difference, Difference::absolute);
    EXPECT_EQ(settings_.path, Path::forward_plus);
    EXPECT_EQ(state_.edited.path, Path::forward_plus);
    EXPECT_EQ(state_.requests.flight, (PixelFlight{{1, 2}, surroundingsZoom}));
    screen_.click("copy as diptych compare");
    EXPECT_EQ(state_.requests.copy, compareCommand(state_));
    state_.subject.settings.time = 1;
    screen_.draw();
    EXPECT_TRUE(screen_.shows("This is the verdict of the previous view"));
}

TEST_F(ViewerInterface, SettingsAreChosenTypedAndReset) {
    screen_.open(Tab::settings);
    screen_.click("filter by name");
    screen_.type("spec-aa");
    EXPECT_TRUE(screen_.shows("spec-aa-limit"));
    EXPECT_FALSE(screen_.shows("haze"));
    screen_.click(Settings().valueOf("spec-aa"));
    screen_.choose("on");
    EXPECT_EQ(settings_.valueOf("spec-aa"), "on");
    EXPECT_EQ(state_.edited, settings_);

    std::ranges::copy(std::string_view("ambient"), state_.filter.begin());
    screen_.draw();
    const auto type = [&](const std::string& before, const std::string& text, ImGuiKey end) {
        screen_.click(before);
        screen_.key(ImGuiKey_End);
        for (std::size_t i = 0; i < before.size(); ++i) screen_.key(ImGuiKey_Backspace);
        screen_.type(text);
        screen_.key(end);
    };
    type("0,0,0", "1,2,3", ImGuiKey_Enter);
    EXPECT_EQ(settings_.valueOf("ambient"), "1,2,3");
    type("1,2,3", "4,5,6", ImGuiKey_Escape);
    EXPECT_EQ(settings_.valueOf("ambient"), "1,2,3");
    type("1,2,3", "x", ImGuiKey_Enter);
    EXPECT_EQ(settings_.valueOf("ambient"), "1,2,3");
    EXPECT_TRUE(screen_.shows("not drawn: ")) << screen_.all();

    state_.subject.settings.camera = state_.edited.camera = "1";
    state_.subject.settings.path = Path::forward_plus;
    screen_.click("reset to defaults");
    Settings expected;
    expected.size = {64, 36};
    expected.camera = "1";
    expected.path = Path::forward_plus;
    EXPECT_EQ(settings_, expected);
    EXPECT_EQ(state_.edited, expected);
    EXPECT_EQ(state_.problem, "");
    EXPECT_TRUE(state_.follow);
    screen_.click("follow the window's size");
    EXPECT_FALSE(state_.follow);
}

TEST_F(ViewerInterface, TheSceneTabReadsAgainCopiesAndSwitches) {
    SceneProperties properties;
    properties.cameras = {"front", "back"};
    properties.animations = {"walk"};
    properties.duration = 2;
    properties.notes = {"one note"};
    show(properties);
    DrawnView view = drawn();
    view.paths[1].notes = {"one note", "a path's note"};
    view.plan = {{true, "shadows", "a light casts them"}, {false, "haze", "nothing asks for it"}};
    for (const LightKind kind : {LightKind::directional, LightKind::point, LightKind::rect}) {
        Light light;
        light.kind = kind;
        light.name = "lamp";
        light.intensity = 2.5f;
        view.lights.push_back(light);
    }
    view.lights[1].range = 3;
    show(view);
    state_.subject.settings.lights = state_.edited.lights = "point:8";
    screen_.open(Tab::scene);
    EXPECT_TRUE(screen_.shows("builtin:points"));
    EXPECT_EQ(screen_.at("read again (R)").y, screen_.at("copy as diptych render (Y)").y);
    screen_.click("read again (R)");
    EXPECT_TRUE(state_.requests.reload);
    screen_.click("copy as diptych render (Y)");
    EXPECT_EQ(state_.requests.copy, renderCommand(state_));
    screen_.click("the scene's first, or the default view");
    screen_.choose("1 back");
    EXPECT_EQ(state_.requests.camera, "1");
    EXPECT_EQ(screen_.at("play (K)").y, screen_.at("time, s").y);
    screen_.click("play (K)");
    EXPECT_TRUE(state_.playing);
    screen_.pointAt("0.000");
    screen_.drag(10);
    EXPECT_NEAR(settings_.time, 1, 0.3) << "the text is in the middle of 0 to 2 s, the drag a few pixels";
    screen_.click("the scene's own lights (L)");
    EXPECT_FALSE(settings_.scene_lights);
    screen_.click("lights point:8 (J)");
    EXPECT_EQ(settings_.lights, Settings().lights);
    EXPECT_EQ(state_.rig, "point:8");
    screen_.click("lights point:8 (J)");
    EXPECT_EQ(settings_.lights, "point:8");
    screen_.click("show positions and ranges (Q)");
    EXPECT_TRUE(state_.light_debug);
    state_.light_debug = false;
    screen_.draw();
    for (const char* text :
         {"0 lamp", "directional", "2.5 lx", "none", "1 lamp", "point", "2.5 cd", "3\n", "2 lamp", "rect",
          "2.5 W/(sr m^2)", "environment: ", "one note", "a path's note", "haze: nothing asks for it"})
        EXPECT_TRUE(screen_.shows(text)) << text << "\n" << screen_.all();
    EXPECT_FALSE(screen_.shows("shadows: a light casts them"));
    screen_.click("Modelled for this scene");
    EXPECT_TRUE(screen_.shows("shadows: a light casts them"));
    // A scene that is read, or cannot be.
    state_.loaded = "builtin:triangle";
    contents_.status.loading = true;
    screen_.draw();
    EXPECT_TRUE(screen_.shows("reading: builtin:points"));
    contents_.status.loading = false;
    screen_.draw();
    EXPECT_TRUE(screen_.shows("cannot read: builtin:points"));
}

TEST_F(ViewerInterface, TheChosenPixelIsBrokenDownAndCopied) {
    state_.pixel = PixelPosition{3, 4};
    screen_.open(Tab::pixel);
    EXPECT_TRUE(screen_.shows("pixel 3,4"));
    EXPECT_TRUE(screen_.shows("drawing: each light alone"));
    screen_.click("copy as diptych compare --pixel");
    EXPECT_EQ(state_.requests.copy, compareCommand(state_) + " --pixel 3,4");
    contents_.breakdown = std::make_shared<const Breakdown>(
        Breakdown{ofBothPaths(state_.subject), {3, 4}, {}, "lamp  0.5  0.5"});
    screen_.draw();
    EXPECT_TRUE(screen_.shows("lamp  0.5  0.5"));
    EXPECT_FALSE(screen_.shows("drawing: each light alone"));
    state_.pixel = PixelPosition{4, 4};
    screen_.draw();
    EXPECT_TRUE(screen_.shows("lamp  0.5  0.5")) << "the earlier one, until the new one is there";
    EXPECT_TRUE(screen_.shows("drawing: each light alone"));
}

TEST_F(ViewerInterface, CostsAreThePassesAndTheirShares) {
    contents_.drawn_by = "a CPU";
    contents_.shown_by = "a GPU";
    std::array<History, 2> history;
    contents_.history = &history;
    DrawnView view = drawn();
    view.paths[1].counters.overflowed_lists = 2;
    view.paths[1].counters.nonfinite_pixels = 1;
    view.paths[1].mean_lights = 1.25;
    view.paths[1].max_lights = 3;
    show(view);
    contents_.interface_ms = 4;
    screen_.open(Tab::cost);
    for (const char* text :
         {"rendering device: a CPU; window device: a GPU", "deferred: 1.50 ms per frame",
          "forward_plus: 2.25 ms per frame",
          "images 3.00 MiB, buffers 1.00 MiB; geometry buffers 24 bytes per pixel", "geometry", "0.500",
          "25 %", "1.500", "75 %", "64x36\n", "1.50 ms", "2.25 ms", "4.0 MiB",
          "3 lights; a pixel evaluates 1.2 on average, at most 3", "2 light lists overflowed",
          "1 pixel NaN or infinite", "99 % of the window's own frames take less than 4.0 ms"})
        EXPECT_TRUE(screen_.shows(text)) << text << "\n" << screen_.all();
    view.size = {32, 18};
    show(view);
    screen_.draw();
    EXPECT_TRUE(screen_.shows("32x18, reduced while moving"));
    state_.information = false;
    screen_.draw();
    EXPECT_FALSE(screen_.shows("32x18"));
}

}  // namespace
}  // namespace diptych::viewer
