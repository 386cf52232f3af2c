// SPDX-License-Identifier: MIT
// What the scene is drawn to and computed with: formats of depth and radiance, floats of 16 bits for light.
// Each is held against the error that its own bits allow, and both paths are the same picture with each.
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

constexpr int depthChannel = static_cast<int>(gpu::DEBUG_depth);

// A floor from the near plane to the far one, 0.1 m to 1000 m, seen along it from 1 m above.
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

// The largest relative error of the view depth over the floor's pixels. The floor lies 1 m below the eye: the
// depth of a row is 1 / -y of its ray, exactly.
double worstDepth(const Frame& frame) {
    const Image& depths = frame.channels.at(depthChannel);
    double worst = 0;
    for (int y = 0; y < depths.height; ++y) {
        const double down = 2 * (y + 0.5) / depths.height - 1;  // of the ray at depth 1, as fov is 90 degrees
        const double depth = 1 / down;
        if (down <= 0 || depth > 990) continue;
        for (int x = 0; x < depths.width; ++x) {
            const double got = depths.pixel(static_cast<std::size_t>(y) * depths.width + x)[0];
            worst = std::max(worst, std::abs(got - depth) / depth);
        }
    }
    return worst;
}

// z = n f / (f - n) (1 / d - 1 / f): an error dz of it is one of d (f - n) / (n f) dz of d relative to d. The
// farthest row of the picture lies at 240 m, where d / n is 2400.
TEST(Precision, DepthIsAsExactAsItsFormat) {
    const Scene scene = longFloor();
    Renderer renderer(device(), scene, pipelines());
    struct Row {
        DepthFormat format;
        double step;        // the most that the format rounds z by, at d = 240 m
        double rasterised;  // and what a rasteriser's sum of three products does, where z is near 1
    };
    const double amplified = 240 * (1000 - 0.1) / (0.1 * 1000);
    for (const Row& row : {Row{DepthFormat::d32f_standard, 0x1p-25, 3 * 0x1p-24},
                           {DepthFormat::d24, 0.5 / 16777215, 0},
                           {DepthFormat::d16, 0.5 / 65535, 0}})
        for (const Path path : drawn_paths) {
            Settings settings = precise();
            settings.depth_format = row.format;
            const double worst = worstDepth(drawnBy(path, renderer, settings, {depthChannel}));
            const std::string what = fmt::format("{}, {}: {:.3g}", nameOf(row.format), nameOf(path), worst);
            const double rounded = amplified * (row.step + row.rasterised);
            // The floor's triangles are a thousand times as wide as the eye is high: that alone is 2e-5. What
            // is relative to a distance that is too far is more by the square of the error.
            EXPECT_LT(worst, rounded + 2e-5 + 1.5 * rounded * rounded) << what;
            // Few rows are as far away as the farthest, and each is rounded by chance.
            EXPECT_GT(worst, 0.3 * amplified * row.step) << what;
        }
    // Reversed floats keep the depth as well as the rasteriser does.
    EXPECT_LT(worstDepth(drawnBy(Path::deferred, renderer, precise(), {depthChannel})), 2e-5);
}

// With every format both paths draw one picture, of the same bits.
TEST(Precision, BothPathsAreEqualBitForBit) {
    const std::vector<int> shown{lit, depthChannel, static_cast<int>(gpu::DEBUG_lit_specular)};
    for (const char* name : {"builtin:cutout", "builtin:glass"})
        for (const auto& [option, value] : {std::pair("depth-format", "d32f-standard"),
                                            {"depth-format", "d24"},
                                            {"depth-format", "d16"},
                                            {"lit-format", "fp16"},
                                            {"lit-format", "b10g11r11"},
                                            {"shading-precision", "fp16"}}) {
            Settings settings = smallPicture(GBufferEncoding::full);
            settings.set(option, value);
            const std::vector<Frame> frames = bothPaths(uploaded(name).renderer, settings, shown);
            for (const auto& [mode, image] : frames[0].channels) {
                const auto other = frames[1].channels.find(mode);
                if (other == frames[1].channels.end()) continue;
                EXPECT_EQ(differingPixels(image, other->second), 0u)
                    << name << " --" << option << " " << value << ", " << debugMode(mode).name;
            }
            for (const Frame& frame : frames) {
                EXPECT_EQ(frame.counters.unreproduced_pixels, 0u) << name << " " << value;
                EXPECT_EQ(frame.counters.nonfinite_pixels, 0u) << name << " " << value;
            }
        }
}

