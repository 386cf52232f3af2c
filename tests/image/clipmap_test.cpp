// SPDX-License-Identifier: MIT
// The sun's clipmap. Both paths give the same bits whatever the pool contains, the image matches the
// reference's rays, and cached pages equal redrawn ones.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/scene/lights/shadow_casters.h"
#include "tests/image/shadow_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace diptych::tests {
namespace {

// Pages of 32 texels: a 160 x 90 image requests about a hundred.
Settings paged(GBufferEncoding encoding, int pages = 512, int kernel = 3) {
    Settings settings = with(smallImage(encoding), "shadows clipmap shadow-size 512");
    settings.shadow_kernel = kernel;
    settings.clipmap_page_size = 32;
    settings.clipmap_pages = pages;
    return settings;
}

Frame drawnWith(Renderer& renderer, const Settings& settings, const std::vector<Channel>& channels) {
    return renderer.draw(settings, untimed(channels));
}

std::string cameraAt(const glm::dvec3& eye, const glm::dvec3& target) {
    return fmt::format("eye={},{},{} target={},{},{}", eye.x, eye.y, eye.z, target.x, target.y, target.z);
}

// A pool two pages smaller than the image requests.
int nearlyAll(const Frame& frame) {
    return static_cast<int>(std::max<std::uint64_t>(frame.counters.shadow_pages.requested, 4) - 2);
}

void expectCounted(const Frame& frame, int pool) {
    const ShadowPages& pages = frame.counters.shadow_pages;
    EXPECT_EQ(pages.requested, pages.resident + pages.fallback);
    EXPECT_LE(pages.resident, static_cast<std::uint64_t>(pool));
    EXPECT_GT(pages.requested, 0u);
}

class ClipmapPaths : public testing::TestWithParam<std::string> {};

TEST_P(ClipmapPaths, SeeTheSame) {
    Renderer& renderer = uploaded(GetParam()).renderer;
    const auto expectSame = [&](const Settings& settings) {
        std::vector<Channel> channels{Channel::shadow_visibility, Channel::cascade, Channel::page_residency,
                                      Channel::material_id};
        // With smaller encodings the decoded surfaces differ, and so does lit.
        if (settings.gbuffer == GBufferEncoding::full) channels.push_back(Channel::lit);
        const std::vector<Frame> frames = bothPaths(renderer, settings, channels);
        for (const Channel channel : channels)
            EXPECT_EQ(differingPixels(frames[0], frames[1], channel), 0u)
                << debugMode(channel).name << ", pool " << settings.clipmap_pages;
        for (const Frame& frame : frames) expectCounted(frame, settings.clipmap_pages);
        return frames[0];
    };
    const Frame whole = expectSame(paged(GBufferEncoding::full));
    // Marking and shading choose the same page: none is missing if the pool has capacity.
    EXPECT_EQ(whole.counters.shadow_pages.fallback, 0u);
    const Image& missing = whole.channels.at(Channel::page_residency);
    for (std::size_t i = 0; i < missing.pixels(); ++i) ASSERT_EQ(*missing.pixel(i), 0) << i;
    if (GetParam() != "builtin:gallery") {  // its many materials would recompile for each
        expectSame(paged(GBufferEncoding::compact));
        expectSame(paged(GBufferEncoding::standard, 512, 7));
    }
    for (const int pool : {1, nearlyAll(whole)}) {
        const Frame few = expectSame(paged(GBufferEncoding::full, pool));
        EXPECT_GT(few.counters.shadow_pages.fallback, 0u) << pool;
    }
    Settings without = paged(GBufferEncoding::full, nearlyAll(whole));
    without.prepass = Switch::off;  // forward+ without its own depth uses the same pages
    expectSame(without);
}

// Farther from an edge than the resident level's filter radius and a texel, visibility is correct. At most
// one pixel in 2,000 is falsely lit, and as many falsely dark.
TEST_P(ClipmapPaths, AreTheReferencesAwayFromEdges) {
    Renderer& renderer = uploaded(GetParam()).renderer;
    Settings settings =
        with(paged(GBufferEncoding::full, 4096), "size 320x180 shadow-size 2048 clipmap-page-size 64");
    Settings truth = settings;
    truth.path = Path::reference;
    const std::vector<Channel> channels{Channel::shadow_visibility, Channel::cascade, Channel::page_residency,
                                        Channel::material_id};
    const Frame reference = drawnWith(renderer, truth, {Channel::shadow_visibility, Channel::material_id});
    ASSERT_FALSE(reference.shadow_edge.empty());
    for (const int pool : {4096, 60, 1}) {
        settings.clipmap_pages = pool;
        const Frame path = drawnWith(renderer, settings, channels);
        std::size_t covered = 0, near = 0, falseLit = 0, falseDark = 0;
        for (std::size_t i = 0; i < path.channels.at(Channel::shadow_visibility).pixels(); ++i) {
            if (*path.channels.at(Channel::material_id).pixel(i) < 0) continue;
            ++covered;
            const float serves = *path.channels.at(Channel::cascade).pixel(i) +
                                 *path.channels.at(Channel::page_residency).pixel(i);
            const double radius = path.shadow_level_filter_radii.at(static_cast<std::size_t>(serves)).radius;
            if (double{reference.shadow_edge.pixel(i)[0]} <= radius) {
                ++near;
                continue;
            }
            const float shown = *path.channels.at(Channel::shadow_visibility).pixel(i),
                        is = *reference.channels.at(Channel::shadow_visibility).pixel(i);
            falseLit += shown > is;
            falseDark += shown < is;
        }
        // With only the whole scene's page, texels are wider than walls are thick: the bias moves a
        // surface through some.
        const double max = pool > 1 ? 5e-4 : 0.01;
        EXPECT_LE(static_cast<double>(falseLit), max * static_cast<double>(covered))
            << covered << ", near " << near << ", pool " << pool;
        EXPECT_LE(static_cast<double>(falseDark), max * static_cast<double>(covered))
            << covered << ", near " << near << ", pool " << pool;
        const std::string of = fmt::format("_of_{}", pool);
        RecordProperty("false_lit" + of, static_cast<int>(falseLit));
        RecordProperty("false_dark" + of, static_cast<int>(falseDark));
        RecordProperty("near_edges" + of, static_cast<int>(near));
        RecordProperty("covered" + of, static_cast<int>(covered));
    }
}

INSTANTIATE_TEST_SUITE_P(Builtin, ClipmapPaths,
                         testing::Values("builtin:gallery", "builtin:spheres", "builtin:suns",
                                         "builtin:ortho", "builtin:cutout", "builtin:deep",
                                         "builtin:far_away"),
                         sceneName);

// Draws the ground alone, all of which must be lit. Returns the finest level that it requests.
float expectLit(double degrees, double scale, const Settings& settings) {
    const Scene scene = groundUnder(sunAt(degrees), {}, scale);
    Renderer renderer(device(), scene, pipelines());
    const Frame frame =
        drawnWith(renderer, settings, {Channel::shadow_visibility, Channel::cascade, Channel::material_id});
    float finest = std::numeric_limits<float>::infinity();
    std::size_t dark = 0;
    for (std::size_t i = 0; i < frame.channels.at(Channel::shadow_visibility).pixels(); ++i) {
        if (*frame.channels.at(Channel::material_id).pixel(i) < 0) continue;
        dark += *frame.channels.at(Channel::shadow_visibility).pixel(i) != 1;
        finest = std::min(finest, *frame.channels.at(Channel::cascade).pixel(i));
    }
    EXPECT_EQ(dark, 0u) << degrees << " degrees, scale " << scale << ", pool " << settings.clipmap_pages
                        << ", kernel " << settings.shadow_kernel << ", camera " << settings.camera;
    return finest;
}

// A plane never shadows itself at any grazing angle or scale, from the finest level to the page of the
// whole scene.
TEST(ClipmapPlane, IsFullyLit) {
    for (const double degrees : {0.1, 1.0, 10.0, 35.0, 70.0, 90.0})
        for (const int pool : {512, 1})
            for (const int kernel : {1, 7})
                expectLit(degrees, 1, paged(GBufferEncoding::standard, pool, kernel));
    for (const double scale : {1e-3, 1e4})
        for (const double degrees : {5.0, 45.0, 90.0})
            expectLit(degrees, scale, paged(GBufferEncoding::standard));
}

// So near that no finer level exists. The bias hides float32 rounding of depths and positions.
TEST(ClipmapPlane, IsFullyLitByTheFinestLevel) {
    for (const double degrees : {0.3, 3.0, 20.0, 60.0, 90.0})
        for (const int kernel : {1, 7})
            for (const glm::dvec3& point : {glm::dvec3(0.013, 0, 0.021), glm::dvec3(3.9, 0, -3.9)}) {
                Settings settings = paged(GBufferEncoding::standard, 512, kernel);
                settings.camera =
                    cameraAt(point + glm::dvec3(0, 2e-4, 0), point + glm::dvec3(2e-4, 0, 1e-4)) +
                    " near=2e-5";
                EXPECT_EQ(expectLit(degrees, 1, settings), 0);
            }
}

// Without a caster or a sun, nothing is marked and everything is visible.
TEST(ClipmapPlane, WithoutASunThereIsNoClipmap) {
    Scene scene = groundUnder(sunAt(45));
    scene.lights.clear();
    Light lamp;
    lamp.position = {0, 2, 0};
    scene.lights.push_back(lamp);
    Renderer renderer(device(), scene, pipelines());
    const Frame frame =
        drawnWith(renderer, paged(GBufferEncoding::standard),
                  {Channel::shadow_visibility, Channel::page_residency, Channel::material_id});
    EXPECT_EQ(frame.counters.shadow_pages.requested, 0u);
    EXPECT_TRUE(frame.shadow_level_filter_radii.empty());
    for (std::size_t i = 0; i < frame.channels.at(Channel::shadow_visibility).pixels(); ++i) {
        if (*frame.channels.at(Channel::material_id).pixel(i) < 0) continue;
        ASSERT_EQ(*frame.channels.at(Channel::shadow_visibility).pixel(i), 1);
        ASSERT_EQ(*frame.channels.at(Channel::page_residency).pixel(i), -1);
    }
}

// ---- cached pages -----------------------------------------------------------------------------------

// Images from cached pages equal images from redrawn pages bit for bit: after a walk, a teleport, a jump
// by exactly one level's window, and at negative coordinates.
TEST(ClipmapCached, EqualsRedrawn) {
    const Scene scene = loadScene("builtin:gallery");
    Settings settings = paged(GBufferEncoding::standard, 200);
    settings.size = {64, 36};
    Renderer walking(device(), scene, pipelines());
    const auto expectSame = [&](const std::string& where) {
        Renderer anew(device(), scene, pipelines());
        const Frame kept = drawnWith(walking, settings,
                                     {Channel::lit, Channel::shadow_visibility, Channel::page_residency}),
                    redrawn = drawnWith(anew, settings,
                                        {Channel::lit, Channel::shadow_visibility, Channel::page_residency});
        for (const Channel channel : {Channel::lit, Channel::shadow_visibility, Channel::page_residency})
            EXPECT_EQ(differingPixels(kept, redrawn, channel), 0u) << where << " " << debugMode(channel).name;
        EXPECT_LT(kept.counters.shadow_pages.drawn, redrawn.counters.shadow_pages.drawn) << where;
    };
    const glm::dvec3 from(4, 2, 4), target(0, 0.5, 0);
    std::uint64_t drawn = 0, requested = 0;
    for (int step = 0; step < 40; ++step) {
        settings.camera = cameraAt(from + 0.02 * step * glm::dvec3(-1, 0, 0.5), target);
        const Frame frame = drawnWith(walking, settings, {});
        drawn += frame.counters.shadow_pages.drawn;
        requested += frame.counters.shadow_pages.requested;
    }
    EXPECT_LT(drawn, requested / 4);
    expectSame("after 40 steps");
    settings.camera = cameraAt({-5, 1, -6}, {-1, 0, 0});
    drawnWith(walking, settings, {});
    expectSame("after a teleport");
    // A level of 16 pages of 32 texels has a window of 17 pages: 17 m on the level whose pages are 1 m
    // wide.
    const SceneView view = makeSceneView(scene, viewRequest(settings));
    const glm::dvec3 across =
        lightSpace(-glm::normalize(glm::dvec3(view.lights.at(*brightestSun(view.lights)).direction))).x;
    for (const double jump : {17.0, -17.0, 8.5}) {
        settings.camera = cameraAt(glm::dvec3(-5, 1, -6) + jump * across, {-1, 0, 0});
        drawnWith(walking, settings, {});
        expectSame(fmt::format("after a jump of {} m", jump));
    }
}

// Still camera: pages are drawn before the first frame and never again.
TEST(ClipmapCached, AStillCameraDrawsNoPageAgain) {
    const Scene scene = groundUnder(sunAt(40), {board(1)});
    Renderer renderer(device(), scene, pipelines());
    const Settings settings = paged(GBufferEncoding::standard);
    for (int frame = 1; frame <= 4; ++frame) {
        const ShadowPages pages = drawnWith(renderer, settings, {}).counters.shadow_pages;
        EXPECT_EQ(pages.drawn > 0, frame == 1) << frame;
    }
}

// Renders a view of a scene posed by the test from an atlas that outlives it.
Image litOf(SharedResources& shared, const SceneView& view, const Settings& settings,
            std::optional<float> poison = {}, ShadowPages* pages = nullptr) {
    PreparedFrame frame(device(), shared, view, settings);
    if (poison) frame.view.shadow.sun.clipmap()->pages().fill(*poison);
    frame.passes.run();
    if (pages != nullptr) *pages = frame.view.shadow.sun.pages();
    return readLit(frame);
}

TEST(ClipmapCached, AMovedCasterIsDrawnAnewAndNothingElse) {
    const Scene scene = groundUnder(sunAt(40), {board(1), rectangle({2, 0, 1}, {0.5, 0, 0}, {0, 1, 0}, 2)});
    const Settings settings = paged(GBufferEncoding::standard);
    SceneView view = makeSceneView(scene, viewRequest(settings));
    SharedResources shared(device(), scene, pipelines());
    const Image before = litOf(shared, view, settings);
    view.pose.instances.at(2).world_from_object = glm::translate(glm::dmat4(1), {-3.5, 0, -0.5});
    ShadowPages pages;
    const Image kept = litOf(shared, view, settings, {}, &pages);
    SharedResources anew(device(), scene, pipelines());
    EXPECT_EQ(differingPixels(kept, litOf(anew, view, settings)), 0u);
    EXPECT_GT(differingPixels(before, kept), 0u);
    EXPECT_GT(pages.drawn, 0u);
    EXPECT_LT(pages.drawn, pages.requested / 2);
}

// A page has the same texels, to the bit, drawn together with others and in another slot.
TEST(ClipmapCached, PagesHaveTheSameTexelsInEverySlot) {
    const Scene scene = loadScene("builtin:gallery");
    Settings settings = paged(GBufferEncoding::standard, 120);
    settings.size = {64, 36};
    SharedResources walking(device(), scene, pipelines());
    std::size_t compared = 0, elsewhere = 0, drawn = 0;
    for (int step = 0; step < 6; ++step) {
        settings.camera = cameraAt({4 - 0.7 * step, 2, 4 + 0.4 * step}, {0, 0.5, 0});
        const SceneView view = makeSceneView(scene, viewRequest(settings));
        SharedResources anew(device(), scene, pipelines());
        PreparedFrame kept(device(), walking, view, settings), redrawn(device(), anew, view, settings);
        kept.passes.run();
        redrawn.passes.run();
        ClipmapShadow &a = *kept.view.shadow.sun.clipmap(), &b = *redrawn.view.shadow.sun.clipmap();
        ASSERT_EQ(a.residentPages().resident.size(), b.residentPages().resident.size());
        for (std::size_t i = 0; i < a.residentPages().resident.size(); ++i) {
            const PageDraw &one = a.residentPages().resident[i], &other = b.residentPages().resident[i];
            ASSERT_EQ(one.page, other.page);
            const std::vector<float> x = a.pages().read(one.slot), y = b.pages().read(other.slot);
            EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof(float)), 0)
                << "step " << step << ", page " << one.page.exponent << " " << one.page.x << " " << one.page.y
                << ", slots " << one.slot << " and " << other.slot;
            ++compared;
            elsewhere += one.slot != other.slot;
            drawn += std::ranges::min(x) < std::ranges::max(x);
        }
    }
    EXPECT_GT(compared, 100u);
    EXPECT_GT(elsewhere, compared / 4);
    EXPECT_GT(drawn, compared / 4) << "pages with a caster's edge";
}

