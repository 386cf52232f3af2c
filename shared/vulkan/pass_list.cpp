// SPDX-License-Identifier: MIT
#include "shared/vulkan/pass_list.h"

#include "shared/vulkan/check.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {

namespace {

constexpr VkAccessFlags2 writeAccess = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                       VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                                       VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr VkPipelineStageFlags2 depthStages =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

constexpr ImageState colorAttachment{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT};
constexpr ImageState depthAttachment{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, depthStages,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr VkPipelineStageFlags2 shaderStages =
    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr ImageState sampledColor{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, shaderStages,
                                  VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
// Tested and sampled in one pass: one state for both.
constexpr ImageState readDepth{
    VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL, depthStages | shaderStages,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
constexpr ImageState copySource{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                VK_ACCESS_2_TRANSFER_READ_BIT};

}  // namespace

Pass& Pass::color(ImageRef image, Load load, VkClearColorValue clear) {
    colors_.push_back({image, load, {.color = clear}});
    return *this;
}

Pass& Pass::depth(ImageRef image, Load load, float clear) {
    depth_ = {image, load, {.depthStencil = {clear, 0}}};
    depth_writes_ = true;
    return *this;
}

Pass& Pass::depthTest(ImageRef image) {
    depth_ = {image, Load::keep, {}};
    depth_writes_ = false;
    return *this;
}

Pass& Pass::samples(ImageRef image) {
    sampled_.push_back(image);
    return *this;
}

Pass& Pass::record(std::function<void(VkCommandBuffer)> commands) {
    record_ = std::move(commands);
    return *this;
}

PassList::PassList(Device& device, std::uint32_t width, std::uint32_t height)
    : device_(device), width_(width), height_(height) {}

ImageRef PassList::image(const std::string& name, VkFormat format) {
    const VkImageUsageFlags attachment = aspectOf(format) == VK_IMAGE_ASPECT_DEPTH_BIT
                                             ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                             : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    resources_.push_back(
        {GpuImage(device_, {name, format, width_, height_, 1,
                            attachment | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}),
         {}});
    return {resources_.size() - 1};
}

Pass& PassList::draw(const std::string& name) {
    passes_.push_back(std::make_unique<Pass>());
    passes_.back()->name_ = name;
    return *passes_.back();
}

Pass& PassList::compute(const std::string& name) {
    Pass& pass = draw(name);
    pass.computes_ = true;
    return pass;
}

VkImageView PassList::view(ImageRef image) const {
    return resources_.at(image.index).image.view();
}

void PassList::transition(std::vector<VkImageMemoryBarrier2>& barriers, ImageRef ref, const ImageState& to,
                          bool discard) {
    Resource& resource = resources_.at(ref.index);
    ImageState& from = resource.state;
    const bool hazard = ((from.access | to.access) & writeAccess) != 0 || from.layout != to.layout;
    if (!hazard) {
        from.stage |= to.stage;
        return;
    }
    ImageState source = from;
    if (discard) source.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    barriers.push_back(barrier(resource.image.handle(), resource.image.aspect(), source, to));
    from = to;
}

void PassList::runPass(const Pass& pass, VkCommandBuffer commands) {
    std::vector<VkImageMemoryBarrier2> barriers;
    for (const ImageRef image : pass.sampled_)
        transition(
            barriers, image,
            resources_[image.index].image.aspect() == VK_IMAGE_ASPECT_DEPTH_BIT ? readDepth : sampledColor,
            false);
    for (const auto& color : pass.colors_)
        transition(barriers, color.image, colorAttachment, color.load == Load::clear);
    if (pass.depth_.image.valid())
        transition(barriers, pass.depth_.image, pass.depth_writes_ ? depthAttachment : readDepth,
                   pass.depth_writes_ && pass.depth_.load == Load::clear);
    submitBarriers(commands, barriers);
    if (pass.computes_) {
        device_.beginLabel(commands, pass.name_);
        pass.record_(commands);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | shaderStages,
                      VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT);
        device_.endLabel(commands);
        return;
    }

    const auto attach = [&](const Pass::Attachment& a, VkImageLayout layout, bool store) {
        VkRenderingAttachmentInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        info.imageView = view(a.image);
        info.imageLayout = layout;
        info.loadOp = a.load == Load::clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
        info.storeOp = store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_NONE;
        info.clearValue = a.clear;
        return info;
    };
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const auto& color : pass.colors_) colors.push_back(attach(color, colorAttachment.layout, true));
    VkRenderingAttachmentInfo depth{};
    if (pass.depth_.image.valid())
        depth = attach(pass.depth_, pass.depth_writes_ ? depthAttachment.layout : readDepth.layout,
                       pass.depth_writes_);
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .pNext = nullptr,
                               .flags = 0,
                               .renderArea = {{0, 0}, {width_, height_}},
                               .layerCount = 1,
                               .viewMask = 0,
                               .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                               .pColorAttachments = colors.data(),
                               .pDepthAttachment = pass.depth_.image.valid() ? &depth : nullptr,
                               .pStencilAttachment = nullptr};
    device_.beginLabel(commands, pass.name_);
    vkCmdBeginRendering(commands, &info);
    // Depth is reversed and 0 says that nothing was drawn: what lies exactly on the far plane gets the least
    // depth above it. Everything else is unchanged, being far larger.
    constexpr float leastDepth = 1e-37f;
    const VkViewport viewport{0, 0, static_cast<float>(width_), static_cast<float>(height_), leastDepth, 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &info.renderArea);
    if (pass.record_) pass.record_(commands);
    vkCmdEndRendering(commands);
    device_.endLabel(commands);
}

