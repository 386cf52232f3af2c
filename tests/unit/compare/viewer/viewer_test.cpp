// SPDX-License-Identifier: MIT
// Parts of the viewer, without a window: keys, camera, pixel positions, differences, sizes, watched files.
#include "compare/picture/picture.h"
#include "compare/render/frame_facts.h"
#include "compare/viewer/canvas.h"
#include "compare/viewer/drawing_thread.h"
#include "compare/viewer/fly_camera.h"
#include "compare/viewer/interface.h"
#include "compare/viewer/keys.h"
#include "compare/viewer/picture_cost.h"
#include "compare/viewer/pictures.h"
#include "compare/viewer/scene_watch.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/load.h"
#include "shared/scene/scene_view.h"
#include "tests/support/files.h"
#include "tests/support/frames.h"
#include "tests/support/sources.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>

namespace diptych::viewer {
namespace {

constexpr auto lit = static_cast<int>(gpu::DEBUG_lit), ids = static_cast<int>(gpu::DEBUG_material_id),
               normals = static_cast<int>(gpu::DEBUG_normals);

// ---- keys ------------------------------------------------------------------------------------------------

TEST(ViewerKeys, NoKeyDoesTwoThings) {
    std::set<std::pair<int, bool>> seen;
    for (const KeyBinding& binding : keyBindings())
        for (int key = binding.key; key <= std::max(binding.key, binding.last); ++key) {
            EXPECT_TRUE(seen.emplace(key, binding.control).second) << binding.name;
        }
}

TEST(ViewerKeys, ARowOfDigitsTellsWhichOne) {
    for (int digit = 0; digit < 10; ++digit)
        for (const int first : {GLFW_KEY_0, GLFW_KEY_KP_0}) {
            const auto press = actionOf(first + digit, false);
            ASSERT_TRUE(press) << digit;
            EXPECT_EQ(press->action, Action::channel);
            EXPECT_EQ(press->number, digit);
        }
    EXPECT_FALSE(actionOf(GLFW_KEY_F12, false));
}

// With Ctrl, only bindings that name it act; other keys do nothing.
TEST(ViewerKeys, WithControlOnlyWhatNamesItActs) {
    EXPECT_EQ(actionOf(GLFW_KEY_Q, false)->action, Action::light_debug);
    EXPECT_EQ(actionOf(GLFW_KEY_Q, true)->action, Action::quit);
    EXPECT_FALSE(actionOf(GLFW_KEY_W, true));
    EXPECT_FALSE(actionOf(GLFW_KEY_P, true));
}

TEST(ViewerKeys, TheHelpHasThemAll) {
    for (const KeyBinding& binding : keyBindings())
        EXPECT_NE(keyColumns().find(fmt::format("  {:<8}{}\n", binding.name, binding.does)),
                  std::string::npos);
}

TEST(ViewerKeys, TheReadmeHasTheTable) {
    const Files files = sources();
    EXPECT_NE(files.at("compare/viewer/README.md").find(keyTable()), std::string::npos) << keyTable();
}

// ---- the camera ------------------------------------------------------------------------------------------

FrameCamera cameraAt(const glm::dvec3& eye, const glm::dvec3& target) {
    FrameCamera camera;
    for (int i = 0; i < 3; ++i) {
        camera.eye[i] = eye[i];
        camera.target[i] = target[i];
    }
    camera.fov_degrees = 40;
    camera.near = 0.1;
    camera.far = std::numeric_limits<double>::infinity();
    return camera;
}

// The view that --camera makes of the words; the viewer draws it.
View viewOf(const FlyCamera& camera) {
    const Scene scene = loadScene("builtin:gallery");
    ViewRequest request;
    request.camera = camera.words();
    request.width = 64;
    request.height = 36;
    return makeSceneView(scene, request).view;
}

TEST(ViewerCamera, ItsWordsAreTheCameraThatItTookOver) {
    FlyCamera camera;
    EXPECT_FALSE(camera.canMove());
    const glm::dvec3 eye(1.25, 3.5, -7.125), target(0.5, 1, 2);
    camera.take(cameraAt(eye, target));
    ASSERT_TRUE(camera.canMove());
    const View view = viewOf(camera);
    EXPECT_LT(glm::distance(view.eye(), eye), 1e-7);
    EXPECT_LT(glm::distance(-view.backward(), glm::normalize(target - eye)), 1e-7);
    EXPECT_DOUBLE_EQ(view.camera.near, 0.1);
    EXPECT_TRUE(std::isinf(view.camera.far));
    EXPECT_NEAR(view.camera.yfov * 180 / std::numbers::pi, 40, 1e-9);
}

TEST(ViewerCamera, AnOrthographicOneHasNoWords) {
    FlyCamera camera;
    FrameCamera orthographic = cameraAt({0, 0, 1}, {0, 0, 0});
    orthographic.fov_degrees = 0;
    orthographic.ymag = 2;
    camera.take(orthographic);
    EXPECT_FALSE(camera.canMove());
}

TEST(ViewerCamera, MovesAlongItsRightTheWorldsUpAndItsView) {
    FlyCamera camera;
    camera.take(cameraAt({0, 0, 0}, {0, 0, -2}));
    camera.move({1, 2, 3});
    EXPECT_LT(glm::distance(camera.eye(), glm::dvec3(1, 2, -3)), 1e-12);
    camera.look(std::numbers::pi / 2, 0);  // right, towards +X
    EXPECT_LT(glm::distance(camera.forward(), glm::dvec3(1, 0, 0)), 1e-12);
    camera.look(0, 10);
    EXPECT_GT(camera.forward().y, 0.99) << "looks up";
    EXPECT_LT(camera.forward().y, 1.0) << "but not straight, where right has no meaning";
}

TEST(ViewerCamera, WhatItOrbitsStaysWhereItIsInThePicture) {
    FlyCamera camera;
    camera.take(cameraAt({0, 1, 5}, {0, 1, 0}));
    const glm::dvec3 pivot(0.5, 0.25, 1);
    const auto seen = [&] {
        const glm::dvec3 to = pivot - camera.eye(), up = glm::cross(camera.right(), camera.forward());
        return glm::dvec3(glm::dot(to, camera.right()), glm::dot(to, up), glm::dot(to, camera.forward()));
    };
    const glm::dvec3 before = seen(), eye = camera.eye();
    camera.orbit(pivot, 0.7, 0.3);
    EXPECT_LT(glm::distance(before, seen()), 1e-12);
    EXPECT_GT(glm::distance(eye, camera.eye()), 1);
}

// ---- the canvas ------------------------------------------------------------------------------------------

Image8 colored(int width, int height, std::uint8_t base) {
    Image8 picture{width, height, 3, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                picture.data.push_back(static_cast<std::uint8_t>(base + 7 * x + 3 * y + c));
    return picture;
}

Shown shownOf(int width, int height) {
    Shown shown;
    shown.order.subject.settings.size.width = width;
    shown.order.subject.settings.size.height = height;
    shown.size = shown.order.subject.settings.size;
    shown.panels[0].picture = colored(width, height, 0);
    shown.panels[1].picture = colored(width, height, 100);
    return shown;
}

struct Rgb8Pixel {
    int r, g, b;
    bool operator==(const Rgb8Pixel&) const = default;
};
Rgb8Pixel inCanvas(const std::vector<std::uint8_t>& pixels, int width, int x, int y) {
    const std::uint8_t* const p = pixels.data() + 4 * (y * width + x);
    return {p[0], p[1], p[2]};
}
Rgb8Pixel inPicture(const Image8& picture, int x, int y) {
    const std::uint8_t* const p = picture.data.data() + 3 * (y * picture.width + x);
    return {p[0], p[1], p[2]};
}

TEST(ViewerCanvas, TheWipesHalvesAreThePicturesPixels) {
    const Shown shown = shownOf(12, 8);
    const CanvasRect canvas{0, 30, 12, 8};
    CanvasView view;
    view.wipe = 5.0 / 12;
    const auto places = placesOf(canvas, shown.size, view, false);
    const auto pixels = composed(shown, canvas, places, false);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 12; ++x) {
            EXPECT_EQ(inCanvas(pixels, 12, x, y), inPicture(shown.panels[x < 5 ? 0 : 1].picture, x, y))
                << x << "," << y;
        }
    view.other = true;  // flicker
    const auto swapped = composed(shown, canvas, placesOf(canvas, shown.size, view, false), false);
    EXPECT_EQ(inCanvas(swapped, 12, 0, 0), inPicture(shown.panels[1].picture, 0, 0));
    EXPECT_EQ(inCanvas(swapped, 12, 11, 0), inPicture(shown.panels[0].picture, 11, 0));
}

TEST(ViewerCanvas, BlueComesFirstWhereTheWindowHasItSo) {
    const Shown shown = shownOf(2, 2);
    const CanvasRect canvas{0, 0, 2, 2};
    CanvasView view;
    view.layout = Layout::single;
    const auto pixels = composed(shown, canvas, placesOf(canvas, shown.size, view, false), true);
    const Rgb8Pixel bgr = inCanvas(pixels, 2, 1, 1), rgb = inPicture(shown.panels[1].picture, 1, 1);
    EXPECT_EQ(bgr, (Rgb8Pixel{rgb.b, rgb.g, rgb.r}));
}

// As wide or as high as its panel, whichever comes first, with the canvas's grey beside it.
TEST(ViewerCanvas, APictureFillsItsPanel) {
    const Shown shown = shownOf(10, 5);
    const CanvasRect canvas{0, 0, 37, 20};
    CanvasView view;
    view.layout = Layout::single;
    const auto places = placesOf(canvas, shown.size, view, false);
    ASSERT_EQ(places.size(), 1u);
    EXPECT_DOUBLE_EQ(places[0].placement.scale, 3.7);
    const auto pixels = composed(shown, canvas, places, false);
    const int left = static_cast<int>(places[0].placement.left),
              top = static_cast<int>(places[0].placement.top);
    EXPECT_EQ(left, 0);
    EXPECT_EQ(top, 1);
    EXPECT_EQ(inCanvas(pixels, 37, 0, 1), inPicture(shown.panels[1].picture, 0, 0));
    EXPECT_EQ(inCanvas(pixels, 37, 3, 4), inPicture(shown.panels[1].picture, 0, 0));
    EXPECT_EQ(inCanvas(pixels, 37, 4, 1), inPicture(shown.panels[1].picture, 1, 0));
    EXPECT_EQ(inCanvas(pixels, 37, 36, 18), inPicture(shown.panels[1].picture, 9, 4));
    EXPECT_EQ(inCanvas(pixels, 37, 0, 0), (Rgb8Pixel{26, 26, 28}));
    const auto under = pixelUnder(places, shown.size, 4.5, 1.5);
    ASSERT_TRUE(under);
    EXPECT_EQ(under->pixel, (PixelPlace{1, 0}));
    EXPECT_FALSE(pixelUnder(places, shown.size, 4.5, 0.5));
    // With the larger of the two factors, part of the image would be outside.
    EXPECT_DOUBLE_EQ(placesOf({0, 0, 37, 10}, shown.size, view, false)[0].placement.scale, 2);
}

TEST(ViewerCanvas, OverADifferenceTheRightPanelIsShownWhileThereIsAnother) {
    const CanvasRect canvas{0, 0, 40, 20};
    CanvasView view;
    ASSERT_EQ(placesOf(canvas, {10, 5}, view, true).size(), 1u);
    EXPECT_EQ(placesOf(canvas, {10, 5}, view, true)[0].panel, 2u);
    view.other = true;
    ASSERT_EQ(placesOf(canvas, {10, 5}, view, true).size(), 1u);
    EXPECT_EQ(placesOf(canvas, {10, 5}, view, true)[0].panel, 1u);
}

TEST(ViewerBar, ANarrowOneHasMoreRows) {
    for (const double scale : {1.0, 1.5, 2.0})
        for (const int width : {1, 100, 300, 640, 900, 1280, 4000}) {
            const auto rows = barRows(width, scale);
            double x = 0;
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const bool new_row = i == 0 || rows[i] != rows[i - 1];
                x = (new_row ? barEdge : x + barGap) + barWidths[i];
                // Each fits, or is alone in its row.
                EXPECT_TRUE(x * scale <= width || new_row) << width << " " << scale << " " << i;
                if (i > 0) {
                    EXPECT_TRUE(rows[i] == rows[i - 1] || rows[i] == rows[i - 1] + 1);
                }
            }
            InterfaceState state;
            const CanvasRect canvas = canvasOf(state, width, 600, scale);
            EXPECT_EQ(canvas.y, static_cast<int>((barHeight + barRow * rows.back()) * scale));
        }
    EXPECT_EQ(barRows(1280, 1).back(), 0);
}

TEST(ViewerCanvas, ASmallerPictureFillsTheSamePlace) {
    Shown shown = shownOf(8, 8);
    shown.panels[1].picture = colored(4, 4, 100);
    shown.size.width = shown.size.height = 4;
    const CanvasRect canvas{0, 0, 8, 8};
    CanvasView view;
    view.layout = Layout::single;
    const auto pixels =
        composed(shown, canvas, placesOf(canvas, shown.order.subject.settings.size, view, false), false);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            EXPECT_EQ(inCanvas(pixels, 8, x, y), inPicture(shown.panels[1].picture, x / 2, y / 2));
        }
}

