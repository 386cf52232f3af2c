// SPDX-License-Identifier: MIT
// Conventions in which renderers differ, in both paths and the reference: how a coloured layer attenuates
// the base, how a spot fades, how a light ends at its range.
#include "compare/explain/conventions.h"
#include "compare/explain/explain.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/scenes.h"

#include <array>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

struct Convention {
    const char *option, *value, *scene;
    Multiscatter multiscatter = Multiscatter::off;
    bool of_ambient = false;  // whether it changes ambient light too
};

// Scenes sensitive to them: coloured layers, spots, lights that end within the view.
constexpr std::array conventions{
    Convention{"base-layer", "component", "builtin:dielectrics", Multiscatter::off, true},
    Convention{"base-layer", "component", "builtin:dielectrics", Multiscatter::energy, true},
    Convention{"base-layer", "component", "builtin:gallery", Multiscatter::fdez, true},
    Convention{"spot-cone", "smoothstep", "builtin:spots"},
    Convention{"range-window", "squared", "builtin:range_edge"},
    Convention{"range-window", "squared", "builtin:areas"},
};

class Conventions : public testing::TestWithParam<Convention> {};

Settings withConvention(const Convention& convention, bool switched) {
    Settings settings = with(smallImage(GBufferEncoding::full), "shadows off size 96x54 ambient 0.3,0.4,0.5");
    settings.multiscatter = convention.multiscatter;
    if (switched) settings.set(convention.option, convention.value);
    return settings;
}

// In every channel of light, the 99th percentile of the error grows by at most a quarter: the convention
// adds no error of its own.
TEST_P(Conventions, BothPathsAreTheReference) {
    const Convention& convention = GetParam();
    UploadedScene& scene = uploaded(convention.scene);
    const RenderOptions options =
        untimed({Channel::lit_ambient, Channel::lit_specular, Channel::lit_diffuse, Channel::material_id});
    struct Drawn {
        Frame reference;
        std::vector<Frame> paths;
    };
    std::vector<Drawn> drawn;
    for (const bool switched : {false, true}) {
        const Settings settings = withConvention(convention, switched);
        Settings asked = settings;
        asked.path = Path::reference;
        drawn.push_back(
            {scene.renderer.draw(asked, options), bothPaths(scene.renderer, settings, options.channels)});
    }
    const auto p99 = [&](const Drawn& side, std::size_t path, Channel channel) {
        const DebugMode& mode = debugMode(channel);
        return channelStats(mode.error_kind, mode.kind, side.reference.channels.at(channel),
                            side.paths[path].channels.at(channel), coverage(side.reference, side.paths[path]))
            .p99;
    };
    for (std::size_t path = 0; path < 2; ++path)
        for (const Channel channel : {Channel::lit_ambient, Channel::lit_specular, Channel::lit_diffuse}) {
            EXPECT_LE(p99(drawn[1], path, channel), 1.25 * p99(drawn[0], path, channel) + 1e-5)
                << drawn[1].paths[path].name << " " << debugMode(channel).name;
        }
    // It changes its own effect by far more than that.
    const auto change = [&](Channel channel) {
        const DebugMode& mode = debugMode(channel);
        return channelStats(mode.error_kind, mode.kind, drawn[0].paths[0].channels.at(channel),
                            drawn[1].paths[0].channels.at(channel),
                            coverage(drawn[0].paths[0], drawn[1].paths[0]))
            .max;
    };
    EXPECT_GT(change(Channel::lit_diffuse), 0.05);
    EXPECT_EQ(change(Channel::lit_ambient) > 0.01, convention.of_ambient);
}

TEST_P(Conventions, BothPathsAreEqualBitForBit) {
    const Convention& convention = GetParam();
    UploadedScene& scene = uploaded(convention.scene);
    const std::vector<Frame> both =
        bothPaths(scene.renderer, withConvention(convention, true), {Channel::lit});
    EXPECT_EQ(differingPixels(both[0], both[1], Channel::lit), 0u);
}

INSTANTIATE_TEST_SUITE_P(Builtin, Conventions, testing::ValuesIn(conventions), [](const auto& test) {
    const Convention& c = test.param;
    return testName(c.option) + "_" + testName(std::string(c.scene).substr(8)) + "_" +
           std::string(nameOf(c.multiscatter));
});

