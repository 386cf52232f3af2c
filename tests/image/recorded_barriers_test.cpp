// SPDX-License-Identifier: MIT
// The barriers of whole frames: they suffice for the passes' uses (hazards.h), and Vulkan gets them as
// planned, with every source stage and access.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "tests/image/scenes.h"
#include "tests/support/hazards.h"

#include <dlfcn.h>

#include <optional>

namespace diptych::tests {
namespace {

// Every barrier that this program passes to Vulkan while a test listens.
struct Told {
    std::vector<VkMemoryBarrier2> memory;
    std::vector<VkBufferMemoryBarrier2> buffers;
    std::vector<VkImageMemoryBarrier2> images;
};
std::vector<Told>* listening = nullptr;

}  // namespace
}  // namespace diptych::tests

// Overrides the loader's function and calls it.
extern "C" VKAPI_ATTR void VKAPI_CALL vkCmdPipelineBarrier2(VkCommandBuffer commands,
                                                            const VkDependencyInfo* info) {
    using diptych::tests::listening;
    if (listening)
        listening->push_back(
            {{info->pMemoryBarriers, info->pMemoryBarriers + info->memoryBarrierCount},
             {info->pBufferMemoryBarriers, info->pBufferMemoryBarriers + info->bufferMemoryBarrierCount},
             {info->pImageMemoryBarriers, info->pImageMemoryBarriers + info->imageMemoryBarrierCount}});
    static const auto loaders =
        reinterpret_cast<PFN_vkCmdPipelineBarrier2>(dlsym(RTLD_NEXT, "vkCmdPipelineBarrier2"));
    loaders(commands, info);
}

