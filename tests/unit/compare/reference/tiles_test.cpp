// SPDX-License-Identifier: MIT
// Images of everything that can be asked for: tile by tile, stopped and resumed, and one pixel of them.
#include "tests/support/reference_scene.h"

#include "tests/support/files.h"

#include <tbb/info.h>

#include <array>
#include <atomic>
#include <mutex>
#include <stdexcept>

namespace diptych::reference {
namespace {

// A floor under a board, a blended sheet and a rough pane, lit by a light of each kind that has an image of
// its own, a sky and ambient light.
struct Everything {
    Scene scene = floorScene();
    Pose pose;
    View view = viewFrom({4, 2, 3}, {0, 0, 0}, 32, 36);
    std::map<Channel, Image> surfaces, decoded;
    bool sampled;

    // `sampled`: the sky is not uniform, so its light takes samples, and its approximations err.
    explicit Everything(bool sampled_sky = false) : sampled(sampled_sky) {
        scene.meshes[0].primitives = {quad({-0.6f, -0.6f, 0}, {1.2f, 0, 0}, {0, 1.2f, 0})};
        Material& floor = scene.materials[0];
        floor.specular = 1;
        floor.roughness = 0.5f;
        floor.emissive = {0.1f, 0.2f, 0.3f};
        Material sheet = matte();
        sheet.alpha_mode = AlphaMode::blend;
        sheet.base_color = {0.8f, 0.4f, 0.2f, 0.5f};
        Material pane = matte();
        pane.transmission = 0.75f;
        pane.roughness = 0;
        scene.materials.insert(scene.materials.end(), {sheet, pane});
        add(scene, quad({0.3f, -0.5f, 0.5f}, {0.4f, 0, 0}, {0, 0.5f, 0}));
        add(scene, quad({-0.5f, 0, 0.3f}, {0.5f, 0, 0}, {0, 0.5f, 0}, 1));
        add(scene, quad({0.2f, 0.2f, 0.3f}, {0.5f, 0, 0}, {0, 0.5f, 0}, 2));
        scene.environment = Environment{"sky", Image(4, 2, 3, 0.2f)};
        if (sampled) scene.environment->radiance.at(2, 0, 0) = 0.4f;
        scene.lights = {lightOf(LightKind::directional, {0, 0, 0}, {0.3, 0.2, -1}),
                        lightOf(LightKind::spot, {0, 0, 2}), lightOf(LightKind::rect, {0, 0, 2})};
        // A pixel lies at the edge of the spot's cone, where float32 errs.
        const glm::dvec3 there = view.eye() + pixelOf(traced().channels.at(Channel::position), 16, 17);
        scene.lights[1].inner_cone = 0;
        scene.lights[1].outer_cone = static_cast<float>(1.01 * std::atan2(std::hypot(there.x, there.y), 2));
        scene.lights[1].intensity = 1e4f;
        pose = poseAt(scene, 0);
    }
    // Without lights.
    ReferenceImage traced() const {
        const Pose dark = poseAt(scene, 0);
        return reference::draw(
            {.scene = scene, .pose = dark, .view = view, .lights = {}, .mode = ReferenceMode::scene});
    }
    // `decoding`: mode surface, whose surfaces the first call traces; their albedo is decoded as half.
    ReferenceImage draw(bool decoding, Request request) {
        if (decoding && surfaces.empty()) {
            const ReferenceImage image = traced();
            for (const Channel channel : surfaceChannels(~0u)) surfaces[channel] = image.channels.at(channel);
            decoded = surfaces;
            for (float& value : decoded.at(Channel::albedo).data) value *= 0.5f;
        }
        request.surfaces = decoding ? &surfaces : nullptr;
        request.decoded = decoding ? &decoded : nullptr;
        return reference::draw(request);
    }
    Request requested(bool decoding) const {
        return {.scene = scene,
                .pose = pose,
                .view = view,
                .lights = pose.lights,
                .ambient = {0.1, 0.2, 0.3},
                .casters = everyLight(pose.lights),
                .environment_costs = sampled,
                .surroundings = true,
                .mode = decoding ? ReferenceMode::surface : ReferenceMode::scene};
    }
};

using Named = std::pair<const char*, const Image ReferenceImage::*>;
constexpr Named others[] = {{"uncertainty", &ReferenceImage::uncertainty},
                            {"rounding", &ReferenceImage::rounding},
                            {"shadow edge", &ReferenceImage::shadow_edge},
                            {"local shadow edge", &ReferenceImage::local_shadow_edge},
                            {"environment costs", &ReferenceImage::environment_costs},
                            {"surroundings", &ReferenceImage::surroundings},
                            {"blended", &ReferenceImage::blended},
                            {"unblended", &ReferenceImage::unblended}};

void expectAllSame(const ReferenceImage& a, const ReferenceImage& b) {
    for (const auto images : {&ReferenceImage::channels, &ReferenceImage::decoded}) {
        ASSERT_EQ((a.*images).size(), (b.*images).size());
        for (const auto& [mode, image] : a.*images)
            EXPECT_EQ(image.data, (b.*images).at(mode).data) << debugMode(mode).name;
    }
    for (const auto& [name, image] : others) EXPECT_EQ((a.*image).data, (b.*image).data) << name;
}

TEST(ReferenceTiles, StoppedEveryImageGoesOn) {
    for (const bool decoding : {false, true}) {
        Everything made(true);
        const ReferenceImage whole = made.draw(decoding, made.requested(decoding));
        for (const auto& [name, image] : others) {
            ASSERT_FALSE((whole.*image).empty()) << name;
            EXPECT_GT(std::ranges::max((whole.*image).data), 0) << name;
        }
        EXPECT_EQ(whole.decoded.size(), decoding ? litModes.size() : 0);
        EXPECT_EQ(whole.resumed_fraction, 0);

        const std::filesystem::path stem = folder() / "kept";
        std::atomic<int> tiles{0};
        Request request = made.requested(decoding);
        std::optional<Checkpoint> checkpoint;
        request.keep = keptAt(stem, checkpoint);
        request.progress = [&](double) {
            if (++tiles == 3) throw std::runtime_error("stop");
        };
        EXPECT_THROW(made.draw(decoding, request), std::runtime_error);
        checkpoint.reset();
        std::mutex one;
        std::vector<double> fractions;
        request.progress = [&](double fraction) {
            const std::lock_guard lock(one);
            fractions.push_back(fraction);
        };
        const ReferenceImage again = made.draw(decoding, request);
        expectAllSame(whole, again);
        const double rest = static_cast<double>(fractions.size());
        EXPECT_NEAR(again.resumed_fraction, 1 - rest / 6, 1e-12);
        std::ranges::sort(fractions);
        for (std::size_t i = 0; i < fractions.size(); ++i)
            EXPECT_DOUBLE_EQ(fractions[i], static_cast<double>(i + 1) / rest);
    }
}

// Each tile is told once, when it is done, with the pixels that the image has.
TEST(ReferenceTiles, AreToldWithTheirPixels) {
    Everything made;
    const Image lit = made.draw(false, made.requested(false)).channels.at(Channel::lit);
    Image told(lit.width, lit.height, 3);
    std::mutex one;
    std::vector<std::array<int, 4>> tiles;
    Request request = made.requested(false);
    request.tile = [&](const ReferenceImage& image, int x, int y, int width, int height) {
        const std::lock_guard lock(one);
        tiles.push_back({x, y, width, height});
        for (int v = y; v < y + height; ++v)
            for (int u = x; u < x + width; ++u)
                for (int c = 0; c < 3; ++c) told.at(u, v, c) += image.channels.at(Channel::lit).at(u, v, c);
    };
    made.draw(false, request);
    EXPECT_EQ(told.data, lit.data);
    std::ranges::sort(tiles);
    EXPECT_EQ(tiles, (std::vector<std::array<int, 4>>{{0, 0, 16, 16},
                                                      {0, 16, 16, 16},
                                                      {0, 32, 16, 4},
                                                      {16, 0, 16, 16},
                                                      {16, 16, 16, 16},
                                                      {16, 32, 16, 4}}));
}

// A tile keeps the seconds it took, which an earlier command spent on all cores.
TEST(ReferenceTiles, TellWhatTheyTook) {
    Everything made;
    const std::filesystem::path stem = folder() / "kept";
    std::optional<Checkpoint> checkpoint;
    Request request = made.requested(false);
    request.keep = [&](std::uint64_t image_key, std::size_t floats) -> Checkpoint& {
        Checkpoint& written = checkpoint.emplace(stem, image_key, floats);
        std::vector<float> tile(floats, 0.25f);
        tile.front() = 3;
        for (const std::uint64_t index : {0, 5, 6}) written.keep(index, tile);  // the last one does not exist
        return checkpoint.emplace(stem, image_key, floats);
    };
    const ReferenceImage image = made.draw(false, request);
    EXPECT_DOUBLE_EQ(image.resumed_fraction, 1.0 / 6 + 1.0 / 6);
    EXPECT_DOUBLE_EQ(image.resumed_seconds, 2 * (3.0 / tbb::info::default_concurrency()));
    EXPECT_EQ(image.channels.at(Channel::lit).at(15, 15, 2), 0.25f);
    EXPECT_EQ(image.channels.at(Channel::depth).at(16, 32), 0.25f);
    EXPECT_NE(image.channels.at(Channel::depth).at(16, 16), 0.25f);
}

// One pixel has the image's values; its lights and the rest add up to the surface's light.
TEST(ReferenceTiles, OnePixelIsTheImages) {
    for (const bool decoding : {false, true}) {
        Everything made;
        const ReferenceImage image = made.draw(decoding, made.requested(decoding));
        Request request = made.requested(decoding);
        request.surfaces = &made.surfaces;
        for (const auto& [x, y] : {std::pair{16, 17}, {14, 18}, {15, 16}, {17, 19}, {16, 15}}) {
            const PixelLight pixel = drawPixel(request, x, y);
            ASSERT_EQ(pixel.channels.size(), image.channels.size());
            for (const auto& [channel, value] : pixel.channels) {
                const Image& of = image.channels.at(channel);
                for (int c = 0; c < of.components; ++c)
                    EXPECT_EQ(static_cast<float>(value[c]), of.at(x, y, c))
                        << debugMode(channel).name << " " << x << "," << y << " " << decoding;
            }
            EXPECT_EQ(static_cast<float>(pixel.uncertainty), image.uncertainty.at(x, y));
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(static_cast<float>(pixel.unblended[c]), image.unblended.at(x, y, c));
            ASSERT_EQ(pixel.lights.size(), 3u) << x << "," << y;
            glm::dvec3 sum = pixel.without_lights.all() + pixel.channels.at(Channel::emission);
            for (const Shading& light : pixel.lights) {
                sum += light.all();
                EXPECT_EQ(light.ambient, glm::dvec3(0));
                EXPECT_EQ(light.environment.sum(), glm::dvec3(0));
            }
            expectColor(sum, pixel.unblended, 2e-2 * sum.x);
            EXPECT_GT(pixel.lights[0].all().x + pixel.lights[2].all().x, 0) << x << "," << y;
        }
        request.blended = false;
        EXPECT_EQ(drawPixel(request, 14, 18).unblended, drawPixel(request, 14, 18).channels.at(Channel::lit));
    }
    // The background has no terms.
    Everything made;
    made.view = viewFrom({0, 0, 3}, {0, 0, 9}, 4, 4);
    const PixelLight pixel = drawPixel(made.requested(false), 1, 1);
    EXPECT_TRUE(pixel.lights.empty());
    EXPECT_NEAR(pixel.channels.at(Channel::lit).y, 0.2, 1e-6);
}

}  // namespace
}  // namespace diptych::reference
