// SPDX-License-Identifier: MIT
// Buffers and images with their memory. Move-only. Keep them until the device has finished with them;
// Device::submit waits.
#pragma once

#include "shared/contract/types.h"
#include "shared/vulkan/device/device.h"

#include <cstddef>
#include <span>
#include <string>

namespace diptych {

// For texelFetch and textureGather, which do not filter; gathers clamp to the edge.
OwnedSampler makeNearestSampler(Device& device);

// Filters between texels and mip levels; clamps to the edge.
OwnedSampler makeLinearSampler(Device& device);

class GpuBuffer {
public:
    GpuBuffer() = default;
    // Allocates at least one byte, so that empty arrays can be bound.
    GpuBuffer(Device& device, const std::string& name, VkDeviceSize size, VkBufferUsageFlags usage,
              MemoryUse use = MemoryUse::device);

    VkBuffer handle() const { return buffer_; }
    VkDeviceSize size() const { return size_; }
    void* mapped() const { return memory_.mapped(); }
    // Device address if usage includes SHADER_DEVICE_ADDRESS; else 0.
    VkDeviceAddress address() const { return address_; }

private:
    Allocation memory_;  // declared first, to outlive the buffer
    OwnedBuffer buffer_;
    VkDeviceSize size_ = 0;
    VkDeviceAddress address_ = 0;
};

// An address as shaders read it: (low word, high word).
inline gpu::uvec2 addressWords(VkDeviceAddress address) {
    return {static_cast<gpu::uint>(address), static_cast<gpu::uint>(address >> 32)};
}

// The buffer, or its first `bytes`, as a texel buffer of `format`; its usage must include
// UNIFORM_TEXEL_BUFFER. Throws std::runtime_error if it exceeds the device's limit of texels.
OwnedBufferView makeTexelView(Device& device, const std::string& name, const GpuBuffer& buffer,
                              VkFormat format, VkDeviceSize bytes = VK_WHOLE_SIZE);

struct GpuImageInfo {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t width = 1, height = 1, levels = 1;
    VkImageUsageFlags usage = 0;
    std::uint32_t layers = 1;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool array = false;     // views are arrays, even with one layer
    bool filtered = false;  // shaders filter it linearly
};

// A 2D image, or an array of several layers.
class GpuImage {
public:
    enum class Memory { own, none };  // none: call bind() first

    GpuImage() = default;
    // Throws std::runtime_error naming the format or size that the device does not support.
    GpuImage(Device& device, const GpuImageInfo& info, Memory memory = Memory::own);

    // Binds memory that outlives the image and satisfies requirements().
    void bind(VkDeviceMemory memory, VkDeviceSize offset);
    VkMemoryRequirements requirements() const;
    bool bound() const { return bound_; }

    VkImage handle() const { return image_; }
    VkImageView view() const { return view_; }  // all levels and layers; null if the usage allows no view
    OwnedImageView makeView(std::uint32_t level, std::uint32_t levels, std::uint32_t layer,
                            std::uint32_t layers) const;
    const GpuImageInfo& info() const { return info_; }
    VkImageAspectFlags aspect() const;
    VkDeviceSize bytes() const { return memory_.size(); }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    GpuImageInfo info_;
    Allocation memory_;
    OwnedImage image_;
    OwnedImageView view_;
    bool bound_ = false;
};

VkImageAspectFlags aspectOf(VkFormat format);
std::uint32_t bytesPerTexel(VkFormat format);  // of formats in use; throws std::logic_error for others

// State of a whole image before or after a barrier.
struct ImageState {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
};
VkImageMemoryBarrier2 barrier(VkImage image, VkImageAspectFlags aspect, const ImageState& from,
                              const ImageState& to);
// Makes writes of one stage visible to another, for all memory.
void memoryBarrier(VkCommandBuffer commands, VkPipelineStageFlags2 fromStage, VkAccessFlags2 fromAccess,
                   VkPipelineStageFlags2 toStage, VkAccessFlags2 toAccess);
void submitBarriers(VkCommandBuffer commands, std::span<const VkImageMemoryBarrier2> barriers);

// Copies data to device buffers and images through a staging buffer of limited size. flush() completes the
// copies and releases the staging buffer.
class Uploader {
public:
    explicit Uploader(Device& device);
    ~Uploader();
    Uploader(const Uploader&) = delete;
    Uploader& operator=(const Uploader&) = delete;

    void buffer(const GpuBuffer& target, std::span<const std::byte> data);
    // One mip level with tightly packed rows, in ascending order of levels. After the last, the image is
    // in SHADER_READ_ONLY_OPTIMAL.
    void level(const GpuImage& target, std::uint32_t level, std::span<const std::byte> data);
    void flush();
    std::uint64_t bytes() const;  // uploaded so far

private:
    struct State;
    std::unique_ptr<State> state_;
};

template <class T>
GpuBuffer makeBuffer(Device& device, Uploader& uploader, const std::string& name, std::span<const T> data,
                     VkBufferUsageFlags usage) {
    GpuBuffer buffer(device, name, data.size_bytes(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    if (!data.empty()) uploader.buffer(buffer, std::as_bytes(data));
    return buffer;
}

}  // namespace diptych
