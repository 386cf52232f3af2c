// SPDX-License-Identifier: MIT
// Triangles culled by a compute shader into indirect draws (DeviceProfile::culls_by_compute). Images equal
// those of --cull off bit for bit, and about as many triangles are culled as on the host. culling_test.cpp
// compares the host's culling with --cull off; gpu_choices_test.cpp compares a GPU's choices with the
// device's own.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/computing_device.h"
#include "tests/image/placed_balls.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

Settings chosenSettings(Path path, Size size = {160, 90}) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.path = path;
    settings.size = size;
    return settings;
}

// These distinguish surfaces and their lighting.
const std::vector<Channel> chosenChannels{Channel::lit, Channel::normals, Channel::depth,
                                          Channel::material_id};

// With options (with()) beyond chosenSettings().
void expectTheKernelChangesNoBit(Renderer& renderer, const std::string& options = "") {
    const RenderOptions chosen = untimed(chosenChannels);
    for (const Path path : drawn_paths) {
        Settings settings = with(chosenSettings(path), options);
        settings.cull = true;
        const Frame culled = renderer.draw(settings, chosen);
        settings.cull = false;
        const Frame all = renderer.draw(settings, chosen);
        ASSERT_EQ(culled.channels.size(), all.channels.size());
        for (const auto& [mode, image] : culled.channels)
            EXPECT_EQ(differingPixels(image, all.channels.at(mode)), 0u)
                << options << " " << nameOf(path) << " " << debugMode(mode).name;
    }
    EXPECT_EQ(byCompute().validationMessages(), 0u) << byCompute().firstValidationMessage();
}

class ComputeCullingOf : public testing::TestWithParam<std::string> {};

TEST_P(ComputeCullingOf, ChangesNoBit) {
    const Scene scene = loadScene(GetParam());
    Renderer renderer(byCompute(), scene, computePipelines());
    for (const char* options : {"", "msaa 4"}) expectTheKernelChangesNoBit(renderer, options);
}

INSTANTIATE_TEST_SUITE_P(Builtin, ComputeCullingOf,
                         testing::Values("builtin:gallery", "builtin:spheres", "builtin:coplanar",
                                         "builtin:ortho", "builtin:cutout", "builtin:glass",
                                         "builtin:mirrored", "builtin:stretched", "builtin:motion",
                                         "builtin:far_away", "builtin:deep"),
                         sceneName);

TEST(ComputeCulling, ChangesNoBitOfAssets) {
    std::size_t drawn = 0;
    for (const char* const name :
         {"sponza/Sponza.gltf", "flight_helmet/FlightHelmet.gltf", "features/alpha_mask/01_alpha_mask.gltf",
          "features/single_vs_double_sided/01_single_vs_double_sided.gltf"}) {
        if (!std::filesystem::exists(assets() / name)) continue;
        const Scene scene = loadScene((assets() / name).string());
        Renderer renderer(byCompute(), scene, computePipelines());
        SCOPED_TRACE(name);
        expectTheKernelChangesNoBit(renderer, "size 320x180");
        ++drawn;
    }
    if (drawn == 0) GTEST_SKIP() << "none of them is in " << assets().string();
}

// Passes that read the draws before the frame or again after it.
TEST(ComputeCulling, ChangesNoBitUnderAnySetting) {
    const Scene scene = loadScene("builtin:cutout");
    Renderer cutout(byCompute(), scene, computePipelines());
    for (const char* options : {"shadows pcf shadow-size 256", "shadows clipmap shadow-size 256",
                                "shadow-fit depth", "prepass on", "assign tiled", "assign per_object"})
        expectTheKernelChangesNoBit(cutout, options);
}

TEST(ComputeCulling, ChangesNoBitAmongPlacedBalls) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        const Scene scene = placedBalls(seed);
        Renderer renderer(byCompute(), scene, computePipelines());
        for (const char* options : {"", "size 400x225"}) {
            SCOPED_TRACE(seed);
            expectTheKernelChangesNoBit(renderer, options);
        }
    }
}

class Counts {
public:
    Counts(Device& on, const Scene& scene, const std::shared_ptr<PipelineSet>& set)
        : device_(on), views_(scene), shared_(on, scene, set) {}
    DrawnCounts of(const Settings& settings) {
        const PreparedView view(device_, shared_, views_.at(viewRequest(settings)), settings);
        return drawnCounts(view.draws, shared_.geometry, view.culling);
    }

private:
    Device& device_;
    SceneViews views_;
    SharedResources shared_;
};

