// SPDX-License-Identifier: MIT
// Haze in both paths: compared with each other and with the reference. It does not depend on the far plane
// and changes no other channel.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "tests/image/square.h"
#include "tests/support/haze_builder.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>

namespace diptych::tests {
namespace {

const std::vector<Channel> hazeShown{Channel::lit,
                                     Channel::lit_haze,
                                     Channel::transmittance,
                                     Channel::lit_diffuse,
                                     Channel::lit_specular,
                                     Channel::lit_ambient,
                                     emission,
                                     Channel::material_id};

Settings hazeImage(float density, int steps = 0) {
    Settings settings = with(smallImage(GBufferEncoding::full), "size 96x54 haze on");
    settings.haze_density = density;
    settings.haze_march_steps = steps;
    return settings;
}

// Thick air, so that its whole effect is visible.
TEST(HazeImages, BothPathsAreEqualBitForBitAndApplyItOnce) {
    for (const char* name : {"builtin:suns", "builtin:deep", "builtin:ortho", "builtin:unlit_materials"})
        for (const int steps : {0, 6}) {
            Settings settings = with(hazeImage(3000, steps), "haze-mie-height 50 ambient 0.1,0.2,0.3");
            const std::vector<Frame> frames = bothPaths(uploaded(name).renderer, settings, hazeShown);
            const std::string what = fmt::format("{}, {} steps", name, steps);
            for (const Channel mode : hazeShown)
                EXPECT_EQ(differingPixels(frames[0], frames[1], mode), 0u)
                    << what << ", " << debugMode(mode).name;
            std::size_t applied = 0;
            for (const Frame& frame : frames) {
                EXPECT_EQ(frame.counters.unreproduced_pixels, 0u) << what;
                EXPECT_EQ(frame.counters.nonfinite_pixels, 0u) << what;
                const auto at = [&](Channel mode, std::size_t i, std::size_t c) {
                    return frame.channels.at(mode).pixel(i)[c];
                };
                for (std::size_t i = 0; i < frame.channels.at(Channel::lit).pixels(); ++i)
                    for (std::size_t c = 0; c < 3 && *frame.channels.at(Channel::material_id).pixel(i) >= 0;
                         ++c) {
                        const float sum =
                            ((at(Channel::lit_diffuse, i, c) + at(Channel::lit_specular, i, c)) +
                             at(Channel::lit_ambient, i, c)) +
                            at(emission, i, c);
                        const float expected =
                            sum * at(Channel::transmittance, i, c) + at(Channel::lit_haze, i, c);
                        EXPECT_NEAR(at(Channel::lit, i, c), expected, 1e-6f * expected)
                            << what << " " << frame.name;
                        applied += at(Channel::transmittance, i, c) < 0.99f ? 1 : 0;
                    }
            }
            EXPECT_GT(applied, 1000u) << what;
        }
}

// Haze changes only lit and its own two channels.
TEST(HazeImages, NothingElseFeelsIt) {
    UploadedScene& scene = uploaded("builtin:suns");
    Settings settings = hazeImage(300);
    settings.haze_rayleigh_height = settings.haze_mie_height = 20;  // or no sun would come through
    settings.gbuffer = GBufferEncoding::standard;
    Settings without = with(settings, "haze off haze-density 1");
    for (const Path path : drawn_paths) {
        const Frame a = drawnBy(path, scene.renderer, settings), b = drawnBy(path, scene.renderer, without);
        for (const auto& [mode, image] : b.channels) {
            const bool own =
                mode == Channel::lit || mode == Channel::lit_haze || mode == Channel::transmittance;
            EXPECT_EQ(differingPixels(a.channels.at(mode), image, true) > 0, own) << debugMode(mode).name;
        }
    }
}

// With density 0 or no scattering, every channel equals that without haze byte by byte. No pass, feature
// or memory is added.
TEST(HazeImages, OfDensityZeroIsNone) {
    UploadedScene& scene = uploaded("builtin:deep");
    Settings none = with(hazeImage(1), "haze off size 64x36");
    Settings zero = none, clear = none;
    zero.haze = clear.haze = true;
    zero.haze_density = 0;
    zero.haze_march_steps = 8;
    clear.haze_rayleigh = clear.haze_mie = {};
    SharedResources shared(device(), scene.scene, pipelines());
    SceneViews views(scene.scene);
    for (const Path path : drawn_paths) {
        const Frame expected = drawnBy(path, scene.renderer, none);
        for (Settings settings : {zero, clear}) {
            const Frame frame = drawnBy(path, scene.renderer, settings);
            for (const auto& [mode, image] : expected.channels)
                EXPECT_EQ(differingPixels(frame.channels.at(mode), image, true), 0u) << debugMode(mode).name;
            settings.path = path;
            const PreparedFrame prepared(device(), shared, views.at(viewRequest(settings)), settings);
            EXPECT_EQ(prepared.view.inputs.variant.get(gpu::FEATURE_haze), 0u);
            EXPECT_EQ(prepared.view.haze.bytes(), 0u);
            EXPECT_EQ(std::ranges::count(prepared.passes.names(), "background"), 0);
        }
        Settings some = zero;
        some.haze_density = 1;
        some.path = path;
        const PreparedFrame prepared(device(), shared, views.at(viewRequest(some)), some);
        EXPECT_NE(prepared.view.inputs.variant.get(gpu::FEATURE_haze), 0u);
        EXPECT_GT(prepared.view.haze.bytes(), 0u);
        EXPECT_EQ(std::ranges::count(prepared.passes.names(), "background"), 1);
    }
}

// The background and all surfaces, for both models; the reference integrates by quadrature.
TEST(HazeImages, AreTheReferences) {
    for (const char* name : {"builtin:deep", "builtin:ortho"})
        for (const int steps : {0, 64})
            for (const ReferenceMode mode : {ReferenceMode::surface, ReferenceMode::scene}) {
                UploadedScene& scene = uploaded(name);
                Settings settings = with(hazeImage(3, steps), "size 64x36 ambient 0.01,0.02,0.03");
                if (name == std::string_view("builtin:ortho")) settings.haze_density = 3000;
                const Frame frame = drawnBy(Path::deferred, scene.renderer, settings, hazeShown);
                settings.reference_mode = mode;
                const Frame truth = drawnBy(Path::reference, scene.renderer, settings, hazeShown);
                double max_haze = 0, max_background = 0, largest = 0;
                std::size_t background = 0, off = 0;
                for (std::size_t i = 0; i < frame.channels.at(Channel::lit).pixels(); ++i) {
                    const bool surface = *frame.channels.at(Channel::material_id).pixel(i) >= 0;
                    if (surface != (*truth.channels.at(Channel::material_id).pixel(i) >= 0)) continue;
                    for (std::size_t c = 0; c < 3; ++c) {
                        const auto apart = [&](Channel channel) {
                            return std::abs(double{frame.channels.at(channel).pixel(i)[c]} -
                                            double{truth.channels.at(channel).pixel(i)[c]});
                        };
                        // In mode scene the reference's own rays hit surfaces at their exact depth.
                        off += apart(Channel::transmittance) > (mode == ReferenceMode::surface ? 1e-6 : 1e-4)
                                   ? 1
                                   : 0;
                        max_haze = std::max(max_haze, apart(Channel::lit_haze));
                        largest = std::max(largest, double{truth.channels.at(Channel::lit_haze).pixel(i)[c]});
                        if (!surface) max_background = std::max(max_background, apart(Channel::lit));
                    }
                    background += surface ? 0 : 1;
                }
                const std::string what = fmt::format("{}, {} steps, {}", name, steps, nameOf(mode));
                EXPECT_EQ(off, 0u) << what;
                // Error of 64 steps; rounding of the closed form; error of the stored depth.
                const double allowed = steps > 0 ? 5e-3 : mode == ReferenceMode::surface ? 2e-6 : 1e-4;
                EXPECT_LT(max_haze, allowed * std::max(largest, 0.1)) << what;
                EXPECT_LT(max_background, allowed * std::max(largest, 0.1)) << what;
                EXPECT_GT(background, 100u) << what;
                EXPECT_GT(largest, 1e-3) << what;
            }
}

// Positions come from depth, whose bits depend on the far plane; the background has no depth.
TEST(HazeImages, AreTheSameForAnyFarPlane) {
    UploadedScene& scene = uploaded("builtin:deep");
    const auto view = [&](Path path, const char* far) {
        Settings settings = hazeImage(3);
        settings.camera = fmt::format("eye=0,2,8 target=1,2,0 fov=50 near=0.1{}", far);
        return drawnBy(path, scene.renderer, settings, hazeShown);
    };
    for (const Path path : drawn_paths) {
        const Frame endless = view(path, "");
        std::size_t background = 0;
        for (const char* far : {" far=2e5", " far=1e9"}) {
            const Frame frame = view(path, far);
            for (std::size_t i = 0; i < frame.channels.at(Channel::lit).pixels(); ++i) {
                const bool surface = *frame.channels.at(Channel::material_id).pixel(i) >= 0;
                ASSERT_EQ(surface, *endless.channels.at(Channel::material_id).pixel(i) >= 0);
                background += surface ? 0 : 1;
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto of = [&](const Frame& f, Channel mode) {
                        return f.channels.at(mode).pixel(i)[c];
                    };
                    if (!surface) {
                        EXPECT_EQ(of(frame, Channel::lit), of(endless, Channel::lit)) << far;
                    }
                    EXPECT_NEAR(of(frame, Channel::transmittance), of(endless, Channel::transmittance), 2e-6f)
                        << far;
                    EXPECT_NEAR(of(frame, Channel::lit_haze), of(endless, Channel::lit_haze), 2e-6f) << far;
                }
            }
        }
        EXPECT_GT(background, 1000u);
    }
}

// A level view of the background: from just below to just above the horizon, light changes smoothly.
TEST(HazeImages, HaveNoBandAtTheHorizon) {
    UploadedScene& scene = uploaded("builtin:background");
    for (const int steps : {0, 8}) {
        Settings settings = hazeImage(1, steps);
        settings.size = {2, 200};
        settings.camera = "eye=0,2,1e7 target=0,2,2e7 fov=4 near=0.1";
        settings.ambient = {1, 1, 1};
        for (const Path path : drawn_paths) {
            const Frame frame = drawnBy(path, scene.renderer, settings, {Channel::lit, Channel::material_id});
            const Image& image = frame.channels.at(Channel::lit);
            double max = 0, whole = 0;
            for (int y = 1; y < image.height; ++y) {
                ASSERT_LT(frame.channels.at(Channel::material_id).at(0, y, 0), 0.0f);
                max = std::max(max, std::abs(double{image.at(0, y, 2)} - double{image.at(0, y - 1, 2)}));
                whole = std::max(whole, double{image.at(0, y, 2)});
            }
            EXPECT_GT(whole, 0.5) << nameOf(path);
            // A row is 1/50 degree.
            EXPECT_LT(max, 0.01 * whole) << nameOf(path) << ", " << steps;
        }
    }
}

}  // namespace
}  // namespace diptych::tests
