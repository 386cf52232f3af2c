// SPDX-License-Identifier: MIT
// The sun's shadow: equal bits in both paths, comparison with the reference's rays, and planes with known
// results.
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/shadow_scenes.h"

#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace diptych::tests {
namespace {

Settings shadowed(const Settings& settings, int size = 2048, int kernel = 3) {
    Settings result = settings;
    result.shadows = Shadows::pcf;
    result.shadow_size = size;
    result.shadow_kernel = kernel;
    return result;
}

Frame drawn(const Scene& scene, const Settings& settings,
            const std::vector<Channel>& channels = {Channel::shadow_visibility, Channel::cascade,
                                                    Channel::depth, Channel::material_id}) {
    return drawAll(scene, {settings}, untimed(channels)).front();
}

// Minimum and maximum visibility over the covered pixels that a predicate of position accepts.
struct Seen {
    float min = 1, max = 0;
    int pixels = 0;
};
template <class Where>
Seen seenWhere(const Frame& frame, const Where& where) {
    Seen seen;
    const Image& image = frame.channels.at(Channel::shadow_visibility);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (frame.channels.at(Channel::material_id).at(x, y) < 0 || !where(x, y)) continue;
            seen.min = std::min(seen.min, image.at(x, y));
            seen.max = std::max(seen.max, image.at(x, y));
            ++seen.pixels;
        }
    return seen;
}

class ShadowPaths : public testing::TestWithParam<std::string> {};

TEST_P(ShadowPaths, SeeTheSame) {
    // All pairs would compile twice the pipelines, most of them for the gallery's many materials.
    const std::pair<GBufferEncoding, int> kernels[] = {
        {GBufferEncoding::compact, 1}, {GBufferEncoding::standard, 5}, {GBufferEncoding::full, 7}};
    const std::size_t first = GetParam() == "builtin:gallery" ? 2 : 0;
    for (const auto& [encoding, kernel] : std::span(kernels).subspan(first)) {
        const Settings settings = shadowed(smallImage(encoding), 256, kernel);
        const std::vector<Frame> frames =
            bothPaths(uploaded(GetParam()).renderer, settings,
                      {Channel::shadow_visibility, Channel::cascade, Channel::lit});
        for (const Frame& frame : frames) EXPECT_EQ(frame.counters.unreproduced_pixels, 0u);
        for (const Channel mode : {Channel::shadow_visibility, Channel::cascade})
            EXPECT_EQ(differingPixels(frames[0], frames[1], mode), 0u)
                << debugMode(mode).name << " " << kernel;
    }
}

// A path's image against rays: outside the filter's radius and a texel from an edge, visibility is
// correct. At most one pixel in 2,000 is falsely lit, and as many falsely dark.
TEST_P(ShadowPaths, AreTheReferencesAwayFromEdges) {
    Settings settings = shadowed(smallImage(GBufferEncoding::full));
    settings.size = {320, 180};
    Settings truth = settings;
    truth.path = Path::reference;
    Renderer& renderer = uploaded(GetParam()).renderer;
    const RenderOptions options = untimed({Channel::shadow_visibility, Channel::depth, Channel::material_id});
    const Frame path = renderer.draw(settings, options), reference = renderer.draw(truth, options);
    ASSERT_FALSE(reference.shadow_edge.empty());
    std::size_t covered = 0, near = 0, falseLit = 0, falseDark = 0;
    for (std::size_t i = 0; i < path.channels.at(Channel::shadow_visibility).pixels(); ++i) {
        if (*path.channels.at(Channel::material_id).pixel(i) < 0) continue;
        ++covered;
        const double z{*path.channels.at(Channel::depth).pixel(i)};
        const auto filter = std::ranges::find_if(path.shadow_filter_radii,
                                                 [&](const ShadowFilterRadius& r) { return z <= r.depth; });
        ASSERT_NE(filter, path.shadow_filter_radii.end());
        const float* const edge = reference.shadow_edge.pixel(i);
        const float seen = *path.channels.at(Channel::shadow_visibility).pixel(i),
                    is = *reference.channels.at(Channel::shadow_visibility).pixel(i);
        if (double{edge[0]} <= filter->radius) {
            ++near;
            continue;
        }
        falseLit += seen > is;
        falseDark += seen < is;
    }
    EXPECT_LE(static_cast<double>(falseLit), 5e-4 * static_cast<double>(covered))
        << covered << ", near " << near;
    EXPECT_LE(static_cast<double>(falseDark), 5e-4 * static_cast<double>(covered))
        << covered << ", near " << near;
    RecordProperty("false_lit", static_cast<int>(falseLit));
    RecordProperty("false_dark", static_cast<int>(falseDark));
    RecordProperty("near_edges", static_cast<int>(near));
    RecordProperty("covered", static_cast<int>(covered));
}