TEST(ViewerCanvas, LargePixelsHaveALineBetweenThem) {
    const Shown shown = shownOf(4, 4);
    const CanvasRect canvas{0, 0, 40, 40};
    CanvasView view;
    view.layout = Layout::single;
    view.zoom = 10;
    view.centre_x = view.centre_y = 2;
    const auto pixels = composed(shown, canvas, placesOf(canvas, shown.size, view, false), false);
    EXPECT_EQ(inCanvas(pixels, 40, 5, 5), inPicture(shown.panels[1].picture, 0, 0));
    EXPECT_EQ(inCanvas(pixels, 40, 10, 5), (Rgb8Pixel{70, 70, 70}));
    EXPECT_EQ(inCanvas(pixels, 40, 11, 5), inPicture(shown.panels[1].picture, 1, 0));
}

TEST(ViewerCanvas, NoSizeIsTooSmall) {
    const Shown shown = shownOf(4, 4);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 50}, {3, 2}})
        for (const Layout layout : {Layout::wipe, Layout::side_by_side, Layout::single})
            for (const bool difference : {false, true}) {
                const CanvasRect canvas{0, 0, width, height};
                CanvasView view;
                view.layout = layout;
                const auto places = placesOf(canvas, shown.size, view, difference);
                EXPECT_EQ(composed(shown, canvas, places, false).size(),
                          4u * static_cast<unsigned>(width * height));
            }
}