// Milliseconds of each pass, from time stamps around it; the device must have true ones.
std::vector<double> PassList::runWithTimestamps(std::size_t first, std::size_t last) {
    const auto count = static_cast<std::uint32_t>(last - first + 1);
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .pNext = nullptr,
                                     .flags = 0,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = count,
                                     .pipelineStatistics = 0};
    VkQueryPool handle = VK_NULL_HANDLE;
    checkResult(vkCreateQueryPool(device_.handle(), &info, nullptr, &handle), "vkCreateQueryPool");
    const OwnedQueryPool pool(device_.handle(), handle);
    device_.submit([&](VkCommandBuffer commands) {
        vkCmdResetQueryPool(commands, pool, 0, count);
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, 0);
        for (std::uint32_t i = 0; i + 1 < count; ++i) {
            runPass(*passes_[first + i], commands);
            vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, i + 1);
        }
    });
    std::vector<std::uint64_t> ticks(count);
    checkResult(
        vkGetQueryPoolResults(device_.handle(), pool, 0, count, count * sizeof(std::uint64_t), ticks.data(),
                              sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
    std::vector<double> ms;
    for (std::size_t i = 0; i + 1 < count; ++i)
        ms.push_back(static_cast<double>(ticks[i + 1] - ticks[i]) *
                     static_cast<double>(device_.limits().timestampPeriod) * 1e-6);
    return ms;
}

double PassList::run(std::size_t first, std::size_t last) {
    if (!device_.info().isCpu() && device_.limits().timestampComputeAndGraphics == VK_TRUE) {
        double total = 0;
        for (const double ms : runWithTimestamps(first, last)) total += ms;
        return total;
    }
    return device_.submit([&](VkCommandBuffer commands) {
        for (std::size_t i = first; i < last; ++i) runPass(*passes_[i], commands);
    });
}

std::vector<PassMs> PassList::profile(std::size_t first, std::size_t last) {
    std::vector<PassMs> times;
    if (!device_.info().isCpu() && device_.limits().timestampComputeAndGraphics == VK_TRUE) {
        const std::vector<double> ms = runWithTimestamps(first, last);
        for (std::size_t i = first; i < last; ++i) times.push_back({passes_[i]->name_, ms[i - first]});
    } else {
        for (std::size_t i = first; i < last; ++i)
            times.push_back({passes_[i]->name_, device_.submit([&](VkCommandBuffer commands) {
                                 runPass(*passes_[i], commands);
                             })});
    }
    return times;
}

std::vector<std::vector<float>> PassList::readBack(std::span<const ReadBack> requests) {
    constexpr std::size_t stagingBytes = std::size_t{256} << 20;
    const std::size_t largest = std::size_t{width_} * height_ * 16;
    const std::size_t atOnce = std::max<std::size_t>(1, stagingBytes / largest);
    std::vector<std::vector<float>> results(requests.size());
    for (std::size_t i = 0; i < requests.size(); i += atOnce) {
        const std::size_t count = std::min(atOnce, requests.size() - i);
        copyToHost(requests.subspan(i, count), std::span(results).subspan(i, count));
    }
    return results;
}

void PassList::copyToHost(std::span<const ReadBack> requests, std::span<std::vector<float>> results) {
    const std::size_t texels = std::size_t{width_} * height_;
    const auto floatsPerTexel = [&](ImageRef image) { return bytesPerTexel(format(image)) / 4; };
    std::vector<GpuBuffer> buffers;
    for (const ReadBack& request : requests)
        buffers.emplace_back(device_, "read back", texels * floatsPerTexel(request.image) * 4,
                             VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback);
    device_.submit([&](VkCommandBuffer commands) {
        std::vector<VkImageMemoryBarrier2> barriers;
        for (const ReadBack& request : requests) transition(barriers, request.image, copySource, false);
        submitBarriers(commands, barriers);
        for (std::size_t i = 0; i < requests.size(); ++i) {
            const GpuImage& image = resources_.at(requests[i].image.index).image;
            const VkBufferImageCopy copy{.bufferOffset = 0,
                                         .bufferRowLength = 0,
                                         .bufferImageHeight = 0,
                                         .imageSubresource = {image.aspect(), 0, 0, 1},
                                         .imageOffset = {},
                                         .imageExtent = {width_, height_, 1}};
            vkCmdCopyImageToBuffer(commands, image.handle(), copySource.layout, buffers[i].handle(), 1,
                                   &copy);
        }
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    tbb::parallel_for(std::size_t{0}, requests.size(), [&](std::size_t image) {
        const auto kept = static_cast<std::size_t>(requests[image].components);
        const std::size_t stored = floatsPerTexel(requests[image].image);
        if (kept > stored)
            throw std::logic_error("PassList: an image has fewer components than are read back");
        const auto* from = static_cast<const float*>(buffers[image].mapped());
        std::vector<float>& out = results[image];
        if (kept == stored) {
            out.assign(from, from + texels * kept);
            return;
        }
        out.resize(texels * kept);
        float* to = out.data();
        for (std::size_t i = 0; i < texels; ++i, from += stored, to += kept) std::copy_n(from, kept, to);
    });
}

std::vector<std::string> PassList::names() const {
    std::vector<std::string> names;
    for (const auto& pass : passes_) names.push_back(pass->name_);
    return names;
}

std::uint64_t PassList::imageBytes() const {
    std::uint64_t bytes = 0;
    for (const Resource& resource : resources_)
        bytes += std::uint64_t{width_} * height_ * bytesPerTexel(resource.image.info().format);
    return bytes;
}

}  // namespace diptych