INSTANTIATE_TEST_SUITE_P(Builtin, ShadowPaths,
                         testing::Values("builtin:gallery", "builtin:spheres", "builtin:suns",
                                         "builtin:ortho", "builtin:cutout", "builtin:deep",
                                         "builtin:far_away"),
                         sceneName);

// A plane never shadows itself at any grazing angle, with any filter.
TEST(ShadowPlane, IsFullyLitAtEveryAngle) {
    for (const double degrees : {0.1, 0.3, 1.0, 3.0, 10.0, 20.0, 35.0, 50.0, 70.0, 89.0, 89.9})
        for (const int kernel : {1, 3, 5, 7}) {
            Settings settings = shadowed(smallImage(GBufferEncoding::standard), 512, kernel);
            settings.shadow_cascades = 2;
            const Seen seen =
                seenWhere(drawn(groundUnder(sunAt(degrees)), settings), [](int, int) { return true; });
            EXPECT_EQ(seen.min, 1) << degrees << " " << kernel;
            EXPECT_GT(seen.pixels, 5000);
        }
}

TEST(ShadowPlane, IsDarkWhereTheSunIsBelowIt) {
    const Frame frame = drawn(groundUnder(sunAt(-20)), shadowed(smallImage(GBufferEncoding::standard)));
    EXPECT_EQ(seenWhere(frame, [](int, int) { return true; }).max, 0);
}

// Scenes of any size, also with the sun at the zenith.
TEST(ShadowPlane, IsFullyLitAtEveryScale) {
    for (const double scale : {1e-3, 1.0, 1e4})
        for (const double degrees : {5.0, 45.0, 90.0}) {
            const Seen seen = seenWhere(drawn(groundUnder(sunAt(degrees), {}, scale),
                                              shadowed(smallImage(GBufferEncoding::standard))),
                                        [](int, int) { return true; });
            EXPECT_EQ(seen.min, 1) << scale << " " << degrees;
        }
}

// The board's shadow is on the side away from the sun, without a gap at its foot, and not on the other
// side. It covers 1 / tan(degrees) of ground.
TEST(ShadowContact, BeginsAtTheFootAndEndsAtTheTop) {
    for (const double degrees : {20.0, 45.0, 70.0}) {
        Settings settings = shadowed(smallImage(GBufferEncoding::standard));
        settings.size = {320, 180};
        const Scene scene = groundUnder(sunAt(degrees), {board(1)});
        const Frame frame =
            drawn(scene, settings,
                  {Channel::shadow_visibility, Channel::depth, Channel::material_id, Channel::position});
        const Image& position = frame.channels.at(Channel::position);
        const double length = std::cos(0.3) / std::tan(degrees * std::numbers::pi / 180);
        // A texel covers about 6 mm of ground; the filter's radius is three.
        const double gap = 0.03;
        const auto onGround = [&](double from, double to) {
            return [&, from, to](int x, int y) {
                const double at = double{position.at(x, y, 0)} + 0.4, z = double{position.at(x, y, 2)} + 2.5;
                return frame.channels.at(Channel::material_id).at(x, y) == 0 && at > from && at < to &&
                       std::abs(z) < 1.5;
            };
        };
        const Seen shadow =
            seenWhere(frame, onGround(-length + gap / std::sin(degrees * std::numbers::pi / 180), -gap));
        EXPECT_EQ(shadow.max, 0) << degrees;
        EXPECT_GT(shadow.pixels, 50) << degrees;
        const Seen open = seenWhere(frame, onGround(gap, 3));
        EXPECT_EQ(open.min, 1) << degrees;
        EXPECT_GT(open.pixels, 50) << degrees;
        const Seen beyond =
            seenWhere(frame, onGround(-3.5, -length - gap / std::sin(degrees * std::numbers::pi / 180)));
        EXPECT_EQ(beyond.min, 1) << degrees;
    }
}