// Undrawn texels are never read: free slots, and texels beside a page.
TEST(ClipmapCached, NothingReadsWhatWasNotDrawn) {
    for (const int kernel : {1, 7})
        for (const double degrees : {2.0, 40.0, 90.0}) {
            const Scene scene = groundUnder(sunAt(degrees), {board(1)});
            const Settings settings = paged(GBufferEncoding::standard, 300, kernel);
            const SceneView view = makeSceneView(scene, viewRequest(settings));
            std::optional<Image> first;
            for (const float poison : {0.0f, 1.0f, std::numeric_limits<float>::quiet_NaN()}) {
                SharedResources own(device(), scene, pipelines());
                const Image image = litOf(own, view, settings, poison);
                if (first) {
                    EXPECT_EQ(differingPixels(*first, image), 0u)
                        << poison << " " << kernel << " " << degrees;
                } else {
                    first = image;
                }
            }
        }
}

// Control: an image that reads no page would pass every comparison with itself.
TEST(ClipmapCached, PoisonInAPageThatIsReadIsSeen) {
    const Scene scene = groundUnder(sunAt(40), {board(1)});
    const Settings settings = paged(GBufferEncoding::standard);
    const SceneView view = makeSceneView(scene, viewRequest(settings));
    SharedResources shared(device(), scene, pipelines());
    PreparedFrame frame(device(), shared, view, settings);
    frame.passes.run();
    const Image right = readLit(frame);
    frame.view.shadow.sun.clipmap()->pages().fill(1);
    frame.passes.run();
    EXPECT_GT(differingPixels(right, readLit(frame)), right.pixels() / 3);
}

