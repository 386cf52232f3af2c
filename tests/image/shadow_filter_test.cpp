// SPDX-License-Identifier: MIT
// Shadow filters of the sun other than PCF: equal bits in both paths, correct edge widths, and maps that
// cover everything in view.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/scenes.h"
#include "tests/support/shapes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>

namespace diptych::tests {
namespace {

Settings filteredBy(Shadows shadows, GBufferEncoding gbuffer, int size = 256, int kernel = 3) {
    Settings settings = smallImage(gbuffer);
    settings.shadows = shadows;
    settings.shadow_size = size;
    settings.shadow_kernel = kernel;
    return settings;
}

Frame drawnOnce(Renderer& renderer, const Settings& settings, const std::vector<Channel>& channels) {
    return renderer.draw(settings, untimed(channels));
}
Frame drawnOnce(const Scene& scene, const Settings& settings, const std::vector<Channel>& channels) {
    Renderer renderer(device(), scene, pipelines());
    return drawnOnce(renderer, settings, channels);
}

// Every sun has an angular size; only --shadows pcss uses it.
Scene withDiscs(Scene scene, float angle) {
    for (Light& light : scene.lights)
        if (light.kind == LightKind::directional) light.angle = angle;
    return scene;
}

class ShadowFilters : public testing::TestWithParam<std::string> {};

TEST_P(ShadowFilters, SeeTheSameInBothPaths) {
    const Scene scene = withDiscs(loadScene(GetParam()), 0.05f);
    Renderer renderer(device(), scene, pipelines());
    // The normal's encoding does not depend on the filter: each encoding with two filters.
    const std::pair<Shadows, GBufferEncoding> filters[] = {{Shadows::evsm, GBufferEncoding::full},
                                                           {Shadows::evsm4, GBufferEncoding::standard},
                                                           {Shadows::msm4, GBufferEncoding::full},
                                                           {Shadows::pcss, GBufferEncoding::standard}};
    // All filters would compile the gallery's many materials four times.
    const std::size_t count = GetParam() == "builtin:gallery" ? 1 : std::size(filters);
    for (const auto& [shadows, encoding] : std::span(filters).first(count)) {
        const std::vector<Frame> frames =
            bothPaths(renderer, filteredBy(shadows, encoding), {Channel::lit, Channel::shadow_visibility});
        const Image& seen = frames[0].channels.at(Channel::shadow_visibility);
        EXPECT_EQ(differingPixels(seen, frames[1].channels.at(Channel::shadow_visibility)), 0u)
            << nameOf(shadows);
        EXPECT_TRUE(std::ranges::all_of(seen.data, [](float v) { return v >= 0 && v <= 1; }));
        if (encoding == GBufferEncoding::full) {
            EXPECT_EQ(differingPixels(frames[0], frames[1], Channel::lit), 0u) << nameOf(shadows);
        }
    }
}

// The bounds are those of the depth channel, every pixel has a cascade, and the last is no coarser.
TEST_P(ShadowFilters, MapsFitWhatTheImageShows) {
    const Scene scene = loadScene(GetParam());
    SharedResources shared(device(), scene, pipelines());
    SceneViews views(scene);
    Settings settings = filteredBy(Shadows::pcf, GBufferEncoding::full);
    Renderer renderer(device(), scene, pipelines());
    const PreparedView standard(device(), shared, views.at(viewRequest(settings)), settings);
    settings.shadow_fit = ShadowFit::depth;
    const std::vector<Frame> frames =
        bothPaths(renderer, settings,
                  {Channel::shadow_visibility, Channel::cascade, Channel::depth, Channel::material_id});
    for (const Channel channel : {Channel::shadow_visibility, Channel::cascade})
        EXPECT_EQ(differingPixels(frames[0], frames[1], channel), 0u);
    float near = std::numeric_limits<float>::infinity(), far = 0;
    for (std::size_t i = 0; i < frames[0].channels.at(Channel::material_id).pixels(); ++i) {
        if (*frames[0].channels.at(Channel::material_id).pixel(i) < 0) continue;
        near = std::min(near, *frames[0].channels.at(Channel::depth).pixel(i));
        far = std::max(far, *frames[0].channels.at(Channel::depth).pixel(i));
        EXPECT_GE(*frames[0].channels.at(Channel::cascade).pixel(i), 0);
    }
    const PreparedView prepared(device(), shared, views.at(viewRequest(settings)), settings);
    ASSERT_TRUE(prepared.shadow.sun.shown());
    EXPECT_EQ(prepared.shadow.sun.shown()->near, double{near});
    EXPECT_EQ(prepared.shadow.sun.shown()->far, double{far});
    PassList passes(device(), 160, 90);
    functionsOf(settings.path).add(passes, prepared.inputs);
    EXPECT_EQ(passes.names().front(), "shadow depth bounds");
    EXPECT_LE(prepared.shadow.sun.filterRadii().back().radius,
              standard.shadow.sun.filterRadii().back().radius);
    const auto& notes = frames[0].notes;
    EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) {
        return note.find("in 8 steps of a texel") != std::string::npos;
    }));
}

