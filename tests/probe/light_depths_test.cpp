// SPDX-License-Identifier: MIT
// Depth bounds of tiles by the shipped compute shader, with one sample and with four per pixel. Bounds
// must cover all samples: a tile's lists must not depend on which sample is shaded.
#include "shared/scene/motion/bounds.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "tests/probe/kernel_frame.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <span>

namespace diptych {
namespace {

// Reversed depths of an image, `samples` per pixel, side by side; 0: background.
struct DepthSamples {
    int width, height, samples;
    std::vector<float> z = std::vector<float>(static_cast<std::size_t>(width * height * samples));
    float& at(int x, int y, int sample) {
        return z[static_cast<std::size_t>((y * width + x) * samples + sample)];
    }
    float at(int x, int y, int sample) const {
        return z[static_cast<std::size_t>((y * width + x) * samples + sample)];
    }
};

OwnedImageView viewOf(VkImage image) {
    const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .pNext = nullptr,
                                     .flags = 0,
                                     .image = image,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = VK_FORMAT_D32_SFLOAT,
                                     .components = {},
                                     .subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1}};
    VkImageView view = VK_NULL_HANDLE;
    checkResult(vkCreateImageView(probeDevice().handle(), &info, nullptr, &view), "vkCreateImageView");
    return {probeDevice().handle(), view};
}

// Depth image of any sample count.
struct DepthImage {
    Allocation memory;
    OwnedImage image;
    OwnedImageView view;