// Minimum and maximum visibility on the ground for x in [from, to], near its centre line.
std::pair<float, float> seenBetween(const Frame& frame, const glm::dvec3& eye, double from, double to) {
    std::pair<float, float> range{2.0f, -1.0f};
    const Image& at = frame.channels.at(Channel::position);
    for (int y = 0; y < at.height; ++y)
        for (int x = 0; x < at.width; ++x) {
            const double east = double{at.at(x, y, 0)} + eye.x, south = double{at.at(x, y, 2)} + eye.z;
            if (frame.channels.at(Channel::material_id).at(x, y) != 0 || east < from || east > to ||
                std::abs(south) > 1)
                continue;
            range.first = std::min(range.first, frame.channels.at(Channel::shadow_visibility).at(x, y));
            range.second = std::max(range.second, frame.channels.at(Channel::shadow_visibility).at(x, y));
        }
    return range;
}

// The board's shadow is known. The cameras reuse each other's slots in a small pool. A stale page table
// entry would light the shadow or darken the ground beside it.
TEST(ClipmapTable, NoEntryNamesAnotherPagesSlot) {
    const Scene scene = groundUnder(sunAt(45), {board(1)});
    Renderer renderer(device(), scene, pipelines());
    Settings settings =
        with(paged(GBufferEncoding::standard, 4096), "size 320x180 shadow-size 2048 clipmap-page-size 64");
    const glm::dvec3 eyes[] = {{0.4, 6, 2.5}, {-2, 3, -2}, {1, 5, -3}, {-1, 4, 3}, {0.4, 6, 2.5}};
    std::uint64_t max = 0;
    for (const glm::dvec3& eye : eyes) {
        settings.camera = cameraAt(eye, {-0.3, 0, 0});
        max = std::max(max, drawnWith(renderer, settings, {}).counters.shadow_pages.requested);
    }
    settings.clipmap_pages = static_cast<int>(max) + 1;
    for (const glm::dvec3& eye : eyes) {
        settings.camera = cameraAt(eye, {-0.3, 0, 0});
        const Frame frame = drawnWith(renderer, settings,
                                      {Channel::shadow_visibility, Channel::material_id, Channel::position});
        EXPECT_EQ(frame.counters.shadow_pages.fallback, 0u);
        // Shadow length of a 1 m board, sun 45 degrees high and 0.3 radians from +X: 0.955 m.
        const auto [min, dark] = seenBetween(frame, eye, -0.85, -0.1);
        const auto [beside, brightest] = seenBetween(frame, eye, 0.1, 2);
        EXPECT_EQ(dark, 0) << settings.camera;
        EXPECT_EQ(beside, 1) << settings.camera;
        EXPECT_EQ(min, 0);
        EXPECT_EQ(brightest, 1);
        EXPECT_EQ(seenBetween(frame, eye, -3, -1.1).first, 1) << settings.camera;
    }
}

