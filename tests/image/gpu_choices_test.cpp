// SPDX-License-Identifier: MIT
// What is chosen on a GPU (DeviceProfile), drawn on the device that there is: where the view is read, input
// sets, the light kernel, stored depth, submits in bands. On a CPU device the pictures have the same bits; on
// a GPU this draws what all other tests draw, and the depth of a fragment and the depth that is stored are
// counted where they differ.
#include "compare/render/frame_facts.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/scenes.h"

#include <fmt/format.h>

namespace diptych::tests {
namespace {

Device& asGpu() {
    static Device theDevice{{.choice = "", .validate = true, .choices = ProfileChoices::gpu}};
    return theDevice;
}

std::shared_ptr<PipelineSet> gpuPipelines() {
    static const std::shared_ptr<PipelineSet> set = makePipelineSet(asGpu());
    return set;
}

// One of each kind: what is lit, what a surface has, what a list holds, what comes from depth.
const std::vector<int> channels{lit, static_cast<int>(gpu::DEBUG_normals),
                                static_cast<int>(gpu::DEBUG_light_count),
                                static_cast<int>(gpu::DEBUG_position)};

class GpuChoices : public testing::TestWithParam<const char*> {};

TEST_P(GpuChoices, DrawTheSamePictures) {
    const Scene scene = loadScene(GetParam());
    Renderer here(device(), scene, pipelines()), there(asGpu(), scene, gpuPipelines());
    for (const Switch prepass : {Switch::on, Switch::off}) {
        Settings settings = smallPicture(GBufferEncoding::standard);
        settings.prepass = prepass;
        for (const Path path : {Path::forward_plus, Path::deferred}) {
            if (path == Path::deferred && prepass == Switch::off) continue;  // has none
            SCOPED_TRACE(fmt::format("{}, pre-pass {}", nameOf(path), nameOf(prepass)));
            const Frame usual = drawnBy(path, here, settings, channels),
                        chosen = drawnBy(path, there, settings, channels);
            expectSameChannels(usual, chosen, channels.size());
            EXPECT_EQ(chosen.counters.unreproduced_pixels, 0u);
        }
    }
    EXPECT_EQ(asGpu().validationMessages(), 0u) << asGpu().firstValidationMessage();
}
INSTANTIATE_TEST_SUITE_P(Chosen, GpuChoices,
                         testing::Values("builtin:cutout", "builtin:ortho", "builtin:points"),
                         [](const auto& test) { return testName(test.param); });

// That they are what is drawn with: each shows in the frame.
TEST(GpuChoice, IsWhatAFrameIsMadeOf) {
    const Scene scene = loadScene("builtin:points");
    Settings settings = smallPicture(GBufferEncoding::standard);
    settings.path = Path::forward_plus;
    settings.prepass = Switch::on;
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
    settings.prepass = Switch::off;
    EXPECT_FALSE(samplesDepth(PreparedFrame(asGpu(), shared, view, settings).passes));
    if (device().profile().fetches_depth) return;
    settings.prepass = Switch::on;
    SharedResources usual(device(), scene, pipelines());
    EXPECT_FALSE(samplesDepth(PreparedFrame(device(), usual, view, settings).passes));
}

// Forward+ without a pre-pass shades with gl_FragCoord.z, deferred with the depth that is stored.
TEST(DepthEquality, OfAFragmentAndOfTheStoredDepth) {
    constexpr int depth = static_cast<int>(gpu::DEBUG_depth);
    std::size_t covered = 0, different = 0, beyond = 0;
    for (const std::string& name : builtinScenes()) {
        Settings settings = smallPicture(GBufferEncoding::full);
        settings.prepass = Switch::off;
        const std::vector<Frame> frames = bothPaths(uploaded(name).renderer, settings, {depth, 8});
        const Image &stored = frames[0].channels.at(depth), &own = frames[1].channels.at(depth);
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