    explicit DepthImage(const DepthSamples& stored) {
        const VkImageCreateInfo info{
            .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
            .pNext = nullptr,
            .flags = 0,
            .imageType = VK_IMAGE_TYPE_2D,
            .format = VK_FORMAT_D32_SFLOAT,
            .extent = {static_cast<std::uint32_t>(stored.width), static_cast<std::uint32_t>(stored.height),
                       1},
            .mipLevels = 1,
            .arrayLayers = 1,
            .samples = static_cast<VkSampleCountFlagBits>(stored.samples),
            .tiling = VK_IMAGE_TILING_OPTIMAL,
            .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
            .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
            .queueFamilyIndexCount = 0,
            .pQueueFamilyIndices = nullptr,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
        VkImage handle = VK_NULL_HANDLE;
        checkResult(vkCreateImage(probeDevice().handle(), &info, nullptr, &handle), "vkCreateImage");
        image = OwnedImage(probeDevice().handle(), handle);
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(probeDevice().handle(), handle, &needs);
        memory = probeDevice().memory().allocate(needs, MemoryUse::device, true, "depth");
        checkResult(vkBindImageMemory(probeDevice().handle(), handle, memory.memory(), memory.offset()),
                    "vkBindImageMemory");
        view = viewOf(handle);
    }
};

// Renders a full-screen triangle to the samples of `mask` only.
OwnedPipeline depthPipeline(VkPipelineLayout layout, int samples, VkSampleMask mask) {
    const OwnedShaderModule modules[] = {probeModule(probeDevice(), "whole_image.vert"),
                                         probeModule(probeDevice(), "sample_depths.frag")};
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (std::size_t i = 0; i < 2; ++i) {
        stages[i].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[i].module = modules[i];
        stages[i].pName = "main";
    }
    VkPipelineVertexInputStateCreateInfo input{};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo multisample{};
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = static_cast<VkSampleCountFlagBits>(samples);
    multisample.pSampleMask = &mask;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_ALWAYS;
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    constexpr std::array dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamics{};
    dynamics.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamics.dynamicStateCount = dynamic.size();
    dynamics.pDynamicStates = dynamic.data();
    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.depthAttachmentFormat = VK_FORMAT_D32_SFLOAT;
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = stages.size();
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamics;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkResult(
        vkCreateGraphicsPipelines(probeDevice().handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
    return {probeDevice().handle(), pipeline};
}

// Renders the image's samples one after another, for a compute shader to read.
class SampleDraw {
public:
    SampleDraw(Uploader& uploader, const DepthSamples& stored)
        : image_(stored),
          values_(makeBuffer<float>(probeDevice(), uploader, "sample depths", stored.z,
                                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)),
          set_layout_(makeSetLayout(probeDevice(), types)),
          sets_(probeDevice(), set_layout_, types, 1) {
        uploader.flush();
        sets_.buffer(0, 0, values_.handle());
        const std::array<VkDescriptorSetLayout, 1> layouts{set_layout_};
        const VkPushConstantRange range{VK_SHADER_STAGE_FRAGMENT_BIT, 0, 12};
        layout_ = makePipelineLayout(probeDevice(), layouts, range);
        for (int s = 0; s < stored.samples; ++s)
            pipelines_.push_back(depthPipeline(layout_, stored.samples, 1u << s));
    }

    void record(VkCommandBuffer commands, const DepthImage& target) const {
        const VkRect2D all{
            {0, 0}, {static_cast<std::uint32_t>(image_.width), static_cast<std::uint32_t>(image_.height)}};
        constexpr ImageState attachment{
            VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
            VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
            VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT};
        constexpr ImageState sampled{VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL,
                                     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                     VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
        const auto become = [&](const ImageState& from, const ImageState& to) {
            const std::array barriers{barrier(target.image, VK_IMAGE_ASPECT_DEPTH_BIT, from, to)};
            submitBarriers(commands, barriers);
        };
        become({}, attachment);
        VkRenderingAttachmentInfo depth{};
        depth.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        depth.imageView = target.view;
        depth.imageLayout = attachment.layout;
        depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        VkRenderingInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
        info.renderArea = all;
        info.layerCount = 1;
        info.pDepthAttachment = &depth;
        vkCmdBeginRendering(commands, &info);
        const VkViewport viewport{0, 0, static_cast<float>(image_.width), static_cast<float>(image_.height),
                                  0, 1};
        vkCmdSetViewport(commands, 0, 1, &viewport);
        vkCmdSetScissor(commands, 0, 1, &all);
        const VkDescriptorSet set = sets_[0];
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0, nullptr);
        for (std::uint32_t s = 0; s < pipelines_.size(); ++s) {
            const std::array constants{all.extent.width, static_cast<std::uint32_t>(image_.samples), s};
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                               constants.data());
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[s]);
            vkCmdDraw(commands, 3, 1, 0, 0);
        }
        vkCmdEndRendering(commands);
        become(attachment, sampled);
    }

private:
    static constexpr std::array types{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    const DepthSamples& image_;
    GpuBuffer values_;
    OwnedDescriptorSetLayout set_layout_;
    DescriptorSets sets_;
    OwnedPipelineLayout layout_;
    std::vector<OwnedPipeline> pipelines_;
};

struct TileBounds {
    gpu::uvec2 tiles;
    std::vector<gpu::vec2> depths;
};

// The compute shader's result, for tiles of 1 << tileShift pixels.
TileBounds tileDepthBounds(const View& view, const DepthSamples& stored, gpu::uint tileShift) {
    KernelFrame frame(probeDevice(), view);
    gpu::LightGrid grid{};
    grid.tile_shift = tileShift;
    const gpu::uint side = 1u << tileShift;
    grid.tiles = {(static_cast<gpu::uint>(stored.width) + side - 1) / side,
                  (static_cast<gpu::uint>(stored.height) + side - 1) / side};
    const GpuBuffer gridBuffer =
        makeBuffer<gpu::LightGrid>(probeDevice(), frame.uploader(), "light grid", std::span(&grid, 1),
                                   VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    frame.uploader().flush();
    frame.sets().buffer(0, gpu::BINDING_LIGHT_GRID, gridBuffer.handle());

    const DepthImage image(stored);
    const SampleDraw samples(frame.uploader(), stored);
    const std::size_t tiles = std::size_t{grid.tiles.x} * grid.tiles.y;
    const GpuBuffer out(probeDevice(), "tile depths", tiles * sizeof(gpu::vec2),
                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    constexpr VkDescriptorType storage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const std::span<const VkDescriptorType> types = listBindings();
    DescriptorSets set(probeDevice(), frame.lists().lists(), types, 1);
    for (std::uint32_t binding = 0; binding < types.size(); ++binding)
        if (types[binding] == storage) set.buffer(0, binding, out.handle());
    const OwnedSampler sampler = makeNearestSampler(probeDevice());
    set.image(0, gpu::BINDING_LISTS_DEPTH, image.view, sampler, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    Pipelines kernels(probeDevice(), VK_NULL_HANDLE);
    const auto samples_of = static_cast<gpu::uint>(stored.samples);
    const Pipeline kernel =
        kernels.compute(Shader::cull_lights_depth_bounds_comp,
                        Variant().set(gpu::FEATURE_samples, samples_of), frame.lists().pipeline());
    probeDevice().submit([&](VkCommandBuffer commands) {
        samples.record(commands, image);
        const std::array sets{frame.set(), set[0]};
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, frame.lists().pipeline(), 0,
                                sets.size(), sets.data(), 0, nullptr);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel);
        vkCmdDispatch(commands, grid.tiles.x, grid.tiles.y, 1);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
    });
    return {grid.tiles, contents<gpu::vec2>(probeDevice(), out)};
}

// Depths from 0.5 m to 500 m. The nearest and farthest depth of a tile are each in one sample of one
// pixel, anywhere in it. Some tiles have background in one sample, some only background.
DepthSamples randomImage(const View& view, int samples, gpu::uint tileShift, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto among = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    DepthSamples stored{view.width, view.height, samples};
    const int side = 1 << tileShift;
    for (int y = 0; y < stored.height; y += side)
        for (int x = 0; x < stored.width; x += side) {
            if (among(6) == 0) continue;
            const int across = std::min(side, stored.width - x), down = std::min(side, stored.height - y);
            const double middle = 1 + 99 * unit(random);
            const auto sampleOf = [&]() -> float& {
                return stored.at(x + among(across), y + among(down), among(samples));
            };
            for (int v = 0; v < down; ++v)
                for (int u = 0; u < across; ++u)
                    for (int s = 0; s < samples; ++s)
                        stored.at(x + u, y + v, s) =
                            static_cast<float>(reversedOf(view, middle * (1 + 0.1 * unit(random))));
            sampleOf() = static_cast<float>(reversedOf(view, middle * (0.5 + 0.3 * unit(random))));
            sampleOf() = static_cast<float>(reversedOf(view, middle * (2 + 3 * unit(random))));
            if (among(3) == 0) sampleOf() = 0;
        }
    return stored;
}

// Counts the tiles whose bounds differ from the samples' in double. A float32 division is within 3 ULP
// (2.5 by Vulkan, and one for the sum).
int wrongTiles(const View& view, const DepthSamples& stored, gpu::uint tileShift, const TileBounds& bounds) {
    const int side = 1 << tileShift;
    const auto same = [](float a, double b) { return std::abs(double{a} - b) <= 4e-7 * b; };
    int wrong = 0;
    for (gpu::uint ty = 0; ty < bounds.tiles.y; ++ty)
        for (gpu::uint tx = 0; tx < bounds.tiles.x; ++tx) {
            double min = gpu::MAX_BOUND_RADIUS, largest = 0;
            const int x0 = static_cast<int>(tx) * side, y0 = static_cast<int>(ty) * side;
            for (int y = y0; y < std::min(y0 + side, stored.height); ++y)
                for (int x = x0; x < std::min(x0 + side, stored.width); ++x)
                    for (int s = 0; s < stored.samples; ++s) {
                        const float z = stored.at(x, y, s);
                        if (z == 0) continue;
                        min = std::min(min, depthOf(view, double{z}));
                        largest = std::max(largest, depthOf(view, double{z}));
                    }
            const gpu::vec2 got = bounds.depths[ty * bounds.tiles.x + tx];
            wrong += !same(got.x, min) || !same(got.y, largest);
        }
    return wrong;
}

// One and four samples a pixel; tiles with as many pixels as threads, and with four times as many.
TEST(LightDepths, AreThoseOfAllSamples) {
    const View view = plainView(75, 53);
    for (const int samples : {1, 4})
        for (const gpu::uint tileShift : {4u, 5u}) {
            const DepthSamples stored = randomImage(view, samples, tileShift, 41);
            const TileBounds bounds = tileDepthBounds(view, stored, tileShift);
            EXPECT_EQ(wrongTiles(view, stored, tileShift, bounds), 0)
                << samples << " samples, 2^" << tileShift;
        }
}

// Negative control: every sample counts. An image that differs in one sample of each pixel has other
// bounds.
TEST(LightDepths, NoSampleIsPassedOver) {
    const View view = plainView(75, 53);
    const DepthSamples stored = randomImage(view, 4, 4, 42);
    const TileBounds bounds = tileDepthBounds(view, stored, 4);
    EXPECT_EQ(wrongTiles(view, stored, 4, bounds), 0);
    for (int s = 0; s < 4; ++s) {
        DepthSamples other = stored;
        for (int y = 0; y < other.height; ++y)
            for (int x = 0; x < other.width; ++x)
                if (float& z = other.at(x, y, s); z > 0) z *= 0.1f;
        EXPECT_GT(wrongTiles(view, other, 4, bounds), 10) << "sample " << s;
        EXPECT_EQ(wrongTiles(view, other, 4, tileDepthBounds(view, other, 4)), 0) << "sample " << s;
    }
}

}  // namespace
}  // namespace diptych