// The picture covers the same pixels, and an environment the rest, whichever way depth runs.
TEST(Precision, NothingIsLostToTheBackground) {
    for (const DepthFormat format : {DepthFormat::d32f_standard, DepthFormat::d24, DepthFormat::d16}) {
        Settings settings = smallPicture(GBufferEncoding::full);
        const std::vector<int> idOnly{static_cast<int>(gpu::DEBUG_material_id)};
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

// Radiance is rounded once to a float of 10, 6 or 5 bits of mantissa: by half a step to nearest, by a whole
// one where a device cuts, which Vulkan allows.
TEST(Precision, RadianceIsRoundedToItsFormat) {
    for (const auto& [format, bits] :
         {std::pair(LitFormat::fp16, std::array{10, 10, 10}), {LitFormat::b10g11r11, std::array{6, 6, 5}}}) {
        Settings settings = smallPicture(GBufferEncoding::full);
        UploadedScene& scene = uploaded("builtin:points");
        const Frame exact = drawnBy(Path::forward_plus, scene.renderer, settings, {lit});
        settings.lit_format = format;
        const Frame rounded = drawnBy(Path::forward_plus, scene.renderer, settings, {lit});
        std::array<double, 3> worst{};
        for (std::size_t i = 0; i < exact.channels.at(lit).pixels(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const double a = exact.channels.at(lit).pixel(i)[c], b = rounded.channels.at(lit).pixel(i)[c];
                if (a < 1e-4) continue;  // 2^-14 is the least number with all bits
                worst[c] = std::max(worst[c], std::abs(a - b) / a);
            }
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_LE(worst[c], std::exp2(-bits[c])) << nameOf(format) << " component " << c;
            EXPECT_GE(worst[c], 0.45 * std::exp2(-bits[c] - 1)) << nameOf(format) << " component " << c;
        }
    }
}

// Floats of 16 bits have 11 bits of mantissa; directions and half vectors of them are off by 5e-4, which a
// highlight of roughness 0.1 shows some fifty times larger. Where nothing shines, it is little.
TEST(Precision, HalfShadingIsNearAndFinite) {
    Settings settings = smallPicture(GBufferEncoding::full);
    UploadedScene& scene = uploaded("builtin:spheres");
    const std::vector<int> shown{lit, static_cast<int>(gpu::DEBUG_lit_diffuse)};
    const Frame exact = drawnBy(Path::deferred, scene.renderer, settings, shown);
    settings.shading_precision = ShadingPrecision::fp16;
    const Frame half = drawnBy(Path::deferred, scene.renderer, settings, shown);
    EXPECT_EQ(half.counters.nonfinite_pixels, 0u);
    for (const auto& [mode, most] : {std::pair(shown[0], 2e-2), {shown[1], 2e-3}}) {
        double error = 0, sum = 0;
        const Image &a = exact.channels.at(mode), &b = half.channels.at(mode);
        for (std::size_t i = 0; i < a.pixels(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                error += std::abs(double{a.pixel(i)[c]} - double{b.pixel(i)[c]});
                sum += double{a.pixel(i)[c]};
            }
        EXPECT_GT(error, 0.0) << debugMode(mode).name;
        EXPECT_LT(error, most * sum) << debugMode(mode).name << ": " << error / sum;
    }
}

}  // namespace
}  // namespace diptych::tests
