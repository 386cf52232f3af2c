// SPDX-License-Identifier: MIT
// Formats of depth and radiance, and 16-bit floats for light. Each is compared with the error bound of its
// bits, and both paths agree with each.
#include "shared/scene/view.h"
#include "tests/image/square.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

// A floor from the near plane to the far plane, 0.1 m to 1000 m, seen at a grazing angle from 1 m above.
Scene longFloor() {
    Scene scene = square();
    Primitive& p = scene.meshes[0].primitives[0];
    p.positions = {{-2000, -1, 2}, {2000, -1, 2}, {2000, -1, -1100}, {-2000, -1, -1100}};
    p.normals.assign(4, {0, 1, 0});
    scene.cameras[0].near = 0.1;
    scene.cameras[0].far = 1000;
    scene.cameras[0].world_from_camera = glm::dmat4(1.0);
    return scene;
}

Settings precise() {
    Settings settings;
    settings.size = {64, 240};
    settings.gbuffer = GBufferEncoding::full;
    settings.shadows = Shadows::off;
    return settings;
}

// The largest relative error of view depth over the floor's pixels. The floor is 1 m below the eye: a
// row's depth is exactly 1 / -y of its ray.
double worstDepth(const Frame& frame) {
    const Image& depths = frame.channels.at(Channel::depth);
    double worst = 0;
    for (int y = 0; y < depths.height; ++y) {
        const double down = 2 * (y + 0.5) / depths.height - 1;  // of the ray at depth 1; fov is 90 degrees
        const double depth = 1 / down;
        if (down <= 0 || depth > 990) continue;
        for (int x = 0; x < depths.width; ++x) {
            const double got = depths.pixel(static_cast<std::size_t>(y) * depths.width + x)[0];
            worst = std::max(worst, std::abs(got - depth) / depth);
        }
    }
    return worst;
}

// z = n f / (f - n) (1 / d - 1 / f): an error dz gives a relative error of d (f - n) / (n f) dz in d. The
// image's farthest row is at 240 m, where d / n is 2400.
TEST(Precision, DepthIsAsExactAsItsFormat) {
    const Scene scene = longFloor();
    Renderer renderer(device(), scene, pipelines());
    struct Row {
        DepthFormat format;
        double step;        // maximum rounding of z at d = 240 m
        double rasterised;  // plus the rasteriser's sum of three products, near z = 1
    };
    const double amplified = 240 * (1000 - 0.1) / (0.1 * 1000);
    for (const Row& row : {Row{DepthFormat::d32f_standard, 0x1p-25, 3 * 0x1p-24},
                           {DepthFormat::d24, 0.5 / 16777215, 0},
                           {DepthFormat::d16, 0.5 / 65535, 0}})
        for (const Path path : drawn_paths) {
            Settings settings = precise();
            settings.depth_format = row.format;
            const double worst = worstDepth(drawnBy(path, renderer, settings, {Channel::depth}));
            const std::string what = fmt::format("{}, {}: {:.3g}", nameOf(row.format), nameOf(path), worst);
            const double rounded = amplified * (row.step + row.rasterised);
            // The floor's triangles are a thousand times wider than the eye's height, which alone gives
            // 2e-5. Errors relative to an overestimated distance grow by their square.
            EXPECT_LT(worst, rounded + 2e-5 + 1.5 * rounded * rounded) << what;
            // Few rows are as far away as the farthest, and each rounds randomly.
            EXPECT_GT(worst, 0.3 * amplified * row.step) << what;
        }
    // Reversed float depth is as accurate as the rasteriser.
    EXPECT_LT(worstDepth(drawnBy(Path::deferred, renderer, precise(), {Channel::depth})), 2e-5);
}

// With every format both paths give the same bits.
TEST(Precision, BothPathsAreEqualBitForBit) {
    const std::vector<Channel> shown{Channel::lit, Channel::depth, Channel::lit_specular};
    for (const char* name : {"builtin:cutout", "builtin:glass"})
        for (const auto& [option, value] : {std::pair("depth-format", "d32f-standard"),
                                            {"depth-format", "d24"},
                                            {"depth-format", "d16"},
                                            {"lit-format", "fp16"},
                                            {"lit-format", "b10g11r11"},
                                            {"shading-precision", "fp16"}}) {
            Settings settings = smallImage(GBufferEncoding::full);
            settings.set(option, value);
            const std::vector<Frame> frames = bothPaths(uploaded(name).renderer, settings, shown);
            for (const auto& [mode, image] : frames[0].channels) {
                if (const Image* const other = findChannel(frames[1], mode)) {
                    EXPECT_EQ(differingPixels(image, *other), 0u)
                        << name << " --" << option << " " << value << ", " << debugMode(mode).name;
                }
            }
            for (const Frame& frame : frames) {
                EXPECT_EQ(frame.counters.unreproduced_pixels, 0u) << name << " " << value;
                EXPECT_EQ(frame.counters.nonfinite_pixels, 0u) << name << " " << value;
            }
        }
}