// Another program's image of the scene has these conventions. It declares neither them nor its surfaces,
// so ours are substituted. Two conventions may partly cancel (a spot's edge near the end of its range).
TEST(ConventionsExplained, EachIsNamedOfAnotherProgramsImage) {
    using Words = std::vector<std::pair<std::string, std::string>>;
    const std::pair<const char*, Words> cases[] = {
        {"builtin:spots", {{"spot-cone", "smoothstep"}}},
        {"builtin:spots", {{"range-window", "squared"}}},
        {"builtin:spots", {{"spot-cone", "smoothstep"}, {"range-window", "squared"}}},
        {"builtin:points", {{"range-window", "squared"}}},
        {"builtin:dielectrics", {{"base-layer", "component"}}},
        {"builtin:dielectrics", {{"multiscatter", "energy"}}},
        {"builtin:normals", {{"multiscatter", "fdez"}}},
        {"builtin:dielectrics", {{"base-layer", "component"}, {"multiscatter", "energy"}}},
        {"builtin:points", {}},
    };
    for (const auto& [name, had] : cases) {
        const Scene scene = loadScene(name);
        SceneViews views(scene);
        Renderer renderer(device(), views, pipelines());
        Settings settings = smallImage(GBufferEncoding::full);
        settings.path = drawn_paths[1];
        settings.shadows = Shadows::off;
        settings.size = {96, 54};
        const RenderOptions options = untimed(explainedChannels());
        const Frame ours = renderer.draw(settings, options);
        Settings theirs = settings;
        for (const auto& [option, value] : had) theirs.set(option, value);
        Frame other = ours;
        other.origin.external = true;
        other.channels[Channel::lit] = renderer.draw(theirs, options).channels.at(Channel::lit);
        const Explanation found = explain(device(), renderer, scene, ours, other);
        std::vector<std::string> named, expected;
        for (const Cause& cause : found.causes)
            if (std::abs(cause.contribution) > 0.01 * found.distance) named.push_back(cause.name);
        for (const auto& [option, value] : had) expected.push_back("--" + option);
        std::ranges::sort(named);
        std::ranges::sort(expected);
        EXPECT_EQ(named, expected) << name;
        EXPECT_LE(found.unexplained, 0.01 * found.distance) << name;
        // An image of our own declares its Settings: the same difference is then not a convention.
        other.origin.external = false;
        for (const Cause& cause : explain(device(), renderer, scene, ours, other).causes) {
            EXPECT_NE(cause.name, "--spot-cone");
            EXPECT_NE(cause.name, "--base-layer");
        }
    }
}

// Normals are surface data: only an image of another program names its rotation of skinned normals.
TEST(ConventionsExplained, SoIsHowItTurnsNormalsOfSkins) {
    const Scene scene = loadScene("builtin:motion");
    SceneViews views(scene);
    Renderer renderer(device(), views, pipelines());
    Settings settings = with(smallImage(GBufferEncoding::full), "path forward_plus size 96x54 time 0.7");
    const RenderOptions options = untimed(explainedChannels());
    const Frame ours = renderer.draw(settings, options);
    for (const SkinNormals normals : {SkinNormals::joints, SkinNormals::blended}) {
        Settings theirs = settings;
        theirs.skin_normals = normals;
        RenderOptions light = options;
        light.channels = {Channel::lit};
        Frame other = renderer.draw(theirs, light);
        other.origin.external = true;
        other.settings = settings;
        const Frame substituted = substituteChannels(other, ours, renderer, options);
        EXPECT_EQ(substituted.settings.skin_normals, normals);
        const Explanation found = explain(device(), renderer, scene, ours, substituted);
        if (normals == SkinNormals::joints) {
            EXPECT_EQ(found.distance, 0);
            continue;
        }
        ASSERT_FALSE(found.causes.empty());
        EXPECT_EQ(found.causes[0].name, "normals");
        EXPECT_NE(found.causes[0].description.find("--skin-normals blended"), std::string::npos)
            << found.causes[0].description;
        EXPECT_LE(found.unexplained, 0.01 * found.distance);
    }
}

}  // namespace
}  // namespace diptych::tests