// ---- images and differences ------------------------------------------------------------------------------

TEST(ViewerDifference, SignedIsRightLessLeftWhereItIsLargest) {
    const Frame left = flatFrame(Path::deferred, 2, 1, 0.5f);
    Frame right = flatFrame(Path::deferred, 2, 1, 0.5f);
    right.channels[lit].at(0, 0, 1) = 0.75f;   // + 0.25
    right.channels[lit].at(0, 0, 2) = 0.375f;  // - 0.125, smaller
    right.channels[lit].at(1, 0, 0) = 0.0f;    // - 0.5
    Look look;
    look.difference = Difference::signed_difference;
    const DifferencePanel panel = differenceOf(left, right, look);
    EXPECT_EQ(panel.values.at(0, 0), 0.25f);
    EXPECT_EQ(panel.values.at(1, 0), -0.5f);
    EXPECT_TRUE(panel.is_signed);
    // Blue where right is darker, orange where it is brighter.
    const std::uint8_t* const p = panel.picture.data.data();
    EXPECT_GT(p[0], p[2]);
    EXPECT_LT(p[3], p[5]);
}

TEST(ViewerDifference, AbsoluteAndRelativeAreTheMetrics) {
    const Frame left = flatFrame(Path::deferred, 1, 1, 0.5f), right = flatFrame(Path::deferred, 1, 1, 0.75f);
    Look look;
    look.difference = Difference::absolute;
    EXPECT_EQ(differenceOf(left, right, look).values.at(0, 0), 0.25f);
    look.difference = Difference::relative;
    EXPECT_EQ(differenceOf(left, right, look).values.at(0, 0), 0.5f);
}

