// SPDX-License-Identifier: MIT
#include "shared/vulkan/device/resources.h"

#include "shared/vulkan/instance/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace diptych {

namespace {

[[noreturn]] void refuse(const Device& device, const std::string& name, const std::string& why) {
    throw std::runtime_error(
        fmt::format("device {} ({}): {}: {}", device.info().index, device.info().name, name, why));
}

// Throws if the device does not support the image.
void checkImage(const Device& device, const GpuImageInfo& info) {
    const auto uses = [&](VkImageUsageFlags usage, std::uint32_t use) {
        return (info.usage & usage) != 0 ? use : 0;
    };
    using namespace format_use;
    const std::uint32_t attached = uses(VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, drawn) |
                                   uses(VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, depth);
    std::uint32_t needed =
        attached | uses(VK_IMAGE_USAGE_SAMPLED_BIT, sampled) | uses(VK_IMAGE_USAGE_STORAGE_BIT, stored);
    if (info.filtered) needed |= filtered;
    if (info.samples > VK_SAMPLE_COUNT_1_BIT) needed |= multisampled;
    if (const auto lacks = device.support().lacks(info.format, needed)) refuse(device, info.name, *lacks);
    const VkImageFormatProperties can = device.support().images(info.format, info.usage);
    const std::uint32_t max = attached != 0 ? device.support().maxPixels() : ~0u;
    if ((can.sampleCounts & info.samples) == 0)
        refuse(device, info.name,
               fmt::format("it does not support {} for this use with {} samples per pixel; use --msaa 1 and "
                           "--lighting fragment, or choose another device with --device",
                           nameOf(info.format), static_cast<int>(info.samples)));
    if (info.width > std::min(can.maxExtent.width, max) ||
        info.height > std::min(can.maxExtent.height, max) || info.layers > can.maxArrayLayers ||
        info.levels > can.maxMipLevels)
        refuse(device, info.name,
               fmt::format("{} x {} texels and {} layers exceed the limit of {}, {} x {} and {}; use a "
                           "smaller --size or --shadow-size, or choose another device with --device",
                           info.width, info.height, info.layers, nameOf(info.format),
                           std::min(can.maxExtent.width, max), std::min(can.maxExtent.height, max),
                           can.maxArrayLayers));
}

}  // namespace

VkImageAspectFlags aspectOf(VkFormat format) {
    const bool depth = format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_X8_D24_UNORM_PACK32 ||
                       format == VK_FORMAT_D16_UNORM;
    return depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

std::uint32_t bytesPerTexel(VkFormat format) {
    switch (format) {
        case VK_FORMAT_D16_UNORM:
            return 2;
        case VK_FORMAT_R8G8B8A8_UNORM:
        case VK_FORMAT_R8G8B8A8_SRGB:
        case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
        case VK_FORMAT_A2B10G10R10_UNORM_PACK32:
        case VK_FORMAT_R16G16_SNORM:
        case VK_FORMAT_R16G16_SFLOAT:
        case VK_FORMAT_R16G16_UNORM:
        case VK_FORMAT_R32_UINT:
        case VK_FORMAT_R32_SFLOAT:
        case VK_FORMAT_D32_SFLOAT:
        case VK_FORMAT_X8_D24_UNORM_PACK32:
            return 4;
        case VK_FORMAT_R16G16B16A16_SFLOAT:
        case VK_FORMAT_R16G16B16A16_UNORM:
        case VK_FORMAT_R32G32_UINT:
        case VK_FORMAT_R32G32_SFLOAT:
            return 8;
        case VK_FORMAT_R32G32B32A32_UINT:
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return 16;
        default:
            throw std::logic_error("bytesPerTexel: format " + std::to_string(format) + " is not in the list");
    }
}

OwnedSampler makeNearestSampler(Device& device) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.addressModeU = info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler = VK_NULL_HANDLE;
    checkResult(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    return {device.handle(), sampler};
}

OwnedSampler makeLinearSampler(Device& device) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    info.addressModeU = info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    VkSampler sampler = VK_NULL_HANDLE;
    checkResult(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    return {device.handle(), sampler};
}

GpuBuffer::GpuBuffer(Device& device, const std::string& name, VkDeviceSize size, VkBufferUsageFlags usage,
                     MemoryUse use)
    : size_(std::max<VkDeviceSize>(size, 1)) {
    if ((usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) != 0 && size_ > device.limits().maxStorageBufferRange)
        throw std::runtime_error(
            fmt::format("the scene's {} need {} MiB; {} reads up to {} MiB of one buffer", name, size_ >> 20,
                        device.info().name, device.limits().maxStorageBufferRange >> 20));
    if (size_ > device.support().maxBytesOfBuffer())
        throw std::runtime_error(fmt::format("the scene's {} need {} MiB; {} has buffers of up to {} MiB",
                                             name, size_ >> 20, device.info().name,
                                             device.support().maxBytesOfBuffer() >> 20));
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                  .pNext = nullptr,
                                  .flags = 0,
                                  .size = size_,
                                  .usage = usage,
                                  .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                  .queueFamilyIndexCount = 0,
                                  .pQueueFamilyIndices = nullptr};
    VkBuffer buffer = VK_NULL_HANDLE;
    checkResult(vkCreateBuffer(device.handle(), &info, nullptr, &buffer), "vkCreateBuffer");
    buffer_ = OwnedBuffer(device.handle(), buffer);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.handle(), buffer, &needs);
    // Shaders load four words at once through addresses.
    if ((usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0)
        needs.alignment = std::max(needs.alignment, VkDeviceSize{16});
    memory_ = device.memory().allocate(needs, use, false, "the buffer " + name);
    checkResult(vkBindBufferMemory(device.handle(), buffer, memory_.memory(), memory_.offset()),
                "vkBindBufferMemory");
    if ((usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0) {
        const VkBufferDeviceAddressInfo whose{
            .sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, .pNext = nullptr, .buffer = buffer};
        address_ = vkGetBufferDeviceAddress(device.handle(), &whose);
    }
    device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer), name);
}