namespace diptych::tests {
namespace {

class Listening {
public:
    Listening() { listening = &told; }
    ~Listening() { listening = nullptr; }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;
    std::vector<Told> told;
};

Settings settingsOf(Path path, Assignment assign, LightKernel kernel, Switch prepass) {
    Settings settings = smallImage(GBufferEncoding::standard);
    settings.path = path;
    settings.assign = assign;
    settings.lights = "point:40,spot:10";
    settings.light_kernel = kernel;
    settings.prepass = prepass;
    return settings;
}

class WholeFrame {
public:
    explicit WholeFrame(const Settings& settings, const std::string& scene = "builtin:triangle")
        : scene_(loadScene(scene)), shared_(device(), scene_, pipelines()) {
        seen_.emplace(makeSceneView(scene_, viewRequest(settings)));
        frame_ = std::make_unique<PreparedFrame>(device(), shared_, *seen_, settings);
        frame_->passes.allocate();
    }
    PassList& passes() { return frame_->passes; }
    ImageRef lit() const { return frame_->images.lit; }

private:
    Scene scene_;
    SharedResources shared_;
    std::optional<SceneView> seen_;
    std::unique_ptr<PreparedFrame> frame_;
};

std::vector<Settings> everyKindOfFrame() {
    std::vector<Settings> all;
    for (const Path path : {Path::forward_plus, Path::deferred})
        for (const Assignment assign :
             {Assignment::every, Assignment::tiled, Assignment::clustered, Assignment::per_object}) {
            if (path == Path::deferred && assign == Assignment::per_object) continue;
            for (const LightKernel kernel : {LightKernel::scatter, LightKernel::gather})
                for (const Switch prepass : {Switch::on, Switch::off}) {
                    const Settings settings = settingsOf(path, assign, kernel, prepass);
                    if (!settings.problem()) all.push_back(settings);
                }
        }
    return all;
}

std::vector<std::string> hazardsOf(const std::vector<DeclaredUse>& uses,
                                   const std::vector<RecordedBarrier>& first,
                                   const std::vector<RecordedBarrier>& again) {
    Hazards hazards;
    hazards.run(uses, first);
    hazards.run(uses, again);
    return hazards.found();
}

struct Barriers {
    std::vector<RecordedBarrier> first, again;  // of two successive runs
};
Barriers plannedOf(const PassList& passes) {
    Barriers planned{passes.plannedBarriers(1), passes.plannedBarriers(2)};
    planned.again.erase(planned.again.begin(),
                        planned.again.begin() + static_cast<std::ptrdiff_t>(planned.first.size()));
    return planned;
}

// Each write that a later pass uses is waited for with its stages and accesses, and is visible to that
// pass. Nothing is overwritten while it is being read; the second frame waits for the first.
TEST(RecordedBarriers, OfEveryKindOfFrameAreEnough) {
    const std::vector<Settings> kinds = everyKindOfFrame();
    EXPECT_GE(kinds.size(), 20u);
    for (const Settings& settings : kinds) {
        WholeFrame frame(settings);
        const Barriers planned = plannedOf(frame.passes());
        EXPECT_GE(planned.again.size(), 2u);
        EXPECT_EQ(hazardsOf(frame.passes().declarations(), planned.first, planned.again),
                  std::vector<std::string>{})
            << nameOf(settings.path) << ", " << nameOf(settings.assign) << ", "
            << nameOf(settings.light_kernel);
    }
}

// Every pass that draws deformed vertices waits for the skinning pass, which waits for the previous
// frame's readers.
TEST(RecordedBarriers, OfFramesThatPoseAreEnough) {
    for (const Path path : {Path::forward_plus, Path::deferred})
        for (const Skinning skinning : {Skinning::compute, Skinning::vertex})
            for (const Shadows shadows : {Shadows::pcf, Shadows::clipmap})
                for (const Transparency transparency :
                     {Transparency::sorted, Transparency::moments, Transparency::list}) {
                    Settings settings =
                        settingsOf(path, Assignment::tiled, LightKernel::automatic, Switch::on);
                    settings.time = 0.7;
                    settings.skinning = skinning;
                    settings.shadows = shadows;
                    settings.shadow_lights = 1;
                    settings.shadow_size = 256;
                    settings.clipmap_page_size = 32;
                    settings.transparency = transparency;
                    WholeFrame frame(settings, "builtin:motion");
                    const Barriers planned = plannedOf(frame.passes());
                    const std::vector<DeclaredUse> uses = frame.passes().declarations();
                    EXPECT_EQ(hazardsOf(uses, planned.first, planned.again), std::vector<std::string>{})
                        << settings.valueOf("path") << ", " << settings.valueOf("skinning");
                    // Negative control: without the barriers of deformed vertices there are hazards.
                    const std::string posed =
                        skinning == Skinning::compute ? "posed positions" : "tangents of groups";
                    std::vector<RecordedBarrier> lacking = planned.again;
                    std::erase_if(lacking, [&](const RecordedBarrier& b) { return b.resource == posed; });
                    EXPECT_LT(lacking.size(), planned.again.size());
                    EXPECT_FALSE(hazardsOf(uses, planned.first, lacking).empty());
                }
}

// Negative control: omitting a barrier, its source stages, source accesses or destination leaves a hazard.
// (If only readers are waited for, the destination access is irrelevant.)
TEST(RecordedBarriers, EachOneIsNeededWithAllItsScopes) {
    for (const Path path : {Path::forward_plus, Path::deferred}) {
        WholeFrame frame(settingsOf(path, Assignment::tiled, LightKernel::gather, Switch::on));
        const std::vector<DeclaredUse> uses = frame.passes().declarations();
        const Barriers planned = plannedOf(frame.passes());
        for (std::size_t i = 0; i < planned.again.size(); ++i) {
            const RecordedBarrier& whole = planned.again[i];
            const auto leavesHazard = [&](const char* what, auto&& change) {
                std::vector<RecordedBarrier> barriers = planned.again;
                change(barriers);
                // The third run has the next frame's waits.
                Hazards hazards;
                for (const auto& run : {planned.first, barriers, planned.again}) hazards.run(uses, run);
                EXPECT_FALSE(hazards.found().empty()) << whole.pass << ": " << whole.resource << ": " << what;
            };
            leavesHazard("left out",
                         [&](auto& all) { all.erase(all.begin() + static_cast<std::ptrdiff_t>(i)); });
            leavesHazard("no source stage",
                         [&](auto& all) { all[i].from.stages = VK_PIPELINE_STAGE_2_NONE; });
            leavesHazard("no destination stage",
                         [&](auto& all) { all[i].to.stages = VK_PIPELINE_STAGE_2_NONE; });
            // A write is flushed from its stage's cache once, by the first barrier after it.
            if (whole.from.access != 0)
                leavesHazard("no source access", [&](auto& all) {
                    for (RecordedBarrier& barrier : all)
                        if (barrier.resource == whole.resource) barrier.from.access = VK_ACCESS_2_NONE;
                });
            if (whole.from.access != 0 || whole.from.layout != whole.to.layout)
                leavesHazard("no destination access",
                             [&](auto& all) { all[i].to.access = VK_ACCESS_2_NONE; });
        }
    }
}

template <class VulkanBarrier>
void expectScopes(const VulkanBarrier& told, const RecordedBarrier& planned) {
    const std::string what = planned.pass + ": " + planned.resource;
    EXPECT_EQ(told.srcStageMask, planned.from.stages) << what;
    EXPECT_EQ(told.srcAccessMask, planned.from.access) << what;
    EXPECT_EQ(told.dstStageMask, planned.to.stages) << what;
    EXPECT_EQ(told.dstAccessMask, planned.to.access) << what;
}

// In each call, images and buffers are in planned order.
void expectTold(const std::vector<Told>& told, const std::vector<RecordedBarrier>& planned) {
    std::size_t next = 0;
    for (const Told& call : told) {
        std::size_t image = 0, buffer = 0, shared = 0;
        for (; image < call.images.size() || buffer < call.buffers.size(); ++next) {
            ASSERT_LT(next, planned.size());
            const RecordedBarrier& p = planned[next];
            if (p.to.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
                ASSERT_LT(buffer, call.buffers.size());
                const VkBufferMemoryBarrier2& b = call.buffers[buffer++];
                expectScopes(b, p);
                EXPECT_EQ(b.offset, 0u);
                EXPECT_EQ(b.size, VK_WHOLE_SIZE);
                continue;
            }
            ASSERT_LT(image, call.images.size());
            const VkImageMemoryBarrier2& b = call.images[image++];
            expectScopes(b, p);
            EXPECT_EQ(b.oldLayout, p.from.layout) << p.resource;
            EXPECT_EQ(b.newLayout, p.to.layout) << p.resource;
            EXPECT_EQ((Part{b.subresourceRange.baseMipLevel, b.subresourceRange.levelCount,
                            b.subresourceRange.baseArrayLayer, b.subresourceRange.layerCount}),
                      p.part)
                << p.resource;
            if (shared < call.memory.size()) {
                const VkMemoryBarrier2& m = call.memory[shared];
                shared += m.srcStageMask == b.srcStageMask && m.srcAccessMask == b.srcAccessMask &&
                          m.dstStageMask == b.dstStageMask && m.dstAccessMask == b.dstAccessMask;
            }
        }
        EXPECT_EQ(shared, call.memory.size()) << "a barrier of shared memory has an image's scopes";
    }
    EXPECT_EQ(next, planned.size());
}

// A read-back waits for the frame, and the host for the copy.
TEST(RecordedBarriers, VulkanIsToldThemWhole) {
    for (const Path path : {Path::forward_plus, Path::deferred}) {
        WholeFrame frame(settingsOf(path, Assignment::clustered, LightKernel::scatter, Switch::on));
        for (const int run : {0, 1}) {
            Listening listen;
            frame.passes().run();
            const std::vector<RecordedBarrier> recorded = frame.passes().barriers();
            EXPECT_GT(recorded.size(), 5u);
            // Passes may also record barriers internally; those have neither images nor buffers.
            std::vector<Told> told;
            for (const Told& call : listen.told)
                if (!call.images.empty() || !call.buffers.empty()) told.push_back(call);
            expectTold(told, recorded);
            const Barriers planned = plannedOf(frame.passes());
            EXPECT_EQ(recorded == (run == 0 ? planned.first : planned.again), true) << nameOf(path) << run;
        }
        Listening listen;
        const std::vector<RecordedBarrier> before = frame.passes().barriers();
        frame.passes().readBack(std::array{PassList::ReadBack{frame.lit(), 3}});
        ASSERT_EQ(listen.told.size(), 2u);
        ASSERT_EQ(listen.told[0].images.size(), 1u);
        const VkImageMemoryBarrier2& copied = listen.told[0].images[0];
        EXPECT_EQ(copied.srcAccessMask, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
        EXPECT_EQ(copied.srcStageMask, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
        EXPECT_EQ(copied.dstAccessMask, VK_ACCESS_2_TRANSFER_READ_BIT);
        EXPECT_EQ(copied.dstStageMask, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
        ASSERT_EQ(listen.told[1].memory.size(), 1u);
        const VkMemoryBarrier2& host = listen.told[1].memory[0];
        EXPECT_EQ(host.srcStageMask, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
        EXPECT_EQ(host.srcAccessMask, VK_ACCESS_2_TRANSFER_WRITE_BIT);
        EXPECT_EQ(host.dstStageMask, VK_PIPELINE_STAGE_2_HOST_BIT);
        EXPECT_EQ(host.dstAccessMask, VK_ACCESS_2_HOST_READ_BIT);
    }
}

// Uploads are visible to every later command: each image is written, then read; buffers have a global
// memory barrier.
TEST(RecordedBarriers, UploadsAreVisibleToWhatFollows) {
    Listening listen;
    const Scene scene = loadScene("builtin:emission");
    SharedResources shared(device(), scene, pipelines());
    shared.materials(TexturePrecision::exact);
    shared.materials(TexturePrecision::device);
    std::size_t written = 0, read = 0, all = 0;
    for (const Told& call : listen.told) {
        for (const VkImageMemoryBarrier2& b : call.images) {
            const bool first = b.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED;
            EXPECT_EQ(first ? b.dstAccessMask : b.srcAccessMask, VK_ACCESS_2_TRANSFER_WRITE_BIT);
            EXPECT_EQ(first ? b.dstStageMask : b.srcStageMask, VK_PIPELINE_STAGE_2_COPY_BIT);
            EXPECT_EQ(first ? b.newLayout : b.oldLayout, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
            if (!first) {
                EXPECT_EQ(b.newLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
                EXPECT_NE(b.dstStageMask & VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, 0u);
                EXPECT_NE(b.dstAccessMask & VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0u);
            }
            (first ? written : read) += 1;
        }
        for (const VkMemoryBarrier2& b : call.memory) {
            EXPECT_EQ(b.srcStageMask, VK_PIPELINE_STAGE_2_COPY_BIT);
            EXPECT_EQ(b.srcAccessMask, VK_ACCESS_2_TRANSFER_WRITE_BIT);
            EXPECT_EQ(b.dstStageMask, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
            EXPECT_EQ(b.dstAccessMask, VK_ACCESS_2_MEMORY_READ_BIT);
            ++all;
        }
    }
    EXPECT_GT(written, 0u);
    EXPECT_EQ(written, read);
    EXPECT_GT(all, 0u);
}

}  // namespace
}  // namespace diptych::tests