TEST(ViewerDifference, FlipIsOfColoursAndSaysSo) {
    Frame left = flatFrame(Path::deferred, 16, 16, 0.5f), right = flatFrame(Path::deferred, 16, 16, 0.25f);
    Look look;
    look.difference = Difference::flip;
    const DifferencePanel panel = differenceOf(left, right, look);
    EXPECT_TRUE(panel.missing.empty()) << panel.missing;
    EXPECT_EQ(panel.top, 1);
    EXPECT_GT(panel.values.at(8, 8), 0.05f);
    left.channels[normals] = Image(16, 16, 3, 0.5f);
    right.channels[normals] = Image(16, 16, 3, 0.5f);
    look.mode = normals;
    EXPECT_NE(differenceOf(left, right, look).missing.find("normals"), std::string::npos);
}

TEST(ViewerDifference, WhatCannotBeComparedSaysWhy) {
    Look look;
    look.difference = Difference::absolute;
    EXPECT_NE(differenceOf(flatFrame(Path::deferred, 2, 2, 0), flatFrame(Path::deferred, 3, 2, 0), look)
                  .missing.find("2x2"),
              std::string::npos);
    look.mode = normals;
    EXPECT_NE(differenceOf(flatFrame(Path::deferred, 2, 2, 0), flatFrame(Path::deferred, 2, 2, 0), look)
                  .missing.find("normals"),
              std::string::npos);
}