GpuImage::GpuImage(Device& device, const GpuImageInfo& info, Memory memory)
    : device_(device.handle()), info_(info) {
    checkImage(device, info);
    const VkImageCreateInfo create{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                   .pNext = nullptr,
                                   .flags = 0,
                                   .imageType = VK_IMAGE_TYPE_2D,
                                   .format = info.format,
                                   .extent = {info.width, info.height, 1},
                                   .mipLevels = info.levels,
                                   .arrayLayers = info.layers,
                                   .samples = info.samples,
                                   .tiling = VK_IMAGE_TILING_OPTIMAL,
                                   .usage = info.usage,
                                   .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                   .queueFamilyIndexCount = 0,
                                   .pQueueFamilyIndices = nullptr,
                                   .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    VkImage image = VK_NULL_HANDLE;
    checkResult(vkCreateImage(device_, &create, nullptr, &image), "vkCreateImage");
    image_ = OwnedImage(device_, image);
    device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(image), info.name);
    if (memory == Memory::none) return;
    memory_ =
        device.memory().allocate(requirements(), MemoryUse::device, true,
                                 fmt::format("the image {} of {}x{}", info.name, info.width, info.height));
    bind(memory_.memory(), memory_.offset());
}

VkMemoryRequirements GpuImage::requirements() const {
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device_, image_, &needs);
    return needs;
}

void GpuImage::bind(VkDeviceMemory memory, VkDeviceSize offset) {
    checkResult(vkBindImageMemory(device_, image_, memory, offset), "vkBindImageMemory");
    bound_ = true;
    constexpr VkImageUsageFlags viewed = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                         VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                         VK_IMAGE_USAGE_STORAGE_BIT;
    if ((info_.usage & viewed) != 0) view_ = makeView(0, info_.levels, 0, info_.layers);
}

OwnedImageView GpuImage::makeView(std::uint32_t level, std::uint32_t levels, std::uint32_t layer,
                                  std::uint32_t layers) const {
    const VkImageViewCreateInfo viewInfo{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .image = image_,
        .viewType = layers > 1 || info_.array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
        .format = info_.format,
        .components = {},
        .subresourceRange = {aspect(), level, levels, layer, layers}};
    VkImageView view = VK_NULL_HANDLE;
    checkResult(vkCreateImageView(device_, &viewInfo, nullptr, &view), "vkCreateImageView");
    return {device_, view};
}

OwnedBufferView makeTexelView(Device& device, const std::string& name, const GpuBuffer& buffer,
                              VkFormat format, VkDeviceSize bytes) {
    if (const auto lacks = device.support().lacks(format, format_use::texels)) refuse(device, name, *lacks);
    const VkDeviceSize texels = std::min(bytes, buffer.size()) / bytesPerTexel(format);
    if (texels > device.limits().maxTexelBufferElements)
        throw std::runtime_error(
            fmt::format("the scene's {} need {} texels; {} reads up to {} texels of one buffer", name, texels,
                        device.info().name, device.limits().maxTexelBufferElements));
    const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                      .pNext = nullptr,
                                      .flags = 0,
                                      .buffer = buffer.handle(),
                                      .format = format,
                                      .offset = 0,
                                      .range = bytes};
    VkBufferView view = VK_NULL_HANDLE;
    checkResult(vkCreateBufferView(device.handle(), &info, nullptr, &view), "vkCreateBufferView");
    return {device.handle(), view};
}

VkImageAspectFlags GpuImage::aspect() const {
    return aspectOf(info_.format);
}

