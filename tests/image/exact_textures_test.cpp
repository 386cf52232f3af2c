// SPDX-License-Identifier: MIT
// --textures exact: both paths come close to the reference in mode scene, which decodes and filters texels
// in double. A device's own decoding and filtering do not.
#include "compare/frames/frame_properties.h"
#include "compare/render/reference_frame.h"
#include "shared/scene/scene_view.h"
#include "tests/image/square.h"

#include <glm/geometric.hpp>

#include <numbers>

namespace diptych::tests {
namespace {

constexpr std::array bothPrecisions{TexturePrecision::device, TexturePrecision::exact};

Settings texturedImage(TexturePrecision textures) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.textures = textures;
    return settings;
}

Frame tracedScene(const Scene& scene, Settings settings) {
    settings.path = Path::reference;
    settings.reference_mode = ReferenceMode::scene;
    SceneViews views(scene);
    RenderOptions options;
    options.channels = allChannels();
    return drawReferenceFrame(scene, views.at(viewRequest(settings)), settings, nullptr, options);
}

// Magnified 8-bit noise in colour and non-colour slots.
Scene noisySquare() {
    Scene scene = square();
    TextureImage image{"noise", 6, 6, {}};
    std::uint32_t state = 5;
    for (int i = 0; i < 4 * 6 * 6; ++i) {
        state = state * 1664525u + 1013904223u;
        image.rgba.push_back(static_cast<std::uint8_t>(state >> 24));
    }
    scene.images[0] = image;
    scene.textures[0].sampler = {Wrap::clamp_to_edge, Wrap::clamp_to_edge, true, true, false, false};
    Material& m = scene.materials[0];
    m.base_color_texture.texture = m.metallic_roughness_texture.texture = 0;
    return scene;
}

double largestError(const Frame& frame, const Frame& truth, Channel mode) {
    const Image &a = frame.channels.at(mode), &b = truth.channels.at(mode);
    double max = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i)
        max = std::max(max, std::abs(double{a.data[i]} - double{b.data[i]}));
    return max;
}

// 16-bit values err by a step, 1.5e-5, plus float32's texture coordinates; colours by half a ULP of a half
// float below 1, 2.4e-4. A device's own 8-bit filtering may be off by a whole code, 3.9e-3; lavapipe's is.
TEST(ExactTextures, AreFilteredAsTheReferenceDoes) {
    const Scene scene = noisySquare();
    const Frame truth = tracedScene(scene, texturedImage(TexturePrecision::device));
    double ofDevice = 0;
    for (const TexturePrecision textures : bothPrecisions) {
        const std::vector<Frame> frames = bothPaths(scene, texturedImage(textures));
        for (const Frame& frame : frames) {
            const double number = largestError(frame, truth, Channel::roughness),
                         color = largestError(frame, truth, Channel::albedo);
            if (textures == TexturePrecision::device) {
                ofDevice = std::max(ofDevice, number);
                continue;
            }
            EXPECT_LT(number, 3e-5) << frame.name;
            EXPECT_LT(color, 3e-4) << frame.name;
        }
        for (const Channel channel : allChannels())
            if (frames[0].channels.contains(channel) && frames[1].channels.contains(channel)) {
                EXPECT_EQ(differingPixels(frames[0], frames[1], channel), 0u)
                    << nameOf(textures) << ", " << debugMode(channel).name << ": both paths";
            }
    }
    if (device().profile().bit_exact) {
        EXPECT_GT(ofDevice, 1e-3) << "the negative control: lavapipe filters 8 bits exactly";
    }
}

struct CloseUp {
    double normals = 0;  // degrees, 99th percentile
    double lit = 0;      // fraction of pixels off by over 2 %
};
CloseUp closeUpOf(const Frame& frame, const Frame& truth) {
    const auto channel = [](const Frame& of, Channel mode) -> const Image& { return of.channels.at(mode); };
    const Image &ids = channel(truth, Channel::material_id), &own = channel(frame, Channel::material_id);
    std::vector<double> degrees;
    std::size_t off = 0;
    for (std::size_t i = 0; i < ids.pixels(); ++i) {
        if (ids.pixel(i)[0] != own.pixel(i)[0] || ids.pixel(i)[0] < 0) continue;
        const auto vec = [&](const Frame& of, Channel mode) {
            const float* p = channel(of, mode).pixel(i);
            return glm::dvec3(p[0], p[1], p[2]);
        };
        const glm::dvec3 a = vec(frame, Channel::normals), b = vec(truth, Channel::normals);
        if (!(glm::dot(b, b) > 0.5)) continue;
        degrees.push_back(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi);
        const glm::dvec3 x = vec(frame, Channel::lit), y = vec(truth, Channel::lit);
        off += glm::length(x - y) > 0.02 * glm::length(y);
    }
    if (degrees.empty()) return {};
    std::ranges::sort(degrees);
    return {degrees[degrees.size() * 99 / 100],
            static_cast<double>(off) / static_cast<double>(degrees.size())};
}

// So close that texels are magnified: the remaining differences are level of detail, edges and half
// floats. Table in shared/material/MEASURED.md.
TEST(ExactTextures, BringAHelmetNearToTheReference) {
    const std::filesystem::path file = assets() / "flight_helmet/FlightHelmet.gltf";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: no " << file << "; the noise proves it";
    const Scene scene = loadScene(file.string());
    const auto settings = [](TexturePrecision textures) {
        Settings s = texturedImage(textures);
        s.camera = "eye=0.03,0.4,0.35 target=0,0.38,0 fov=3 near=0.01 far=10";
        return s;
    };
    const Frame truth = tracedScene(scene, settings(TexturePrecision::device));
    std::vector<CloseUp> of;
    for (const TexturePrecision textures : bothPrecisions)
        for (const Frame& frame : bothPaths(scene, settings(textures))) {
            of.push_back(closeUpOf(frame, truth));
            std::cout << nameOf(textures) << " " << frame.name << ": normals " << of.back().normals
                      << " degrees, lit " << 100 * of.back().lit << " % off by over 2 %, "
                      << static_cast<double>(frame.bytes.images) / 1048576 << " MiB of images\n";
        }
    ASSERT_EQ(of.size(), 4u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(of[i + 2].normals, 0.25 * of[i].normals);
        EXPECT_LT(of[i + 2].lit, 0.25 * of[i].lit);
    }
}

}  // namespace
}  // namespace diptych::tests
