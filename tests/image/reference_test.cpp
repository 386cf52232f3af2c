// SPDX-License-Identifier: MIT
// Both paths against the reference, the reference's two modes against each other, and negative controls
// with faults on either side.
#include "compare/verdict/pair_reports.h"
#include "shared/frame/supported_channels.h"
#include "shared/scene/load.h"
#include "shared/scene/requirements.h"
#include "tests/image/scenes.h"

namespace diptych::tests {
namespace {

Frame reference(Renderer& renderer, Settings settings, ReferenceMode mode = ReferenceMode::surface) {
    settings.path = Path::reference;
    settings.reference_mode = mode;
    return renderer.draw(settings, untimed(allChannels()));
}
Frame reference(const Scene& scene, const Settings& settings, ReferenceMode mode = ReferenceMode::surface) {
    Renderer renderer(device(), scene, pipelines());
    return reference(renderer, settings, mode);
}

ChannelStats against(const Frame& referenceFrame, const Frame& frame, Channel mode, const Coverage& covered) {
    const DebugMode& m = debugMode(mode);
    return channelStats(m.error_kind, m.kind, referenceFrame.channels.at(mode), frame.channels.at(mode),
                        covered);
}

std::size_t nonfinite(const Frame& frame) {
    std::size_t count = 0;
    for (const auto& [mode, pixels] : frame.repaired) count += pixels.size();
    for (const auto& [mode, image] : frame.channels)
        for (const float v : image.data) count += !std::isfinite(v);
    return count;
}

// ---- both paths --------------------------------------------------------------------------------------

// Relative errors of at most 1e-4 on 99.9 % of the covered pixels: the accuracy of float32 shading of a
// captured surface.
void expectAgreement(const Scene& scene, Settings settings) {
    settings.gbuffer = GBufferEncoding::full;
    settings.assign = Assignment::every;
    Renderer renderer(device(), scene, pipelines());
    const Frame referenceFrame = reference(renderer, settings);
    for (const Frame& path : bothPaths(renderer, settings)) {
        const Coverage covered = coverage(referenceFrame, path);
        ASSERT_GT(covered.count, 1000u);
        for (const Channel mode : {Channel::lit, Channel::lit_diffuse, Channel::lit_specular}) {
            const ChannelStats stats = against(referenceFrame, path, mode, covered);
            EXPECT_LE(stats.p999, 1e-4) << path.name << " " << debugMode(mode).name << ", max " << stats.max;
            EXPECT_EQ(stats.infinite, 0u);
        }
    }
}

TEST(Reference, BothPathsDrawTheGallery) {
    Settings settings = unshadowed();
    settings.size = {240, 135};
    expectAgreement(loadScene("builtin:gallery"), settings);
}

TEST(Reference, BothPathsDrawSponza) {
    const std::filesystem::path file = assets() / "sponza/Sponza.gltf";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: no " << file << "; the gallery proves it";
    Settings settings = with(unshadowed(), "size 240x135 lights point:12,spot:4");
    expectAgreement(loadScene(file.string()), settings);
}

// ---- the reference's two modes -----------------------------------------------------------------------

// Pixels where both modes show the same surface point. Either of two coplanar triangles may be visible.
// The rasterizer's depth on triangles of 200 km is accurate only to 6e-4.
Coverage samePlaces(const Frame& a, const Frame& b) {
    const Image &depth = a.channels.at(Channel::depth), &other = b.channels.at(Channel::depth);
    const Image &id = a.channels.at(Channel::material_id), &other_id = b.channels.at(Channel::material_id);
    Coverage same{std::vector<std::uint8_t>(depth.pixels()), 0, true};
    for (std::size_t i = 0; i < depth.pixels(); ++i) {
        if (id.data[i] < 0 || id.data[i] != other_id.data[i]) continue;
        if (std::abs(depth.data[i] - other.data[i]) > 1e-3f * depth.data[i]) continue;
        same.covered[i] = 1;
        ++same.count;
    }
    return same;
}

// The rasterizer snaps vertices to 1/256 pixel, so a pixel may err by 1/128 of the difference to its
// neighbours. 1e-4 relative is allowed beyond that.
double fractionBeyond(const Frame& traced, const Frame& surface, Channel mode, const Coverage& same) {
    const Image &expected = traced.channels.at(mode), &image = surface.channels.at(mode);
    const PixelError error(ErrorKind::relative, debugMode(mode).kind, expected, same);
    std::size_t beyond = 0;
    for (int y = 0; y < expected.height; ++y)
        for (int x = 0; x < expected.width; ++x) {
            const auto i = static_cast<std::size_t>(y * expected.width + x);
            if (!same.covered[i]) continue;
            float size = 0, apart = 0, range = 0;
            for (int c = 0; c < expected.components; ++c) {
                size = std::max(size, std::abs(expected.at(x, y, c)));
                apart = std::max(apart, std::abs(expected.at(x, y, c) - image.at(x, y, c)));
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, expected.height - 1); ++v)
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, expected.width - 1); ++u)
                        range = std::max(range, std::abs(expected.at(u, v, c) - expected.at(x, y, c)));
            }
            const double allowed = 1e-4 * std::max(double{size}, error.floor()) + double{range} / 128;
            beyond += double{apart} > allowed;
        }
    return static_cast<double>(beyond) / static_cast<double>(std::max<std::size_t>(same.count, 1));
}

class BuiltinReference : public testing::TestWithParam<std::string> {};