// A frame marks the pages that it used, in both paths, with and without a depth pre-pass.
TEST(ClipmapMarks, AreTheSameOfEveryDepth) {
    const Scene scene = loadScene("builtin:gallery");
    SharedResources shared(device(), scene, pipelines());
    Settings settings = paged(GBufferEncoding::standard, 4096);
    const SceneView view = makeSceneView(scene, viewRequest(settings));
    std::optional<std::vector<gpu::uint>> marks;
    for (const auto& [path, prepass] :
         {std::pair{Path::deferred, Switch::automatic}, std::pair{Path::forward_plus, Switch::on},
          std::pair{Path::forward_plus, Switch::off}}) {
        settings.path = path;
        settings.prepass = prepass;
        PreparedFrame frame(device(), shared, view, settings);
        ClipmapShadow& shadow = *frame.view.shadow.sun.clipmap();
        const std::vector<gpu::uint> prepared = shadow.readMarks();
        frame.passes.run();
        EXPECT_EQ(shadow.readMarks(), prepared);
        if (marks) {
            EXPECT_EQ(prepared, *marks);
        }
        marks = prepared;
        std::size_t count = 0;
        for (const gpu::uint word : prepared) count += static_cast<std::size_t>(std::popcount(word));
        EXPECT_EQ(count, shadow.counts().requested);
    }
}

// In Sponza a step of 5 cm redraws less than a tenth of the pages.
TEST(ClipmapSponza, ASmallStepRedrawsFewPages) {
    const std::filesystem::path file = assets() / "sponza/Sponza.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    const Scene scene = loadScene(file.string());
    Settings settings;
    settings.shadows = Shadows::clipmap;
    settings.clipmap_pages = 1024;
    std::vector<ShadowPages> pages;
    Renderer renderer(device(), scene, pipelines());
    for (const double x : {0.0, 0.05, 0.1}) {
        settings.camera = cameraAt({-8 + x, 2, 0}, {0 + x, 2.5, 0});
        pages.push_back(drawnWith(renderer, settings, {}).counters.shadow_pages);
    }
    EXPECT_EQ(pages[0].fallback, 0u);
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}})
        EXPECT_LT(10 * pages[i].drawn, pages[i].requested) << pages[i].drawn << " of " << pages[i].requested;
    RecordProperty("pages", static_cast<int>(pages[1].requested));
    RecordProperty("redrawn", static_cast<int>(pages[1].drawn));
}

}  // namespace
}  // namespace diptych::tests
