// SPDX-License-Identifier: MIT
// Notes about shadows: each with a scene that causes it and the nearest that does not.
#include "shared/contract/debug_mode.h"
#include "tests/image/shadow_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

namespace diptych::tests {
namespace {

Frame smallFrame(const Scene& scene, const Settings& settings) {
    Renderer renderer(device(), scene, pipelines());
    return renderer.draw(settings,
                         untimed({Channel::shadow_visibility, Channel::depth, Channel::material_id}));
}

Settings mapsBy(Shadows shadows) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.shadows = shadows;
    settings.shadow_size = 256;
    return settings;
}

// The note that contains `words`.
std::optional<std::string> noteOf(const Frame& frame, const std::string& words) {
    const auto found = std::ranges::find_if(
        frame.notes, [&](const std::string& note) { return note.find(words) != std::string::npos; });
    return found == frame.notes.end() ? std::nullopt : std::optional(*found);
}

// Ground, and a board 1 m high, under a sun at the zenith: casters are 1 m deep along the light.
Scene boardAtNoon(float angle = 0) {
    Scene scene = groundUnder(sunAlong({0, -1, 0}, 3), {board(1)});
    scene.lights.front().angle = angle;
    return scene;
}

Light lampAt(const glm::dvec3& position) {
    Light light;
    light.kind = LightKind::point;
    light.position = position;
    light.intensity = 5;
    return light;
}

TEST(ShadowNotes, CascadesThatContainNothingVisibleAreCounted) {
    const std::string words = "cascades are drawn";
    EXPECT_EQ(noteOf(smallFrame(loadScene("builtin:spheres"), mapsBy(Shadows::pcf)), words), std::nullopt);
    // From 0.1 m; the ground is farther than 5 m.
    EXPECT_EQ(noteOf(smallFrame(boardAtNoon(), mapsBy(Shadows::pcf)), words),
              "shadow maps: 2 of 4 cascades are drawn; the others contain nothing visible");
}

TEST(ShadowNotes, NoCaster) {
    const std::string words = "nothing casts a shadow";
    Scene scene = boardAtNoon();
    EXPECT_EQ(noteOf(smallFrame(scene, mapsBy(Shadows::pcf)), words), std::nullopt);
    for (Material& material : scene.materials) material.alpha_mode = AlphaMode::blend;
    EXPECT_EQ(noteOf(smallFrame(scene, mapsBy(Shadows::pcf)), words),
              "shadow maps: none is drawn; nothing casts a shadow");
}

TEST(ShadowNotes, CascadesFittedToTheVisibleDepths) {
    Settings settings = mapsBy(Shadows::pcf);
    const std::string words = "--shadow-fit depth: ";
    EXPECT_EQ(noteOf(smallFrame(boardAtNoon(), settings), words), std::nullopt);
    settings.shadow_fit = ShadowFit::depth;
    const Frame frame = smallFrame(boardAtNoon(), settings);
    double nearest = INFINITY, farthest = 0, said_nearest = 0, said_farthest = 0;
    for (std::size_t i = 0; i < frame.channels.at(Channel::depth).pixels(); ++i) {
        if (*frame.channels.at(Channel::material_id).pixel(i) < 0) continue;
        const double depth = *frame.channels.at(Channel::depth).pixel(i);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const std::string note = noteOf(frame, words).value_or("");
    ASSERT_EQ(
        std::sscanf(note.c_str(), "--shadow-fit depth: cascades cover the visible depths, %lf to %lf m;",
                    &said_nearest, &said_farthest),
        2)
        << note;
    // The note has six digits.
    EXPECT_NEAR(said_nearest, nearest, 1e-5 * nearest);
    EXPECT_NEAR(said_farthest, farthest, 1e-5 * farthest);

    // A slope whose bounding box is in view: the camera is in it, below the slope.
    Scene away = groundUnder(sunAlong({0, -1, 0}, 3));
    away.meshes.front().primitives = {rectangle({-4, -4, 4}, {8, 8, 0}, {0, 0, -8})};
    away.cameras.front().world_from_camera =
        glm::inverse(glm::lookAt(glm::dvec3(2, -3, 0), glm::dvec3(4, -4, 0), {0, 1, 0}));
    EXPECT_EQ(noteOf(smallFrame(away, settings), words),
              "--shadow-fit depth: the image is empty, so cascades cover the whole view");
}

TEST(ShadowNotes, PenumbrasThatAreLimited) {
    const std::string words = "penumbras are limited";
    EXPECT_EQ(noteOf(smallFrame(boardAtNoon(0.01f), mapsBy(Shadows::pcss)), words), std::nullopt);
    const std::string note = noteOf(smallFrame(boardAtNoon(2), mapsBy(Shadows::pcss)), words).value_or("");
    int texels = 0;
    double drawn_width = 0, width = 0;
    ASSERT_EQ(std::sscanf(note.c_str(),
                          "--shadows pcss: penumbras are limited to %d texels (%lf m in the first cascade); "
                          "the sun's disc can cause %lf m here",
                          &texels, &drawn_width, &width),
              3)
        << note;
    // The caster is 1 m away; the note has three digits.
    EXPECT_NEAR(width, 2 * std::tan(1.0), 6e-3);
    EXPECT_LT(drawn_width, width);
    // The map's 256 texels cover the ground's 8 m and, on both sides, the filter.
    EXPECT_GT(drawn_width / texels, 8.0 / 256);
    EXPECT_LT(drawn_width / texels, 8.0 / (256 - 4 * texels));
}

TEST(ShadowNotes, ExponentsOfExponentialMaps) {
    const std::string words = "negative exponent";
    EXPECT_EQ(noteOf(smallFrame(boardAtNoon(), mapsBy(Shadows::evsm)), words), std::nullopt);
    EXPECT_EQ(noteOf(smallFrame(boardAtNoon(), mapsBy(Shadows::evsm4)), words),
              "--shadows evsm4: exponent 40, negative exponent 5, in 32-bit floats");
}

TEST(ShadowNotes, LampsWithoutAShadow) {
    const std::string words = "no shadow (";
    Scene scene = boardAtNoon();
    scene.lights = {lampAt({1, 2, 0})};
    Settings settings = mapsBy(Shadows::pcf);
    const auto noteWith = [&](int casting) {
        settings.shadow_lights = casting;
        return noteOf(smallFrame(scene, settings), words);
    };
    EXPECT_EQ(noteWith(1), std::nullopt);
    EXPECT_EQ(noteWith(0),
              "1 point or spot light casts no shadow (--shadow-lights N enables the N brightest)");
    scene.lights.push_back(lampAt({-1, 2, 0}));
    EXPECT_EQ(noteWith(0),
              "2 point or spot lights cast no shadow (--shadow-lights N enables the N brightest)");
}

TEST(ShadowNotes, PagesOfAClipmap) {
    const std::string words = "shadow pages: ";
    EXPECT_EQ(noteOf(smallFrame(boardAtNoon(), mapsBy(Shadows::pcf)), words), std::nullopt);
    const Frame frame = smallFrame(boardAtNoon(), mapsBy(Shadows::clipmap));
    unsigned long long requested = 0, resident = 0, fallback = 0, cold = 0, all = 0;
    const std::string note = noteOf(frame, words).value_or("");
    ASSERT_EQ(
        std::sscanf(note.c_str(),
                    "shadow pages: requested %llu, resident %llu, replaced by a coarser level %llu; drawn "
                    "once, before the first frame: %llu of %llu",
                    &requested, &resident, &fallback, &cold, &all),
        5)
        << note;
    const ShadowPages& pages = frame.counters.shadow_pages;
    EXPECT_EQ(requested, pages.requested);
    EXPECT_EQ(resident, pages.resident);
    EXPECT_EQ(fallback, pages.fallback);
    EXPECT_EQ(cold, pages.drawn);
    EXPECT_EQ(all, requested + 1) << "and the page of the whole scene";
}

}  // namespace
}  // namespace diptych::tests