// The same pixels are covered in either depth direction; the environment covers the rest.
TEST(Precision, NothingIsLostToTheBackground) {
    for (const DepthFormat format : {DepthFormat::d32f_standard, DepthFormat::d24, DepthFormat::d16}) {
        Settings settings = smallImage(GBufferEncoding::full);
        const std::vector<Channel> idOnly{Channel::material_id};
        const Frame plain = drawnBy(Path::deferred, uploaded("builtin:deep").renderer, settings, idOnly);
        settings.depth_format = format;
        for (const Path path : drawn_paths) {
            const Frame drawn = drawnBy(path, uploaded("builtin:deep").renderer, settings, idOnly);
            std::size_t lost = 0, covered = 0;
            for (std::size_t i = 0; i < plain.channels.at(idOnly[0]).pixels(); ++i) {
                covered += *plain.channels.at(idOnly[0]).pixel(i) >= 0;
                lost += (*plain.channels.at(idOnly[0]).pixel(i) >= 0) !=
                        (*drawn.channels.at(idOnly[0]).pixel(i) >= 0);
            }
            EXPECT_EQ(lost, 0u) << nameOf(format) << " " << nameOf(path);
            EXPECT_GT(covered, 1000u);
        }
    }
}

// Radiance is rounded once to 10, 6 or 5 bits of mantissa: by half a ULP to nearest, or by a whole one if
// a device truncates, as Vulkan allows.
TEST(Precision, RadianceIsRoundedToItsFormat) {
    for (const auto& [format, bits] :
         {std::pair(LitFormat::fp16, std::array{10, 10, 10}), {LitFormat::b10g11r11, std::array{6, 6, 5}}}) {
        Settings settings = smallImage(GBufferEncoding::full);
        UploadedScene& scene = uploaded("builtin:points");
        const Frame exact = drawnBy(Path::forward_plus, scene.renderer, settings, {Channel::lit});
        settings.lit_format = format;
        const Frame rounded = drawnBy(Path::forward_plus, scene.renderer, settings, {Channel::lit});
        std::array<double, 3> worst{};
        for (std::size_t i = 0; i < exact.channels.at(Channel::lit).pixels(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const double a = exact.channels.at(Channel::lit).pixel(i)[c],
                             b = rounded.channels.at(Channel::lit).pixel(i)[c];
                if (a < 1e-4) continue;  // 2^-14 is the smallest normal number
                worst[c] = std::max(worst[c], std::abs(a - b) / a);
            }
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_LE(worst[c], std::exp2(-bits[c])) << nameOf(format) << " component " << c;
            EXPECT_GE(worst[c], 0.45 * std::exp2(-bits[c] - 1)) << nameOf(format) << " component " << c;
        }
    }
}

// Half floats have 11 significant bits: directions and half vectors err by 5e-4. A highlight of roughness
// 0.1 magnifies that some fifty times; elsewhere the error is small.
TEST(Precision, HalfShadingIsNearAndFinite) {
    Settings settings = smallImage(GBufferEncoding::full);
    UploadedScene& scene = uploaded("builtin:spheres");
    const std::vector<Channel> shown{Channel::lit, Channel::lit_diffuse};
    const Frame exact = drawnBy(Path::deferred, scene.renderer, settings, shown);
    settings.shading_precision = ShadingPrecision::fp16;
    const Frame half = drawnBy(Path::deferred, scene.renderer, settings, shown);
    EXPECT_EQ(half.counters.nonfinite_pixels, 0u);
    for (const auto& [mode, max] : {std::pair(shown[0], 2e-2), {shown[1], 2e-3}}) {
        double error = 0, sum = 0;
        const Image &a = exact.channels.at(mode), &b = half.channels.at(mode);
        for (std::size_t i = 0; i < a.pixels(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                error += std::abs(double{a.pixel(i)[c]} - double{b.pixel(i)[c]});
                sum += double{a.pixel(i)[c]};
            }
        EXPECT_GT(error, 0.0) << debugMode(mode).name;
        EXPECT_LT(error, max * sum) << debugMode(mode).name << ": " << error / sum;
    }
}

}  // namespace
}  // namespace diptych::tests