// The panels equal the output of `render`.
TEST(ViewerPictures, ArePicturesOfTheChannel) {
    Frame left = flatFrame(Path::deferred, 3, 2, 0.5f), right = flatFrame(Path::deferred, 3, 2, 0.25f);
    left.channels[ids].at(2, 1) = -1;
    Look look;
    look.exposure = 2;
    Shown shown;
    const Exposure exposure = exposureOf(left, right, look);
    EXPECT_EQ(exposure.factor, 2);
    makePictures(left, right, look, exposure, shown);
    const Frame* frames[] = {&left};
    EXPECT_EQ(shown.panels[0].picture.data,
              channelPicture(debugMode(lit), left, scaleFor(debugMode(lit), exposure, frames)).data);
    EXPECT_FALSE(shown.difference);
    look.mode = normals;
    makePictures(left, right, look, exposure, shown);
    EXPECT_FALSE(shown.panels[0].missing.empty());
    EXPECT_TRUE(shown.panels[0].picture.data.empty());
}

// ---- sizes while moving ----------------------------------------------------------------------------------

Size sizeOf(int width, int height) {
    Size size;
    size.width = width;
    size.height = height;
    return size;
}

TEST(ViewerSize, APictureThatIsQuickKeepsItsSize) {
    PictureCost cost;
    EXPECT_FALSE(cost.known());
    cost.add(640 * 360, 40);
    EXPECT_EQ(movingSize(sizeOf(640, 360), 60, cost), sizeOf(640, 360));
}