TEST_P(BuiltinReference, EveryChannelInBothModes) {
    const Scene& scene = uploaded(GetParam()).scene;
    Renderer& renderer = uploaded(GetParam()).renderer;
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {96, 54};
    const gpu::uint layers = requirements(scene, poseAt(scene, 0)).layers;
    const Frame surface = reference(renderer, settings),
                traced = reference(renderer, settings, ReferenceMode::scene);
    for (const Frame* frame : {&surface, &traced})
        for (const DebugMode& mode : debugModes()) {
            const bool there = isSupportedByReference(mode) && mayShow(mode.channel, layers);
            ASSERT_EQ(frame->channels.contains(mode.channel), there) << mode.name;
            if (!there) continue;
            EXPECT_EQ(frame->channels.at(mode.channel).components, mode.width) << mode.name;
        }
    EXPECT_EQ(nonfinite(surface), 0u);
    EXPECT_EQ(nonfinite(traced), 0u);
    // Without textures nothing is filtered: where both modes show the same point, the surface is the same.
    const std::size_t shown = coveredPixels(traced);
    if (!scene.textures.empty() || shown == 0) return;
    const Coverage same = samePlaces(traced, surface);
    const double min = GetParam() == "builtin:coplanar" ? 0.85 : 0.98;
    EXPECT_GE(static_cast<double>(same.count), min * static_cast<double>(shown));
    for (const Channel mode :
         {Channel::albedo, Channel::metallic, Channel::roughness, Channel::emission, Channel::occlusion,
          Channel::specular, Channel::dielectric_f90})  // channels of the material
        EXPECT_LE(against(traced, surface, mode, same).max, 1e-6) << debugMode(mode).name;
    for (const Channel mode : {Channel::lit, Channel::lit_diffuse, Channel::lit_specular})
        EXPECT_LE(fractionBeyond(traced, surface, mode, same), 2e-3) << debugMode(mode).name;
}

TEST(Reference, ALightAHundredthBrighterIsSeenBetweenItsModes) {
    Scene scene = loadScene("builtin:suns");
    Settings settings = smallImage(GBufferEncoding::full);
    const Frame surface = reference(scene, settings);
    scene.lights.front().intensity *= 1.01f;
    const Frame traced = reference(scene, settings, ReferenceMode::scene);
    EXPECT_GT(fractionBeyond(traced, surface, Channel::lit, samePlaces(traced, surface)), 0.3);
}

INSTANTIATE_TEST_SUITE_P(Builtin, BuiltinReference, testing::ValuesIn(builtinScenes()), sceneName);

// ---- injected faults ---------------------------------------------------------------------------------

struct Fault {
    const char* name;
    void (*plant)(Scene&);
};
const Fault referenceFaults[] = {
    {"AFactorOfPi",
     [](Scene& s) {
         for (Light& l : s.lights) l.intensity *= gpu::PI;
     }},
    {"RoughnessSquaredTwice",
     [](Scene& s) {
         for (Material& m : s.materials) m.roughness *= m.roughness;
     }},
    {"ALightLeftOut", [](Scene& s) { s.lights.pop_back(); }},
    {"ANormalFlipped",
     [](Scene& s) {
         for (Primitive& p : s.meshes.front().primitives)
             for (glm::vec3& n : p.normals) n = -n;
     }},
};

class ReferenceNegativeControl : public testing::TestWithParam<Fault> {
protected:
    // The reference and both paths.
    static std::vector<Frame> framesOf(const Scene& scene) {
        Settings settings = smallImage(GBufferEncoding::full);
        settings.size = {96, 54};
        Renderer renderer(device(), scene, pipelines());
        std::vector<Frame> frames{reference(renderer, settings)};
        for (Frame& frame : bothPaths(renderer, settings)) frames.push_back(std::move(frame));
        return frames;
    }
    static Report verdict(const std::vector<Frame>& referenceFrames, const std::vector<Frame>& drawn,
                          const Scene& scene) {
        const Requirements needs = requirements(scene, poseAt(scene, 0));
        const DeviceInfo& info = device().info();
        return makeReport({{{referenceFrames[0], drawn[1], drawn[2]}, needs}},
                          {info.name, info.driver, info.type});
    }
    static bool litFails(const Report& report, std::size_t comparison) {
        for (const ChannelDiff& channel : report.comparisons.at(comparison).channels)
            if (channel.mode->channel == Channel::lit) return channel.verdict == Verdict::fail;
        return false;
    }
};

TEST_P(ReferenceNegativeControl, IsSeenOnEitherSide) {
    static const Scene scene = loadScene("builtin:gallery");
    static const std::vector<Frame> sound = framesOf(scene);
    Scene changed = scene;
    GetParam().plant(changed);
    const std::vector<Frame> faulty = framesOf(changed);
    EXPECT_TRUE(verdict(sound, sound, scene).passed()) << "the control";
    for (const Report& report : {verdict(faulty, sound, scene), verdict(sound, faulty, scene)}) {
        EXPECT_FALSE(report.passed());
        EXPECT_TRUE(litFails(report, 0)) << "the first path against the reference";
        EXPECT_TRUE(litFails(report, 1)) << "the second path against the reference";
        EXPECT_FALSE(litFails(report, 2)) << "the two paths share the fault";
    }
}

INSTANTIATE_TEST_SUITE_P(Faults, ReferenceNegativeControl, testing::ValuesIn(referenceFaults),
                         [](const auto& fault) { return std::string(fault.param.name); });

}  // namespace
}  // namespace diptych::tests