// The sun shines through holes of an alpha mask; blended surfaces cast nothing.
TEST(ShadowCasters, FollowTheirAlphaMode) {
    const auto darkest = [](AlphaMode mode, float alpha) {
        Scene scene = groundUnder(sunAt(45), {board(1)});
        scene.materials[1].alpha_mode = mode;
        scene.materials[1].base_color.a = alpha;
        Settings settings = shadowed(smallImage(GBufferEncoding::standard));
        const Frame frame = drawn(scene, settings);
        return seenWhere(frame,
                         [&](int x, int y) { return frame.channels.at(Channel::material_id).at(x, y) == 0; })
            .min;
    };
    EXPECT_EQ(darkest(AlphaMode::opaque, 0.3f), 0);
    EXPECT_EQ(darkest(AlphaMode::mask, 1.0f), 0);
    EXPECT_EQ(darkest(AlphaMode::mask, 0.3f), 1);
    EXPECT_EQ(darkest(AlphaMode::blend, 1.0f), 1);
}

// With per-object lights and no per-pixel lights, the casting sun is still shaded per pixel, with its
// shadow.
TEST(ShadowCasters, AreShadedPerPixelWithLightsByObject) {
    const Scene scene = groundUnder(sunAt(45), {board(1)});
    Settings settings = shadowed(smallImage(GBufferEncoding::full));
    settings.assign = Assignment::every;
    const Frame every = drawn(scene, settings, {Channel::lit, Channel::material_id});
    settings.assign = Assignment::per_object;
    settings.pixel_lights = 0;
    const Frame objects = drawn(scene, settings, {Channel::lit, Channel::material_id});
    EXPECT_EQ(differingPixels(every, objects, Channel::lit), 0u);
    const Image& image = every.channels.at(Channel::lit);
    std::size_t dark = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
        dark += *every.channels.at(Channel::material_id).pixel(i) == 0 && *image.pixel(i) == 0;
    EXPECT_GT(dark, 500u) << "of the ground";
}

// The brightest of several suns casts. Without a sun there is no shadow and no pass.
TEST(ShadowCasters, AreOfTheBrightestSun) {
    Scene scene = groundUnder(sunAt(45), {board(1)});
    const Settings settings = shadowed(smallImage(GBufferEncoding::standard));
    const Frame alone = drawn(scene, settings);
    Light weak = sunAt(-90);
    weak.direction = {0, -1, 0};
    weak.intensity = 2;
    scene.lights.insert(scene.lights.begin(), weak);
    const Frame both = drawn(scene, settings);
    EXPECT_EQ(differingPixels(alone, both, Channel::shadow_visibility), 0u);
    scene.lights.clear();
    Light lamp;
    lamp.position = {0, 2, 0};
    scene.lights.push_back(lamp);
    const Frame none = drawn(scene, settings);
    EXPECT_EQ(seenWhere(none, [](int, int) { return true; }).min, 1);
    EXPECT_TRUE(none.shadow_filter_radii.empty());
}

// A camera that sees the ground from 1.5 to 4 m renders no cascades nearer or farther. Without casters no
// cascade is rendered; surfaces facing away from the sun are dark all the same.
TEST(ShadowMapsOfNothing, AreNotDrawn) {
    const auto says = [](const Frame& frame, const std::string& text) {
        return std::ranges::any_of(frame.notes,
                                   [&](const std::string& note) { return note.find(text) != note.npos; });
    };
    const auto passes = [](const Scene& scene, const Settings& settings) {
        Renderer renderer(device(), scene, pipelines());
        SceneViews views(scene);
        SharedResources shared(device(), scene, pipelines());
        const PreparedFrame frame(device(), shared, views.at(viewRequest(settings)), settings);
        const std::vector<std::string> names = frame.passes.names();
        return std::ranges::count(names, "shadow maps");
    };
    Scene scene = groundUnder(sunAt(45), {board(1)});
    Settings settings = shadowed(smallImage(GBufferEncoding::full));
    settings.shadow_distance = 400;
    EXPECT_TRUE(says(drawn(scene, settings), "shadow maps: 1 of 4 cascades"));
    EXPECT_EQ(passes(scene, settings), 1);
    for (Material& material : scene.materials) material.alpha_mode = AlphaMode::blend;
    const auto ground = [](const Frame& frame) {
        return seenWhere(frame,
                         [&](int x, int y) { return frame.channels.at(Channel::material_id).at(x, y) == 0; });
    };
    const Frame open = drawn(scene, settings);
    EXPECT_TRUE(says(open, "nothing casts"));
    EXPECT_EQ(passes(scene, settings), 0);
    EXPECT_EQ(ground(open).min, 1);
    scene.lights[0] = sunAt(-20);
    EXPECT_EQ(ground(drawn(scene, settings)).max, 0);
}

}  // namespace
}  // namespace diptych::tests