TEST(ViewerSize, ASlowOneShrinksUntilItsPixelsFit) {
    PictureCost cost;
    cost.add(640 * 360, 240);
    EXPECT_EQ(movingSize(sizeOf(640, 360), 60, cost), sizeOf(320, 180));
    cost = {};
    cost.add(640 * 360, 5000);
    EXPECT_EQ(movingSize(sizeOf(640, 360), 60, cost), sizeOf(80, 45)) << "no smaller than an eighth";
    EXPECT_EQ(movingSize(sizeOf(3, 2), 60, cost), sizeOf(3, 2)) << "three pixels cost nothing";
}

// A smaller image does not reduce the cost of shadow maps and triangles.
TEST(ViewerSize, WhatDoesNotShrinkIsToldApart) {
    PictureCost cost;
    cost.add(640 * 360, 100 + 64);
    cost.add(320 * 180, 100 + 16);
    EXPECT_NEAR(cost.fixed(), 100, 1e-9);
    EXPECT_NEAR(cost.of(640 * 360), 164, 1e-9);
    EXPECT_EQ(movingSize(sizeOf(640, 360), 60, cost), sizeOf(320, 180));
}

TEST(ViewerSize, ABusyMomentIsForgotten) {
    PictureCost cost;
    for (int i = 0; i < 3; ++i) cost.add(1000, 10);
    cost.add(1000, 1000);
    EXPECT_LT(cost.of(1000), 12);
    for (int i = 0; i < 60; ++i) cost.add(1000, 100);
    EXPECT_NEAR(cost.of(1000), 100, 1e-9) << "and one that stays is learned";
}

// ---- settings --------------------------------------------------------------------------------------------

TEST(ViewerSettings, ACombinationWithoutMeaningIsShownAndNotDrawn) {
    InterfaceState state;
    state.edited = state.subject.settings;
    setOption(state, "gbuffer", "compact");
    EXPECT_EQ(state.subject.settings.gbuffer, GBufferEncoding::compact);
    EXPECT_TRUE(state.problem.empty());
    setOption(state, "evsm-exponent", "3");  // has no effect without --shadows evsm
    EXPECT_NE(state.problem.find("evsm"), std::string::npos);
    EXPECT_EQ(state.subject.settings.evsm_exponent, 0);
    EXPECT_EQ(state.edited.evsm_exponent, 3);
    setOption(state, "shadows", "evsm");
    EXPECT_TRUE(state.problem.empty()) << state.problem;
    EXPECT_EQ(state.subject.settings.evsm_exponent, 3);
    setOption(state, "msaa", "many");
    EXPECT_NE(state.problem.find("msaa"), std::string::npos);
    EXPECT_EQ(state.subject.settings.msaa, 1);
}

// The settings panel is generated from the rows: each can be set to its own text.
TEST(ViewerSettings, EveryRowCanBeSetToWhatItSays) {
    InterfaceState state;
    for (const Field& field : settingFields()) {
        const std::string option(field.option);
        setOption(state, option, state.edited.valueOf(option));
        EXPECT_TRUE(state.problem.empty()) << option << ": " << state.problem;
    }
    EXPECT_EQ(state.subject.settings, Settings());
}

TEST(ViewerSettings, SizeStopsFollowingTheWindow) {
    InterfaceState state;
    setOption(state, "size", "320x180");
    EXPECT_FALSE(state.follow);
    EXPECT_EQ(state.subject.settings.size, sizeOf(320, 180));
}

// As in the original projects: the heat map replaces the channel, which returns without it.
TEST(ViewerLook, TheHeatMapTakesPrecedenceOverTheChannel) {
    Look look;
    for (const DebugMode& mode : debugModes()) {
        look.mode = mode.number;
        look.heat = true;
        EXPECT_EQ(look.channel(), static_cast<int>(gpu::DEBUG_light_count)) << mode.name;
        look.heat = false;
        EXPECT_EQ(look.channel(), mode.number);
    }
}