INSTANTIATE_TEST_SUITE_P(Builtin, ShadowFilters,
                         testing::Values("builtin:gallery", "builtin:spheres", "builtin:suns",
                                         "builtin:ortho", "builtin:cutout", "builtin:deep",
                                         "builtin:far_away"),
                         sceneName);

// A sun without angular size is a point: its soft shadow is that of pcf.
TEST(ShadowPcss, OfASunWithoutAnAngleIsPcf) {
    Renderer& renderer = uploaded("builtin:gallery").renderer;
    const auto by = [&](Shadows shadows) {
        return drawnOnce(renderer, filteredBy(shadows, GBufferEncoding::full),
                         {Channel::lit, Channel::shadow_visibility});
    };
    const Frame soft = by(Shadows::pcss), hard = by(Shadows::pcf);
    for (const Channel channel : {Channel::lit, Channel::shadow_visibility})
        EXPECT_EQ(differingPixels(soft, hard, channel), 0u);
    EXPECT_TRUE(std::ranges::any_of(soft.notes, [](const std::string& note) {
        return note.find("has no angular size") != std::string::npos;
    }));
}

// Ground of 8 m x 8 m, and a roof `height` above its half with negative x or z, under a sun at the zenith.
// Seen from below the roof.
Scene underARoof(double height, float angle, bool along_z = false, double fov = 0.5) {
    Scene scene;
    scene.name = "roof";
    const float h = static_cast<float>(height);
    scene.meshes.push_back({"roof",
                            {rectangle({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 0),
                             along_z ? rectangle({-4, h, 0}, {8, 0, 0}, {0, 0, -4}, 1)
                                     : rectangle({-4, h, 4}, {4, 0, 0}, {0, 0, -8}, 1)}});
    scene.nodes.push_back({"roof", -1, glm::dmat4(1.0), 0});
    scene.materials.resize(2);
    for (Material& material : scene.materials) material.double_sided = true;
    Light sun = sunAlong({0, -1, 0}, 3);
    sun.angle = angle;
    scene.lights.push_back(sun);
    Camera camera;
    camera.near = 0.01;
    camera.yfov = fov;
    const glm::dvec3 eye = along_z ? glm::dvec3(0, 0.4, 1.2) : glm::dvec3(1.2, 0.4, 0);
    camera.world_from_camera = glm::inverse(glm::lookAt(eye, glm::dvec3(0), {0, 1, 0}));
    scene.cameras.push_back(camera);
    return scene;
}

// The ground's visibility by distance from the roof's edge, m: positive in the open.
struct Crossed {
    double at, visibility, edge_distance;
};
std::vector<Crossed> across(const Frame& frame, bool along_z = false) {
    const double eye = 1.2;
    std::vector<Crossed> all;
    const Image& position = frame.channels.at(Channel::position);
    for (std::size_t i = 0; i < position.pixels(); ++i)
        if (*frame.channels.at(Channel::material_id).pixel(i) == 0)
            all.push_back({double{position.pixel(i)[along_z ? 2 : 0]} + eye,
                           double{*frame.channels.at(Channel::shadow_visibility).pixel(i)},
                           frame.shadow_edge.empty() ? 0 : double{frame.shadow_edge.pixel(i)[0]}});
    return all;
}

// Visible fraction of a disc of angular size `angle`, `at` m beyond an edge `height` m above: the segment
// of a circle beyond a chord.
double seenOfDisc(double at, double height, double angle) {
    const double t = std::clamp(at / (height * std::tan(angle / 2)), -1.0, 1.0);
    return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / std::numbers::pi;
}

// A penumbra is 2 tan(angle / 2) times as wide as its caster is high, with the profile of a disc, to
// within a texel. The reference traces the disc itself.
TEST(ShadowPcss, APenumbraIsAsWideAsTheFormula) {
    for (const bool along_z : {false, true})
        for (const float angle : {0.03f, 0.09f})
            for (const double height : {0.5, 1.0}) {
                Settings settings = with(filteredBy(Shadows::pcss, GBufferEncoding::full, 1024),
                                         "shadow-cascades 1 size 320x180");
                const Scene scene = underARoof(height, angle, along_z);
                const Frame frame = drawnOnce(
                    scene, settings, {Channel::shadow_visibility, Channel::material_id, Channel::position});
                constexpr double texel = 0.0095;  // 8 m, and margins for the widest filter
                int penumbra = 0;
                for (const Crossed& c : across(frame, along_z)) {
                    EXPECT_GE(c.visibility, seenOfDisc(c.at - texel, height, double{angle}) - 0.02) << c.at;
                    EXPECT_LE(c.visibility, seenOfDisc(c.at + texel, height, double{angle}) + 0.02) << c.at;
                    penumbra += c.visibility > 0.01 && c.visibility < 0.99;
                }
                EXPECT_GT(penumbra, 500) << angle << " " << height;
                if (along_z) continue;
                settings.path = Path::reference;
                settings.size = {160, 90};
                for (const Crossed& c : across(
                         drawnOnce(scene, settings,
                                   {Channel::shadow_visibility, Channel::material_id, Channel::position}))) {
                    EXPECT_NEAR(c.visibility, seenOfDisc(c.at, height, double{angle}), 0.07) << c.at;
                    EXPECT_EQ(c.edge_distance == 0, c.visibility > 0 && c.visibility < 1);
                }
            }
}

// A board just above the ground, beside a high roof's penumbra. Its depth is in the blocker search region,
// but it occludes none of the disc: the penumbra keeps the roof's width.
TEST(ShadowPcss, OnlyWhatLiesInTheConeBlocks) {
    constexpr float angle = 0.09f;
    constexpr double height = 1, edge = 0.12, low = 0.05, texel = 0.0095;
    Scene scene = underARoof(height, angle);
    Primitive board = scene.meshes[0].primitives[1];  // x from -4 to 0
    for (glm::vec3& p : board.positions) p = {p.x + 4 + edge, low, p.z};
    scene.meshes[0].primitives.push_back(board);
    Settings settings =
        with(filteredBy(Shadows::pcss, GBufferEncoding::full, 1024), "shadow-cascades 1 size 320x180");
    int penumbra = 0;
    for (const Crossed& c : across(drawnOnce(
             scene, settings, {Channel::shadow_visibility, Channel::material_id, Channel::position}))) {
        if (c.at > edge - low * std::tan(double{angle} / 2) - 2 * texel) continue;  // the board's shadow
        EXPECT_GE(c.visibility, seenOfDisc(c.at - texel, height, double{angle}) - 0.02) << c.at;
        EXPECT_LE(c.visibility, seenOfDisc(c.at + texel, height, double{angle}) + 0.02) << c.at;
        penumbra += c.visibility > 0.01 && c.visibility < 0.99;
    }
    EXPECT_GT(penumbra, 250);
}

// Blurring widens an edge along both axes of the map without shifting it.
TEST(ShadowMoments, AreBlurredAcrossAndDown) {
    for (const Shadows shadows : {Shadows::evsm, Shadows::evsm4, Shadows::msm4})
        for (const bool along_z : {false, true}) {
            std::map<int, double> width;
            for (const int kernel : {1, 7}) {
                Settings settings = with(filteredBy(shadows, GBufferEncoding::full, 512, kernel),
                                         "shadow-cascades 1 size 320x180 shadow-bias 0");
                constexpr double texel = 8.0 / 500;
                double from = 1, to = -1, middle = 0;
                int pixels = 0;
                const Frame frame =
                    drawnOnce(underARoof(1, 0, along_z, 0.1), settings,
                              {Channel::shadow_visibility, Channel::material_id, Channel::position});
                EXPECT_EQ(std::ranges::count(frame.notes, "--shadows evsm: exponent 40 in 32-bit floats"),
                          shadows == Shadows::evsm ? 1 : 0);
                for (const Crossed& c : across(frame, along_z)) {
                    if (c.visibility < 0.05 || c.visibility > 0.95) continue;
                    from = std::min(from, c.at);
                    to = std::max(to, c.at);
                    middle += c.visibility > 0.4 && c.visibility < 0.6 ? c.at : 0;
                    pixels += c.visibility > 0.4 && c.visibility < 0.6;
                }
                width[kernel] = (to - from) / texel;
                EXPECT_NEAR(middle / pixels, 0, texel) << nameOf(shadows) << " " << kernel;
            }
            // Range 0.05 to 0.95: linear over one texel; a Gaussian of 1.4 texels.
            EXPECT_NEAR(width[1], 0.9, 0.4) << nameOf(shadows) << along_z;
            EXPECT_NEAR(width[7], 4.7, 0.8) << nameOf(shadows) << along_z;
        }
}

// A plane under a grazing sun is lit, with either precision.
TEST(ShadowMoments, OfAPlaneLeaveItLit) {
    for (const EvsmPrecision precision : {EvsmPrecision::fp32, EvsmPrecision::fp16})
        for (const Shadows shadows : {Shadows::evsm, Shadows::evsm4, Shadows::msm4}) {
            if (shadows == Shadows::msm4 && precision == EvsmPrecision::fp16) continue;
            for (const double degrees : {3.0, 20.0, 60.0}) {
                Scene scene = underARoof(1, 0);
                scene.meshes[0].primitives.pop_back();
                const double up = degrees * std::numbers::pi / 180;
                scene.lights[0].direction = {-std::cos(up), -std::sin(up), 0.0};
                Settings settings = filteredBy(shadows, GBufferEncoding::full, 512);
                if (shadows != Shadows::msm4) settings.evsm_precision = precision;
                double min = 1;
                for (const Crossed& c :
                     across(drawnOnce(scene, settings,
                                      {Channel::shadow_visibility, Channel::material_id, Channel::position})))
                    min = std::min(min, c.visibility);
                EXPECT_GT(min, 0.98) << nameOf(shadows) << nameOf(precision) << " " << degrees;
            }
        }
}

}  // namespace
}  // namespace diptych::tests