VkImageMemoryBarrier2 barrier(VkImage image, VkImageAspectFlags aspect, const ImageState& from,
                              const ImageState& to) {
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .pNext = nullptr,
            .srcStageMask = from.stage,
            .srcAccessMask = from.access,
            .dstStageMask = to.stage,
            .dstAccessMask = to.access,
            .oldLayout = from.layout,
            .newLayout = to.layout,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image,
            .subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
}

void memoryBarrier(VkCommandBuffer commands, VkPipelineStageFlags2 fromStage, VkAccessFlags2 fromAccess,
                   VkPipelineStageFlags2 toStage, VkAccessFlags2 toAccess) {
    VkMemoryBarrier2 memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    memory.srcStageMask = fromStage;
    memory.srcAccessMask = fromAccess;
    memory.dstStageMask = toStage;
    memory.dstAccessMask = toAccess;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &memory;
    vkCmdPipelineBarrier2(commands, &dependency);
}

void submitBarriers(VkCommandBuffer commands, std::span<const VkImageMemoryBarrier2> barriers) {
    if (barriers.empty()) return;
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .pNext = nullptr,
                                .dependencyFlags = 0,
                                .memoryBarrierCount = 0,
                                .pMemoryBarriers = nullptr,
                                .bufferMemoryBarrierCount = 0,
                                .pBufferMemoryBarriers = nullptr,
                                .imageMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
                                .pImageMemoryBarriers = barriers.data()};
    vkCmdPipelineBarrier2(commands, &info);
}

namespace {
constexpr VkDeviceSize stagingSize = VkDeviceSize{32} << 20;
constexpr VkDeviceSize stagingAlignment = 16;  // of every uploaded texel
}  // namespace

struct Uploader::State {
    Device& device;
    GpuBuffer staging{};
    VkDeviceSize used = 0;
    std::uint64_t uploaded = 0;  // bytes so far
    std::vector<std::function<void(VkCommandBuffer)>> copies{};

    // Staging memory for `bytes`; larger data are uploaded in pieces.
    std::byte* reserve(VkDeviceSize bytes, VkDeviceSize& offset) {
        if (used + bytes > staging.size()) copy();
        if (bytes > staging.size())
            staging = GpuBuffer(device, "staging", std::max(bytes, stagingSize),
                                VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::upload);
        offset = used;
        used += (bytes + stagingAlignment - 1) / stagingAlignment * stagingAlignment;
        return static_cast<std::byte*>(staging.mapped()) + offset;
    }

    // Submits the pending copies, so that the staging buffer can be reused.
    void copy() {
        if (!copies.empty())
            device.submit([&](VkCommandBuffer commands) {
                for (const auto& record : copies) record(commands);
                memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                              VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT);
            });
        copies.clear();
        used = 0;
    }
};

Uploader::Uploader(Device& device) : state_(new State{device}) {}

Uploader::~Uploader() = default;

std::uint64_t Uploader::bytes() const {
    return state_->uploaded;
}

void Uploader::buffer(const GpuBuffer& target, std::span<const std::byte> data) {
    state_->uploaded += data.size();
    for (VkDeviceSize done = 0; done < data.size();) {
        const VkDeviceSize bytes = std::min<VkDeviceSize>(data.size() - done, stagingSize);
        VkBufferCopy copy{.srcOffset = 0, .dstOffset = done, .size = bytes};
        std::copy_n(data.data() + done, bytes, state_->reserve(bytes, copy.srcOffset));
        state_->copies.push_back([this, copy, to = target.handle()](VkCommandBuffer commands) {
            vkCmdCopyBuffer(commands, state_->staging.handle(), to, 1, &copy);
        });
        done += bytes;
    }
}

void Uploader::level(const GpuImage& target, std::uint32_t level, std::span<const std::byte> data) {
    VkDeviceSize offset = 0;
    state_->uploaded += data.size();
    std::copy(data.begin(), data.end(), state_->reserve(data.size(), offset));
    const GpuImageInfo& info = target.info();
    const VkBufferImageCopy copy{
        .bufferOffset = offset,
        .bufferRowLength = 0,
        .bufferImageHeight = 0,
        .imageSubresource = {target.aspect(), level, 0, 1},
        .imageOffset = {},
        .imageExtent = {std::max(info.width >> level, 1u), std::max(info.height >> level, 1u), 1}};
    const bool first = level == 0, last = level + 1 == info.levels;
    state_->copies.push_back([this, copy, first, last, image = target.handle(),
                              aspect = target.aspect()](VkCommandBuffer commands) {
        const ImageState written{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                 VK_ACCESS_2_TRANSFER_WRITE_BIT};
        const ImageState read{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                              VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
        if (first) submitBarriers(commands, std::array{barrier(image, aspect, {}, written)});
        vkCmdCopyBufferToImage(commands, state_->staging.handle(), image, written.layout, 1, &copy);
        if (last) submitBarriers(commands, std::array{barrier(image, aspect, written, read)});
    });
}

void Uploader::flush() {
    state_->copy();
    state_->staging = {};
}

}  // namespace diptych