// Without side panels the times have their own column; without both the images have all the width.
TEST(ViewerCanvas, TimesStandBesideThePictures) {
    InterfaceState state;
    EXPECT_EQ(canvasOf(state, 1280, 760, 1).width, 1280 - static_cast<int>(sideWidth));
    state.panels = false;
    EXPECT_EQ(canvasOf(state, 1280, 760, 1).width, 1280 - static_cast<int>(timesWidth));
    state.information = false;
    EXPECT_EQ(canvasOf(state, 1280, 760, 1).width, 1280);
}

TEST(ViewerCommands, SayTheWholeView) {
    InterfaceState state;
    state.subject.scene = "a b.glb";
    state.subject.settings.camera = "eye=1,2,3 target=0,0,0";
    state.look.mode = normals;
    EXPECT_EQ(renderCommand(state),
              "diptych render --debug normals --camera 'eye=1,2,3 target=0,0,0' 'a b.glb'");
    state.look.mode = lit;
    state.look.exposure = 0.5;
    state.look.tonemap = false;
    EXPECT_EQ(renderCommand(state),
              "diptych render --no-tonemap --exposure 0.5 --camera 'eye=1,2,3 target=0,0,0' 'a b.glb'");
    state.look.against = Against::reference;
    EXPECT_EQ(compareCommand(state),
              "diptych compare --baseline reference --camera 'eye=1,2,3 target=0,0,0' 'a b.glb'");
}

TEST(ViewerCommands, NameTheSceneThatIsDrawnAndNotOneThatCannotBeRead) {
    InterfaceState state;
    state.subject.scene = "broken.glb";
    state.loaded = "good.glb";
    EXPECT_EQ(renderCommand(state), "diptych render good.glb");
    EXPECT_EQ(compareCommand(state), "diptych compare good.glb");
}

TEST(ViewerValues, AreToldToTheLastDigit) {
    Image image(2, 1, 3);
    image.at(1, 0, 0) = 0.1f;
    image.at(1, 0, 1) = std::nextafter(0.1f, 1.0f);
    image.at(1, 0, 2) = 1e-30f;
    const std::string words = valueWords(image, 1, 0);
    std::istringstream stream(words);
    for (int c = 0; c < 3; ++c) {
        float value = 0;
        stream >> value;
        EXPECT_EQ(value, image.at(1, 0, c)) << words;
    }
    EXPECT_EQ(valueWords(image, 2, 0), "");
}

// ---- watched files ---------------------------------------------------------------------------------------

TEST(ViewerWatch, TellsOnceThatAFileHasSettledAfterAChange) {
    const std::filesystem::path here = folder();
    const auto write = [&](const char* name, const char* text) {
        std::ofstream(here / name) << text;
        return here / name;
    };
    const auto later = [](const std::filesystem::path& file, int seconds) {
        std::filesystem::last_write_time(
            file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(seconds));
    };
    const auto scene = write("a.gltf", R"({"buffers": [{"uri": "a.bin"}], "images": [{"uri": "data:x"}]})");
    const auto buffer = write("a.bin", "x");
    SceneWatch watch;
    watch.watch(scene.string(), {});
    EXPECT_EQ(watch.files(), (std::vector{scene, buffer}));
    EXPECT_FALSE(watch.changed());
    later(buffer, 10);
    EXPECT_FALSE(watch.changed()) << "it may still be written";
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
    std::filesystem::remove(scene);  // like programs that write a new file and rename it
    EXPECT_FALSE(watch.changed());
    watch.watch("builtin:gallery", {});
    EXPECT_TRUE(watch.files().empty());
    EXPECT_FALSE(watch.changed());
}

}  // namespace
}  // namespace diptych::viewer
