// SPDX-License-Identifier: MIT
// The choices that DeviceProfile makes on a GPU, rendered on the available device: where the view is read,
// input sets, the light compute shader, stored depth, triangle culling, submission in bands. On a CPU
// device the images equal the default's bit for bit. On a GPU these are the default choices; there, pixels
// where fragment depth differs from stored depth are counted.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "shared/contract/samples.h"
#include "tests/image/lit_samples.h"
#include "tests/image/scenes.h"
#include "tests/image/square.h"

#include <fmt/format.h>

namespace diptych::tests {
namespace {

Device& asGpu() {
    static Device& theDevice = *new Device({.choice = "", .validate = true, .choices = ProfileChoices::gpu});
    return theDevice;
}

std::shared_ptr<PipelineSet> gpuPipelines() {
    static const auto& set = *new std::shared_ptr<PipelineSet>(makePipelineSet(asGpu()));
    return set;
}

// One channel of each kind: lighting, surface, light list, depth.
const std::vector<Channel> channels{Channel::lit, Channel::normals, Channel::light_count, Channel::position};

class GpuChoices : public testing::TestWithParam<std::string> {};

TEST_P(GpuChoices, DrawTheSameImages) {
    const Scene scene = loadScene(GetParam());
    Renderer here(device(), scene, pipelines()), there(asGpu(), scene, gpuPipelines());
    for (const Switch prepass : {Switch::on, Switch::off}) {
        Settings settings = smallImage(GBufferEncoding::standard);
        settings.prepass = prepass;
        for (const Path path : {Path::forward_plus, Path::deferred}) {
            if (path == Path::deferred && prepass == Switch::off) continue;  // has none
            SCOPED_TRACE(fmt::format("{}, pre-pass {}", nameOf(path), nameOf(prepass)));
            const Frame standard = drawnBy(path, here, settings, channels),
                        chosen = drawnBy(path, there, settings, channels);
            expectSameChannels(standard, chosen, channels.size());
            EXPECT_EQ(chosen.counters.unreproduced_pixels, 0u);
        }
    }
    EXPECT_EQ(asGpu().validationMessages(), 0u) << asGpu().firstValidationMessage();
}
INSTANTIATE_TEST_SUITE_P(Chosen, GpuChoices,
                         testing::Values("builtin:cutout", "builtin:ortho", "builtin:points",
                                         "builtin:spheres"),
                         sceneName);

// Modules with flattened branches give the same bits, with every type of light: the most branches.
TEST(GpuChoice, FlattenedBranchesDrawTheSameImages) {
    Device flat({.choice = "", .validate = true, .choices = ProfileChoices::flattening_branches});
    ASSERT_TRUE(flat.profile().flattens_branches);
    for (const char* name : {"builtin:areas", "builtin:points"}) {
        const Scene scene = loadScene(name);
        Renderer here(device(), scene, pipelines()), there(flat, scene, makePipelineSet(flat));
        for (const Path path : {Path::forward_plus, Path::deferred}) {
            SCOPED_TRACE(fmt::format("{}, {}", name, nameOf(path)));
            const Settings settings = smallImage(GBufferEncoding::standard);
            expectSameChannels(drawnBy(path, here, settings, channels),
                               drawnBy(path, there, settings, channels), channels.size());
        }
    }
    EXPECT_EQ(flat.validationMessages(), 0u) << flat.firstValidationMessage();
}

// Secondary sample groups are shaded from a list, or by a draw each whose depth test selects samples. On a
// mesh finer than pixels the list takes several draws.
TEST(GpuChoice, SamplesAreShadedFromAListOrByDraws) {
    const auto lists = [](Device& on, const std::shared_ptr<PipelineSet>& set, const Scene& scene,
                          const Settings& settings) {
        SharedResources shared(on, scene, set);
        const SceneView view = makeSceneView(scene, viewRequest(settings));
        return std::ranges::any_of(PreparedFrame(on, shared, view, settings).passes.declarations(),
                                   [](const DeclaredUse& use) { return use.resource == "further groups"; });
    };
    const auto compared = [&](Scene scene, Size size, MsaaEdges edges) {
        Settings settings = smallImage(GBufferEncoding::full);
        settings.path = Path::deferred;
        settings.size = size;
        settings.msaa = 4;
        settings.msaa_edges = edges;
        EXPECT_FALSE(lists(asGpu(), gpuPipelines(), scene, settings));
        EXPECT_EQ(lists(device(), pipelines(), scene, settings),
                  device().profile().shades_failed_samples && edges != MsaaEdges::all);
        SampledScene standard(scene), chosen(std::move(scene), asGpu(), gpuPipelines());
        const std::vector<Image> a = standard.draw(settings), b = chosen.draw(settings);
        std::size_t further = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            std::size_t differ = 0;
            for (std::size_t p = 0; p < a[i].pixels(); ++p) {
                differ += !std::equal(a[i].pixel(p), a[i].pixel(p) + 3, b[i].pixel(p));
                further += !std::equal(a[i].pixel(p), a[i].pixel(p) + 3, a[0].pixel(p));
            }
            EXPECT_EQ(differ, 0u) << "sample " << i;
        }
        EXPECT_GT(further, 0u);
        EXPECT_EQ(asGpu().validationMessages(), 0u) << asGpu().firstValidationMessage();
        EXPECT_EQ(device().validationMessages(), 0u) << device().firstValidationMessage();
        return further;
    };
    compared(loadScene("builtin:gallery"), {161, 91}, MsaaEdges::exact);
    compared(loadScene("builtin:gallery"), {161, 91}, MsaaEdges::similar);
    compared(loadScene("builtin:gallery"), {161, 91}, MsaaEdges::all);
    compared(loadScene("builtin:cutout"), {4097, 3}, MsaaEdges::exact);
    EXPECT_GT(compared(fineMesh(450), {300, 300}, MsaaEdges::exact), gpu::FURTHER_WIDTH * gpu::FURTHER_ROWS);
}

// For many triangles, and for many instances.
TEST(GpuChoice, DrawsAreDividedOnASoftwareDevice) {
    const auto stamps = [](Device& on, const std::shared_ptr<PipelineSet>& set, const Scene& scene) {
        Settings settings = with(smallImage(GBufferEncoding::standard), "path deferred shadows off cull off");
        SharedResources shared(on, scene, set);
        const SceneView view = makeSceneView(scene, viewRequest(settings));
        PreparedFrame(on, shared, view, settings).passes.run();
        return on.drawDivision().stamps();
    };
    for (const char* name : {"builtin:spheres", "builtin:array?objects=20000&triangles=40000&meshes=1"}) {
        const Scene scene = loadScene(name);
        if (device().profile().bins_at_once > 0) {
            EXPECT_GT(stamps(device(), pipelines(), scene), 0u) << name;
        }
        EXPECT_EQ(asGpu().profile().bins_at_once, 0u);
    }
    EXPECT_EQ(stamps(device(), pipelines(), loadScene("builtin:points")), 0u) << "few triangles";
}

// The chosen options are in effect: each is visible in the frame.
TEST(GpuChoice, IsWhatAFrameIsMadeOf) {
    const Scene scene = loadScene("builtin:points");
    Settings settings = with(smallImage(GBufferEncoding::standard), "path forward_plus prepass on");
    SharedResources shared(asGpu(), scene, gpuPipelines());
    const SceneView view = makeSceneView(scene, viewRequest(settings));
    const PreparedFrame frame(asGpu(), shared, view, settings);
    EXPECT_EQ(frame.view.inputs.variant.get(gpu::FEATURE_view_source), gpu::VIEW_UNIFORM);
    const auto samplesDepth = [](const PassList& passes) {
        return std::ranges::any_of(passes.declarations(), [](const DeclaredUse& use) {
            return use.pass == "shade" && use.resource == "depth" &&
                   (use.access.stages & VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT) != 0;
        });
    };
    EXPECT_TRUE(samplesDepth(frame.passes));
    EXPECT_EQ(frame.passes.names().front(), Culling::name);
    settings.prepass = Switch::off;
    EXPECT_FALSE(samplesDepth(PreparedFrame(asGpu(), shared, view, settings).passes));
    if (device().profile().fetches_depth) return;
    settings.prepass = Switch::on;
    SharedResources standard(device(), scene, pipelines());
    const PreparedFrame own(device(), standard, view, settings);
    EXPECT_FALSE(samplesDepth(own.passes));
    EXPECT_NE(own.passes.names().front(), Culling::name) << "on a CPU device the host chooses faster";
}

// Forward+ without a pre-pass shades with gl_FragCoord.z, deferred with the stored depth.
TEST(DepthEquality, OfAFragmentAndOfTheStoredDepth) {
    std::size_t covered = 0, different = 0, beyond = 0;
    for (const std::string& name : builtinScenes()) {
        Settings settings = smallImage(GBufferEncoding::full);
        settings.prepass = Switch::off;
        const std::vector<Frame> frames =
            bothPaths(uploaded(name).renderer, settings, {Channel::depth, Channel::material_id});
        const Image &stored = frames[0].channels.at(Channel::depth),
                    &own = frames[1].channels.at(Channel::depth);
        covered += coveredPixels(frames[0]);
        different += differingPixels(stored, own, true);
        beyond += differingPixels(stored, own, false);
    }
    const std::string found =
        fmt::format("{} of {} pixels differ, {} by more than {} ULP", different, covered, beyond, gpuUlps);
    RecordProperty("depth", found);
    EXPECT_EQ(device().profile().bit_exact ? different : beyond, 0u) << found;
    EXPECT_GT(covered, 100'000u);
}

}  // namespace
}  // namespace diptych::tests
