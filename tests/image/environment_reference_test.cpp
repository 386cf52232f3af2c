// SPDX-License-Identifier: MIT
// Environment light in both paths against the reference, which integrates it. The approximations pass
// within their known error; faults fail.
#include "compare/verdict/pair_reports.h"
#include "tests/bench/environment_errors.h"
#include "tests/image/scenes.h"

#include <fmt/format.h>

#include <cmath>

namespace diptych::tests {
namespace {

// White spheres from smooth to rough, metal and dielectric, lit only by a sky with a lamp.
Scene spheresUnderLamp() {
    Scene scene = loadScene("builtin:furnace");
    scene.environment = environment_errors::lampSky(64);
    scene.lights.clear();
    return scene;
}

Settings byEnvironment() {
    Settings settings = with(smallImage(GBufferEncoding::full), "size 48x27 shadows off");
    return settings;
}

class EvaluatedEnvironment {
public:
    explicit EvaluatedEnvironment(const Settings& settings) : settings_(settings) {
        Settings truth = settings;
        truth.path = Path::reference;
        RenderOptions options = untimed(allChannels());
        options.environment_errors = true;
        reference_ = renderer_.draw(truth, options);
    }
    // Draws `scene` with settings `drawn`, then modifies the frames by `plant`.
    Report verdict(const Scene& scene, const Settings& drawn,
                   const std::function<void(Frame&)>& plant = {}) const {
        std::vector<Frame> frames{reference_};
        for (Frame& frame : bothPaths(scene, drawn)) {
            if (plant) plant(frame);
            frames.push_back(std::move(frame));
        }
        const Requirements needs = requirements(scene_, poseAt(scene_, 0));
        const DeviceInfo& info = device().info();
        return makeReport({{std::move(frames), needs}}, {info.name, info.driver, info.type});
    }
    Report verdict() const { return verdict(scene_, settings_); }
    const Scene& scene() const { return scene_; }
    const Settings& settings() const { return settings_; }
    const Frame& reference() const { return reference_; }

private:
    Scene scene_ = spheresUnderLamp();
    Settings settings_;
    Renderer renderer_{device(), scene_, pipelines()};
    Frame reference_;
};

// Failed channels of both paths against the reference.
std::vector<std::string> failing(const Report& report) {
    std::vector<std::string> names;
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
        for (const ChannelDiff& channel : report.comparisons.at(i).channels)
            if (channel.verdict == Verdict::fail)
                names.push_back(fmt::format("{} {}: {}", i, channel.mode->name, channel.reason));
    return names;
}
bool fails(const Report& report, std::size_t comparison, Channel mode) {
    for (const ChannelDiff& channel : report.comparisons.at(comparison).channels)
        if (channel.mode->channel == mode) return channel.verdict == Verdict::fail;
    return false;
}

const EvaluatedEnvironment& lampEvaluated() {
    static const EvaluatedEnvironment evaluated(byEnvironment());
    return evaluated;
}

TEST(EnvironmentReference, EveryWayToTakeItPassesByWhatItCosts) {
    const EvaluatedEnvironment& evaluated = lampEvaluated();
    for (const IblDiffuse diffuse : {IblDiffuse::sh, IblDiffuse::sh_windowed, IblDiffuse::map}) {
        Settings settings = evaluated.settings();
        settings.ibl_diffuse = diffuse;
        EXPECT_EQ(failing(evaluated.verdict(evaluated.scene(), settings)), std::vector<std::string>{})
            << nameOf(diffuse);
    }
    Settings sampled = evaluated.settings();
    sampled.ibl = Ibl::sampled;
    for (const int samples : {64, 256}) {
        sampled.ibl_samples = samples;
        EXPECT_EQ(failing(evaluated.verdict(evaluated.scene(), sampled)), std::vector<std::string>{})
            << samples;
    }
    ASSERT_TRUE(evaluated.reference().hidden_light);
    EXPECT_GT(evaluated.reference().hidden_light->p99, 0) << "spheres hide some of the sky from each other";
}

TEST(EnvironmentReference, AWrongRotationFails) {
    Settings settings = lampEvaluated().settings();
    settings.env_rotation = 5;
    const Report report = lampEvaluated().verdict(lampEvaluated().scene(), settings);
    for (const std::size_t path : {0u, 1u})
        for (const Channel mode : {Channel::lit, Channel::lit_diffuse, Channel::lit_specular})
            EXPECT_TRUE(fails(report, path, mode)) << path << " " << debugMode(mode).name;
}

// One level of the maps is half an octave of alpha.
TEST(EnvironmentReference, AMapOneLevelOffFails) {
    Scene scene = lampEvaluated().scene();
    for (Material& m : scene.materials)
        m.roughness = static_cast<float>(std::min(1.0, double{m.roughness} * std::exp2(0.25)));
    const Report report = lampEvaluated().verdict(scene, lampEvaluated().settings());
    for (const std::size_t path : {0u, 1u}) EXPECT_TRUE(fails(report, path, Channel::lit_specular)) << path;
}

TEST(EnvironmentReference, WithoutOneOverPiItFails) {
    const Report report =
        lampEvaluated().verdict(lampEvaluated().scene(), lampEvaluated().settings(), [](Frame& frame) {
            for (float& v : frame.channels.at(Channel::lit_diffuse).data) v *= std::numbers::pi_v<float>;
        });
    for (const std::size_t path : {0u, 1u}) EXPECT_TRUE(fails(report, path, Channel::lit_diffuse)) << path;
}

// A tenth exceeds the whole tolerance where the approximations are nearly exact.
TEST(EnvironmentReference, ABrighterEnvironmentFails) {
    Settings settings = lampEvaluated().settings();
    settings.ibl_intensity = 1.1f;
    const Report report = lampEvaluated().verdict(lampEvaluated().scene(), settings);
    for (const std::size_t path : {0u, 1u}) EXPECT_TRUE(fails(report, path, Channel::lit)) << path;
}

}  // namespace
}  // namespace diptych::tests
