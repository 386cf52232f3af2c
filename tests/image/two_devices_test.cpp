// SPDX-License-Identifier: MIT
// Both paths on a device and on a second one with a fault in its textures, their curve, its lights or its
// geometry. Each fault is attributed to its cause.
#include "compare/experiment/two_devices.h"
#include "compare/explain/device_contributions.h"
#include "compare/explain/explain.h"
#include "compare/frames/frame_properties.h"
#include "compare/verdict/pair_reports.h"
#include "tests/image/scenes.h"
#include "tests/support/srgb.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>

namespace diptych::tests {
namespace {

constexpr const char* name = "builtin:gallery";

std::array<Settings, 2> drawnSettings() {
    std::array<Settings, 2> both;
    for (std::size_t path = 0; path < 2; ++path) {
        both[path].path = drawn_paths[path];
        both[path].size = {80, 45};
    }
    return both;
}

RenderOptions drawnOptions() {
    RenderOptions options;
    for (const DebugMode& mode : debugModes()) options.channels.push_back(mode.channel);
    options.runs = 0;
    options = evaluatedOptions(options, std::vector<Settings>(1), false, true, Twice::none);
    return options;
}

std::vector<Frame> drawn(Renderer& renderer) {
    std::vector<Frame> frames;
    for (const Settings& settings : drawnSettings())
        frames.push_back(renderer.draw(settings, drawnOptions()));
    return frames;
}

// The correct device.
struct Right {
    UploadedScene& uploaded = tests::uploaded(name);
    SceneViews views{uploaded.scene};
    std::vector<Frame> frames = drawn(uploaded.renderer);
    std::array<DevicePrecision, 2> precision = precisionsOf(device(), device(), true);
};
Right& right() {
    static Right instance;
    return instance;
}

// The same device in place of a second one, with a modified scene or Frames.
Report against(const std::function<void(Scene&)>& plant, const std::function<void(Frame&)>& after = {}) {
    Right& here = right();
    Scene scene = here.uploaded.scene;
    if (plant) plant(scene);
    Renderer there(device(), scene, pipelines());
    ViewFrames view{here.frames, here.views.at(viewRequest(drawnSettings()[0])).needs};
    view.there = drawn(there);
    for (Frame& other : view.there) {
        if (after) after(other);
        other.name += "-there";
        AcrossDevices& across = view.across[other.settings.path] = experiment::acrossDevices(
            here.uploaded.scene, here.views.at(viewRequest(other.settings)), here.precision, view.frames[1]);
        across.relit = experiment::relit(device(), here.uploaded.renderer, other);
    }
    return makeReport({view}, reportDevice(device()), {}, {}, reportDevice(device()));
}

// The failures of each path across both devices: deferred, forward+.
std::array<std::string, 2> faults(const Report& report) {
    std::array<std::string, 2> text;
    for (const std::size_t path : {0, 1}) {
        const Comparison& comparison = report.comparisons.at(1 + path);
        for (const std::string& failure : comparison.failures) text[path] += failure + "; ";
        for (const ChannelDiff& channel : comparison.channels)
            if (channel.verdict == Verdict::fail) text[path] += std::string(channel.mode->name) + " ";
    }
    return text;
}

void eachBaseColorTexel(Scene& scene, const std::function<double(int)>& of) {
    for (const Material& material : scene.materials)
        if (const int texture = material.base_color_texture.texture; texture >= 0) {
            TextureImage& image = scene.images[static_cast<std::size_t>(
                scene.textures[static_cast<std::size_t>(texture)].image)];
            for (std::size_t i = 0; i < image.rgba.size(); ++i)
                if (i % 4 != 3)
                    image.rgba[i] =
                        static_cast<std::uint8_t>(std::clamp(std::lround(of(image.rgba[i])), 0L, 255L));
        }
}

TEST(TwoDevices, OneDeviceTwiceDoesNotDifferAnywhere) {
    const Report report = against({});
    EXPECT_TRUE(report.passed());
    ASSERT_EQ(report.comparisons.size(), 4u);
    for (const std::size_t pair : {1, 2})
        for (const ChannelDiff& channel : report.comparisons[pair].channels) {
            EXPECT_EQ(channel.stats.max, 0) << channel.mode->name;
            EXPECT_EQ(channel.device_use ? channel.device_use->used : 0, 0) << channel.mode->name;
        }
}

TEST(TwoDevices, TexelsThatAreOneCodeOffAreFound) {
    const Report report =
        against([](Scene& scene) { eachBaseColorTexel(scene, [](int c) { return c + 1; }); });
    EXPECT_NE(faults(report)[1].find("albedo "), std::string::npos) << faults(report)[1];
    EXPECT_EQ(faults(report)[1].find("lit "), std::string::npos) << "light follows its surfaces";
}

TEST(TwoDevices, AWrongCurveIsFound) {
    const Report report = against([](Scene& scene) {
        // Codes decoded with a power of 2.2, re-encoded as sRGB.
        eachBaseColorTexel(scene, [](int c) { return 255 * encodedSrgb(std::pow(c / 255.0, 2.2)); });
    });
    EXPECT_NE(faults(report)[1].find("albedo "), std::string::npos) << faults(report)[1];
}

TEST(TwoDevices, AMissingLightIsFound) {
    const Report report = against([](Scene& scene) { scene.lights.pop_back(); });
    for (const std::string& fault : faults(report)) EXPECT_NE(fault.find("lit "), std::string::npos) << fault;
}

TEST(TwoDevices, AnImageOfAPixelElsewhereIsFound) {
    const Report report = against({}, [](Frame& frame) {
        for (auto& [mode, image] : frame.channels)
            for (int y = 0; y < image.height; ++y)
                for (int x = image.width - 1; x > 0; --x)
                    std::copy_n(&image.at(x - 1, y, 0), image.components, &image.at(x, y, 0));
    });
    for (const std::string& fault : faults(report))
        EXPECT_NE(fault.find("the other device shows another triangle"), std::string::npos) << fault;
}

TEST(TwoDevices, AnExplanationSaysWhereADifferenceComesFrom) {
    Right& here = right();
    Scene scene = here.uploaded.scene;
    eachBaseColorTexel(scene, [](int c) { return 0.9 * c; });
    Renderer there(device(), scene, pipelines());
    RenderOptions options = drawnOptions();
    const Frame other = there.draw(drawnSettings()[1], options);
    const Frame& own = here.frames[1];
    const Explanation explanation =
        explain(device(), here.uploaded.renderer, here.uploaded.scene, own, other);
    const std::vector<DeviceContribution> fractions = deviceContributions(
        explanation, own, other,
        experiment::acrossDevices(here.uploaded.scene, here.views.at(viewRequest(own.settings)),
                                  here.precision, own));
    EXPECT_EQ(fractions.front().name, "textures");
    double all = 0;
    std::string sentence;
    for (const DeviceContribution& fraction : fractions) {
        all += fraction.contribution;
        sentence += fmt::format("{}: {:.3g}; ", fraction.name, fraction.contribution);
    }
    EXPECT_NEAR(all, explanation.distance, 1e-6 * explanation.distance);
    // Vertex snapping is first attributed the change that a sub-pixel step may cause.
    EXPECT_GT(fractions.front().contribution, 0.95 * explanation.distance) << sentence;
}

}  // namespace
}  // namespace diptych::tests
