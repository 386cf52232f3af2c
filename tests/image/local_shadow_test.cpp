// SPDX-License-Identifier: MIT
// Shadows of point and spot lights: equal bits in both paths and with every assignment, comparison with
// the reference's rays, and planes with known results.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/local_shadow_scenes.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace diptych::tests {
namespace {

Settings locally(const Settings& settings, int lights, int size = 1024, int kernel = 3) {
    Settings result = settings;
    result.shadows = Shadows::pcf;
    result.shadow_lights = lights;
    result.shadow_size = size;
    result.shadow_kernel = kernel;
    return result;
}

Frame drawnOf(const Scene& scene, const Settings& settings,
              const std::vector<Channel>& channels = {Channel::local_visibility, Channel::material_id}) {
    return drawAll(scene, {settings}, untimed(channels)).front();
}

// Minimum and maximum local visibility of the pixels of one material.
struct LocallySeen {
    float min = 1, max = 0;
    int pixels = 0;
};
LocallySeen locallySeen(const Frame& frame, int material = 0) {
    LocallySeen seen;
    for (std::size_t i = 0; i < frame.channels.at(Channel::local_visibility).pixels(); ++i) {
        if (*frame.channels.at(Channel::material_id).pixel(i) != static_cast<float>(material)) continue;
        const float visibility = *frame.channels.at(Channel::local_visibility).pixel(i);
        seen.min = std::min(seen.min, visibility);
        seen.max = std::max(seen.max, visibility);
        ++seen.pixels;
    }
    return seen;
}

bool says(const Frame& frame, const std::string& text) {
    return std::ranges::any_of(frame.notes,
                               [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

struct LocalScene {
    const char* name;
    Scene (*make)();
    int lights;
    double wrong = 5e-4;  // fraction of the pixels
};
std::ostream& operator<<(std::ostream& out, const LocalScene& scene) {
    return out << scene.name;
}

class LocalShadowPaths : public testing::TestWithParam<LocalScene> {};

TEST_P(LocalShadowPaths, SeeTheSame) {
    const Scene scene = GetParam().make();
    Renderer renderer(device(), scene, pipelines());
    for (const GBufferEncoding encoding :
         {GBufferEncoding::compact, GBufferEncoding::standard, GBufferEncoding::full})
        for (const int kernel : {1, 7}) {
            const Settings settings = locally(smallImage(encoding), GetParam().lights, 512, kernel);
            const std::vector<Frame> frames =
                bothPaths(renderer, settings, {Channel::local_visibility, Channel::lit});
            EXPECT_EQ(differingPixels(frames[0], frames[1], Channel::local_visibility), 0u) << kernel;
            if (encoding == GBufferEncoding::full) {
                EXPECT_EQ(differingPixels(frames[0], frames[1], Channel::lit), 0u) << kernel;
            } else {
                EXPECT_EQ(differingPixels(frames[0].channels.at(Channel::lit),
                                          frames[1].through_gbuffer.at(Channel::lit)),
                          0u)
                    << kernel;
            }
        }
}

// Against rays: outside the filter's radius and a texel from an edge, visibility is correct. At most one
// pixel in 2,000 is falsely lit, and as many falsely dark (one in 1,000 with three lights).
TEST_P(LocalShadowPaths, AreTheReferencesAwayFromEdges) {
    const Scene scene = GetParam().make();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = locally(smallImage(GBufferEncoding::full), GetParam().lights, 2048);
    settings.size = {320, 180};
    Settings truth = settings;
    truth.path = Path::reference;
    const RenderOptions options = untimed({Channel::local_visibility, Channel::material_id});
    const Frame path = renderer.draw(settings, options), reference = renderer.draw(truth, options);
    ASSERT_FALSE(reference.local_shadow_edge.empty());
    ASSERT_GT(path.local_shadow_filter_radius, 0);
    // From the filter's centre to a corner, plus a texel. The path's own bound also includes the bias.
    const double radius = path.local_shadow_filter_radius * (3 * std::numbers::sqrt2 / 2 + 1) /
                          marginOf(AtlasRequest{.kernel = 3, .bias = double{settings.shadow_bias}});
    std::size_t covered = 0, near = 0, falseLit = 0, falseDark = 0;
    for (std::size_t i = 0; i < path.channels.at(Channel::local_visibility).pixels(); ++i) {
        if (*path.channels.at(Channel::material_id).pixel(i) < 0) continue;
        ++covered;
        const float seen = *path.channels.at(Channel::local_visibility).pixel(i),
                    is = *reference.channels.at(Channel::local_visibility).pixel(i);
        if (double{*reference.local_shadow_edge.pixel(i)} <= radius) {
            ++near;
            continue;
        }
        falseLit += seen > is + 1e-4f;
        falseDark += seen < is - 1e-4f;
    }
    EXPECT_LE(static_cast<double>(falseLit), GetParam().wrong * static_cast<double>(covered))
        << covered << ", near " << near;
    EXPECT_LE(static_cast<double>(falseDark), GetParam().wrong * static_cast<double>(covered))
        << covered << ", near " << near;
    EXPECT_LT(near, covered / 2) << "or next to nothing is compared";
    EXPECT_LT(locallySeen(path).min, 0.1f) << "something is in shadow";
    RecordProperty("false_lit", static_cast<int>(falseLit));
    RecordProperty("false_dark", static_cast<int>(falseDark));
    RecordProperty("near_edges", static_cast<int>(near));
    RecordProperty("covered", static_cast<int>(covered));
}

INSTANTIATE_TEST_SUITE_P(
    Builtin, LocalShadowPaths,
    testing::Values(LocalScene{"lamp", lampInARoom, 1}, LocalScene{"spot", spotOverTheGround, 1},
                    LocalScene{"wide_spot", wideSpotOverTheGround, 1},
                    // Three lights. One grazes the floor: the bias moves its lookups by up to two texels.
                    LocalScene{"points", [] { return loadScene("builtin:points"); }, 3, 1e-3},
                    LocalScene{"spots", [] { return loadScene("builtin:spots"); }, 4}),
    [](const auto& row) { return std::string(row.param.name); });

// A plane never shadows itself at any grazing angle, with any filter or tile size.
TEST(LocalShadowPlane, IsFullyLitAtEveryAngle) {
    for (const double height : {0.02, 0.1, 0.5, 2.0, 7.0})
        for (const bool spot : {false, true})
            for (const int size : {64, 1024})
                for (const int kernel : {1, 7}) {
                    const Scene scene = ground({spot ? castingSpot({1, height, 0.7}, {0.9, 0, 0.6}, 75)
                                                     : castingPoint({1, height, 0.7})});
                    const Frame frame =
                        drawnOf(scene, locally(smallImage(GBufferEncoding::standard), 1, size, kernel));
                    const LocallySeen seen = locallySeen(frame);
                    EXPECT_EQ(seen.min, 1) << height << " " << spot << " " << size << " " << kernel;
                    EXPECT_GT(seen.pixels, 5000);
                }
}

TEST(LocalShadowPlane, IsFullyLitAtEveryScaleAndDarkFromBelow) {
    for (const double scale : {1e-3, 1.0, 1e4}) {
        const Settings settings = locally(smallImage(GBufferEncoding::standard), 1);
        EXPECT_EQ(locallySeen(drawnOf(ground({castingPoint({1, 1.5, 0.7})}, {}, scale), settings)).min, 1)
            << scale;
        EXPECT_EQ(locallySeen(drawnOf(ground({castingPoint({1, -1.5, 0.7})}, {}, scale), settings)).max, 0)
            << scale;
    }
}

// The upright board at the ground's centre is 1 m high; the lamp is 2 m to its right and 2 m high. The
// board's shadow begins at its foot and ends 2 m behind it.
TEST(LocalShadowContact, BeginsAtTheFootAndEndsAtTheTop) {
    for (const double scale : {1e-3, 1.0, 1e4})
        for (const Light& light : {castingPoint({2, 2, 0}), castingSpot({2, 2, 0}, {-1, 0, 0}, 44)}) {
            const Scene scene = ground({light}, {board(1)}, scale);
            Settings settings = locally(smallImage(GBufferEncoding::standard), 1, 2048);
            settings.size = {320, 180};
            const Frame frame = drawnOf(scene, settings,
                                        {Channel::local_visibility, Channel::material_id, Channel::position});
            // A texel of a point light's tile is 8 mm at the foot. At the shadow's end it is 16 mm of
            // height, twice that on the ground. The filter radius is two texels, and the bias up to one
            // and a half.
            const double gap = 0.06, end = 0.12;
            const glm::dvec3 eye(0.4, 6, 2.5);
            int dark = 0, open = 0;
            for (int y = 0; y < 180; ++y)
                for (int x = 0; x < 320; ++x) {
                    if (frame.channels.at(Channel::material_id).at(x, y) != 0) continue;
                    const Image& at = frame.channels.at(Channel::position);
                    const double px = double{at.at(x, y, 0)} / scale + eye.x,
                                 pz = double{at.at(x, y, 2)} / scale + eye.z;
                    if (std::abs(pz) > 0.8) continue;
                    const float seen = frame.channels.at(Channel::local_visibility).at(x, y);
                    if (px < -gap && px > -2 + end) {
                        EXPECT_EQ(seen, 0) << px << " " << pz << " " << scale;
                        ++dark;
                    } else if ((px > gap && px < 2.5) || (px < -2 - end && px > -2.4)) {
                        EXPECT_EQ(seen, 1) << px << " " << pz << " " << scale;
                        ++open;
                    }
                }
            EXPECT_GT(dark, 200);
            EXPECT_GT(open, 200);
        }
}

// Light passes through holes of an alpha mask; blended surfaces cast nothing.
TEST(LocalShadowCasters, FollowTheirAlphaMode) {
    const auto darkest = [](AlphaMode mode, float alpha) {
        Scene scene = ground({castingPoint({2, 2, 0})}, {board(1)});
        scene.materials[1].alpha_mode = mode;
        scene.materials[1].base_color.a = alpha;
        return locallySeen(drawnOf(scene, locally(smallImage(GBufferEncoding::standard), 1))).min;
    };
    EXPECT_EQ(darkest(AlphaMode::opaque, 0.3f), 0);
    EXPECT_EQ(darkest(AlphaMode::mask, 1.0f), 0);
    EXPECT_EQ(darkest(AlphaMode::mask, 0.3f), 1);
    EXPECT_EQ(darkest(AlphaMode::blend, 1.0f), 1);
    // Without a caster no pass is added, and surfaces facing away from the light are unaffected.
    Scene scene = ground({castingPoint({2, 2, 0})}, {board(1)});
    for (Material& material : scene.materials) material.alpha_mode = AlphaMode::blend;
    const Settings settings = locally(smallImage(GBufferEncoding::standard), 1);
    const Frame frame = drawnOf(scene, settings);
    EXPECT_TRUE(says(frame, "shadows of 1 local light: no tile is drawn; "));
    EXPECT_TRUE(says(frame, "without a tile: no caster"));
    EXPECT_EQ(locallySeen(frame).min, 1);
    EXPECT_EQ(frame.local_shadow_filter_radius, 0);
    for (Light& light : scene.lights) light.position.y = -2;
    EXPECT_EQ(locallySeen(drawnOf(scene, settings)).max, 0);
}

// If no light requests shadows, nothing is rendered and no bit changes. A light that requests one casts
// whatever --shadow-lights says. The sun's shadow is independent.
TEST(LocalShadowCasters, AreThoseThatAsk) {
    Scene scene = ground({castingPoint({2, 2, 0}), castingPoint({-2, 1, 0})}, {board(1)});
    Settings off = smallImage(GBufferEncoding::standard), none = locally(off, 0), one = locally(off, 1);
    const std::vector<Channel> channels{Channel::local_visibility, Channel::material_id, Channel::lit};
    const Frame without = drawnOf(scene, off, channels), asked = drawnOf(scene, none, channels);
    EXPECT_EQ(differingPixels(without, asked, Channel::lit), 0u);
    EXPECT_EQ(locallySeen(asked).min, 1);
    EXPECT_EQ(asked.local_shadow_filter_radius, 0);
    EXPECT_TRUE(says(asked, "2 point or spot lights cast no shadow")) << "and it is said";
    EXPECT_FALSE(says(without, "no shadow"));
    const Frame brightest = drawnOf(scene, one, channels);
    EXPECT_LT(locallySeen(brightest).min, 1);
    EXPECT_TRUE(says(brightest, "shadows of 1 local light: "));
    scene.lights[0].shadow = true;
    const Frame itself = drawnOf(scene, none, channels);
    EXPECT_EQ(differingPixels(itself, brightest, Channel::lit), 0u);
    EXPECT_EQ(locallySeen(drawnOf(scene, off, channels)).min, 1) << "--shadows off";
}

// Each tile renders the objects within it, up to the light's range.
TEST(LocalShadowCasters, AreChosenForEachTile) {
    std::vector<Primitive> standing;
    addBox(standing, {0.9f, 0.4f, -0.1f}, {1.1f, 0.6f, 0.1f}, 1);  // six sides beside the lamp
    addBox(standing, {-3.2f, 0.9f, -0.1f}, {-3.0f, 1.1f, 0.1f}, 1);
    Light light = castingSpot({2, 0.5, 0}, {0, 0.5, 0}, 20);
    const Settings settings = locally(smallImage(GBufferEncoding::standard), 1);
    EXPECT_TRUE(says(drawnOf(ground({light}, standing), settings), "13 draws, "));
    light.range = 3;
    EXPECT_TRUE(says(drawnOf(ground({light}, standing), settings), "7 draws, ")) << "and the ground";
    light.direction = {0, 0, 1};
    EXPECT_TRUE(says(drawnOf(ground({light}, standing), settings), "1 draw, "));
}

// More lights than the atlas has capacity for: the surplus is counted and lit without shadows, also in the
// reference.
TEST(LocalShadowCasters, BeyondTheAtlasAreCounted) {
    std::vector<Light> lamps(50, castingPoint({2, 2, 0}));
    for (std::size_t i = 0; i < lamps.size(); ++i) lamps[i].intensity = 100.0f - static_cast<float>(i);
    const Frame frame =
        drawnOf(ground(lamps, {board(1)}), locally(smallImage(GBufferEncoding::standard), 45));
    EXPECT_TRUE(says(frame, "shadows of 42 local lights: ")) << "256 / 6";
    EXPECT_TRUE(says(frame, "8 point or spot lights cast no shadow"));
    EXPECT_TRUE(says(frame, "3 of them should cast one, but the atlas is full (256 tiles)"));
    EXPECT_EQ(locallySeen(frame).min, 0) << "the channel is that of those which cast";
}

// With every assignment the same lights cast, and every sum has the same order.
TEST(LocalShadowLists, AreNoDifference) {
    const Scene scene = loadScene("builtin:points");
    Settings settings = with(locally(smallImage(GBufferEncoding::full), 3, 512),
                             "lights spot:40,point:40,area:3 assign every");
    const std::vector<Channel> channels{Channel::local_visibility, Channel::lit};
    const Frame every = drawnOf(scene, settings, channels);
    for (const Assignment assign : {Assignment::tiled, Assignment::clustered, Assignment::per_object})
        for (const LightKernel kernel : {LightKernel::scatter, LightKernel::gather}) {
            Settings other = settings;
            other.assign = assign;
            other.light_kernel = kernel;
            if (assign == Assignment::per_object) other.pixel_lights = 1000;
            const Frame frame = drawnOf(scene, other, channels);
            for (const Channel mode : channels)
                EXPECT_EQ(differingPixels(every, frame, mode), 0u)
                    << nameOf(assign) << " " << nameOf(kernel) << " " << debugMode(mode).name;
        }
}

// A shadow-casting light is shaded per pixel, even if pixel_lights is 0.
TEST(LocalShadowLists, OfObjectsKeepThoseThatCast) {
    const Scene scene =
        ground({castingPoint({2, 2, 0}), castingPoint({0, 3, 1}), castingPoint({0, 3, 2})}, {board(1)});
    Settings settings =
        with(locally(smallImage(GBufferEncoding::standard), 1), "assign per_object pixel-lights 0");
    EXPECT_EQ(locallySeen(drawnOf(scene, settings)).min, 0);
}

// More lights than a draw may process: casting lights fall into several batches.
TEST(LocalShadowLists, InSeveralBatchesAreNoDifference) {
    Scene scene = ground({castingPoint({2, 2, 0}), castingSpot({1, 2, 1}, {-1, 0, 0}, 40)}, {board(1)});
    for (Light& light : scene.lights) light.shadow = true;
    scene.lights.push_back(sunAlong(glm::normalize(glm::dvec3(-1, -1, 0.3))));
    Settings settings =
        with(locally(smallImage(GBufferEncoding::full), 0, 256), "size 32x18 lights point:70000");
    const std::vector<Channel> channels{Channel::local_visibility, Channel::shadow_visibility, Channel::lit};
    for (const Path path : drawn_paths) {
        settings.path = path;
        settings.assign = Assignment::every;
        const Frame every = drawnOf(scene, settings, channels);
        settings.assign = Assignment::clustered;
        const Frame clustered = drawnOf(scene, settings, channels);
        for (const Channel mode : channels)
            EXPECT_EQ(differingPixels(every, clustered, mode), 0u)
                << nameOf(path) << " " << debugMode(mode).name;
        for (const Channel mode : {Channel::local_visibility, Channel::shadow_visibility})
            EXPECT_LT(*std::ranges::min_element(every.channels.at(mode).data), 0.1f);
    }
}

// Texels outside all tiles may contain anything: filters never read them.
TEST(LocalShadowAtlas, HoldsNothingElseThatIsRead) {
    for (const LocalScene& row :
         {LocalScene{"lamp", lampInARoom, 1}, LocalScene{"both", bothLightsInARoom, 2}})
        for (const int kernel : {1, 7}) {
            const Scene scene = row.make();
            const Settings settings = locally(smallImage(GBufferEncoding::standard), row.lights, 300, kernel);
            SharedResources shared(device(), scene, pipelines());
            const SceneView view = makeSceneView(scene, viewRequest(settings));
            PreparedFrame prepared(device(), shared, view, settings);
            const LocalShadows& shadows = prepared.view.shadow.local;
            ASSERT_TRUE(shadows.any());
            const int side = shadows.atlas().side;
            std::vector<bool> owned(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
            const auto at = [&](int x, int y) {
                return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                       static_cast<std::size_t>(x);
            };
            for (const AtlasTile& tile : shadows.atlas().tiles) {
                // Filters do not read the outermost texels of a tile, either.
                for (int y = 1; y + 1 < tile.size; ++y)
                    for (int x = 1; x + 1 < tile.size; ++x)
                        owned[at(tile.corner.x + x, tile.corner.y + y)] = true;
            }
            ASSERT_TRUE(std::ranges::count(owned, false) > 0);
            const std::size_t passes = prepared.passes.size();
            GpuBuffer poison(device(), "poison", owned.size() * sizeof(float),
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
            prepared.passes.copy("poison")
                .uses(shadows.image(), access::copiedToImage, {0, 1, 0, 1})
                .record([&](VkCommandBuffer commands) {
                    std::vector<VkBufferImageCopy> regions;
                    for (int y = 0; y < side; ++y)
                        for (int x = 0, end = 0; x < side; x = std::max(end, x + 1)) {
                            for (end = x; end < side && !owned[at(end, y)];) ++end;
                            if (end > x)
                                regions.push_back({at(x, y) * sizeof(float),
                                                   0,
                                                   0,
                                                   {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1},
                                                   {x, y, 0},
                                                   {static_cast<std::uint32_t>(end - x), 1, 1}});
                        }
                    vkCmdCopyBufferToImage(commands, poison.handle(), prepared.passes.handle(shadows.image()),
                                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                           static_cast<std::uint32_t>(regions.size()), regions.data());
                });
            prepared.passes.run(0, passes);
            const Image clean = readLit(prepared);
            for (const float value : {0.0f, 1.0f, std::numeric_limits<float>::quiet_NaN()}) {
                const std::vector<float> values(owned.size(), value);
                shared.uploader.buffer(poison, std::as_bytes(std::span(values)));
                shared.uploader.flush();
                prepared.passes.run(passes, passes + 1);
                prepared.passes.run(1, passes);  // the pass that renders the maps is the first
                EXPECT_EQ(differingPixels(clean, readLit(prepared), true), 0u) << row.name << " " << value;
            }
            // The negative control: texels of tiles are read.
            owned.assign(owned.size(), false);
            const std::vector<float> dark(owned.size(), 1);
            shared.uploader.buffer(poison, std::as_bytes(std::span(dark)));
            shared.uploader.flush();
            prepared.passes.run(passes, passes + 1);
            prepared.passes.run(1, passes);
            EXPECT_GT(differingPixels(clean, readLit(prepared), true), 1000u) << row.name;
        }
}

}  // namespace
}  // namespace diptych::tests