// The compute shader tests each triangle; the host keeps meshlets that extend beyond the view whole. It
// also tests samples under MSAA: it culls no less.
TEST(ComputeCulling, LeavesOutAboutAsMuchAsTheHost) {
    std::vector<std::string> names{"builtin:spheres", "builtin:gallery", "builtin:mirrored"};
    if (std::filesystem::exists(assets() / "sponza/Sponza.gltf"))
        names.push_back((assets() / "sponza/Sponza.gltf").string());
    for (const std::string& name : names) {
        const Scene scene = loadScene(name);
        Counts by_host(device(), scene, pipelines()), by_kernel(byCompute(), scene, computePipelines());
        for (const int samples : {1, 4}) {
            Settings settings = chosenSettings(Path::deferred, {1280, 720});
            settings.shadows = Shadows::off;
            settings.msaa = samples;
            const DrawnCounts host = by_host.of(settings), kernel = by_kernel.of(settings);
            const std::string found =
                fmt::format("{} {}: host {}, kernel {} of {}; vertices {} and {}", name, samples, host.drawn,
                            kernel.drawn, host.in_view, host.vertices, kernel.vertices);
            RecordProperty(
                fmt::format("{}_{}", testName(std::filesystem::path(name).stem().string()), samples), found);
            EXPECT_EQ(kernel.in_view, host.in_view) << found;
            EXPECT_LE(kernel.drawn, host.drawn) << found;
            EXPECT_GT(4 * kernel.drawn, 3 * host.drawn) << found;
        }
    }
}

// More meshlet ranges than a row of workgroups has.
TEST(ComputeCulling, ChoosesOfManyMeshes) {
    const Scene scene = loadScene("builtin:array?objects=34000&triangles=68000&meshes=34000");
    Settings settings = chosenSettings(Path::deferred, {1280, 720});
    settings.shadows = Shadows::off;
    const DrawnCounts host = Counts(device(), scene, pipelines()).of(settings),
                      kernel = Counts(byCompute(), scene, computePipelines()).of(settings);
    EXPECT_GT(host.draws, gpu::CULLING_GROUPS);
    EXPECT_EQ(kernel.draws, host.draws);
    EXPECT_EQ(kernel.drawn, host.drawn);
    EXPECT_EQ(kernel.vertices, host.vertices);
}

// A pass before all others; passes that draw the scene read its indices and draws.
TEST(ComputeCulling, IsAPassOfTheFrame) {
    const Scene scene = loadScene("builtin:spheres");
    for (const Path path : drawn_paths) {
        SharedResources shared(byCompute(), scene, computePipelines());
        Settings settings = chosenSettings(path);
        settings.prepass = Switch::on;
        const SceneView view = makeSceneView(scene, viewRequest(settings));
        const auto passesReading = [&](const PreparedFrame& frame, const std::string& resource) {
            std::vector<std::string> names;
            for (const DeclaredUse& use : frame.passes.declarations())
                if (use.resource == resource && !writes(use.access)) names.push_back(use.pass);
            return names;
        };
        const PreparedFrame frame(byCompute(), shared, view, settings);
        EXPECT_EQ(frame.passes.names().front(), Culling::name);
        const std::vector<std::string> drawing = path == Path::deferred
                                                     ? std::vector<std::string>{"G-buffer"}
                                                     : std::vector<std::string>{"depth pre-pass", "shade"};
        EXPECT_EQ(passesReading(frame, "indirect draws"), drawing);
        EXPECT_EQ(passesReading(frame, "chosen indices"), drawing);
        settings.cull = false;
        const PreparedFrame whole(byCompute(), shared, view, settings);
        EXPECT_NE(whole.passes.names().front(), Culling::name);
        EXPECT_TRUE(passesReading(whole, "indirect draws").empty());
    }
    // Its time includes the host's part and the device's, under one name.
    Renderer renderer(byCompute(), scene, computePipelines());
    const std::vector<Settings> each{chosenSettings(Path::deferred)};
    PreparedFrames frames = renderer.prepare(each);
    frames.draw(0);
    const std::vector<PassTime> times = frames.profile(0);
    EXPECT_EQ(std::ranges::count(times, std::string(Culling::name), &PassTime::name), 1);
    EXPECT_EQ(times.front().name, Culling::name);
}

}  // namespace
}  // namespace diptych::tests
