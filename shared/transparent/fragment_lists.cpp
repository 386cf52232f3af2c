// SPDX-License-Identifier: MIT
#include "shared/transparent/fragment_lists.h"

#include "shared/vulkan/device/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace diptych {

namespace {

constexpr VkBufferUsageFlags storage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

std::uint64_t keyBytes(std::uint64_t pixels, std::uint32_t layers) {
    return (pixels * (layers + gpu::FRAGMENT_SUMS) + gpu::FRAGMENT_COUNTERS) * sizeof(std::uint64_t);
}
std::uint64_t fragmentBytes(std::uint64_t pixels, std::uint32_t layers) {
    return pixels * layers * sizeof(glm::vec4);
}

std::vector<std::byte> readBuffer(Device& device, const GpuBuffer& buffer, VkDeviceSize offset,
                                  VkDeviceSize size) {
    const GpuBuffer seen(device, "fragments on the host", size, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         MemoryUse::readback);
    device.submit([&](VkCommandBuffer commands) {
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        const VkBufferCopy copy{offset, 0, size};
        vkCmdCopyBuffer(commands, buffer.handle(), seen.handle(), 1, &copy);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    const auto* const bytes = static_cast<const std::byte*>(seen.mapped());
    return {bytes, bytes + size};
}

}  // namespace

FragmentLists::FragmentLists(Device& device, const DrawList& draws, const Settings& settings)
    : device_(device) {
    if (settings.transparency != Transparency::list || draws.blended().empty()) return;
    if (!device.support().sortsFragments())
        throw std::runtime_error(
            fmt::format("--transparency list: {} lacks 64-bit atomics, stores or triangle indices in "
                        "fragment shaders; use sorted, weighted or moments",
                        device.info().name));
    layers_ = static_cast<std::uint32_t>(settings.transparency_layers);
    width_ = static_cast<std::uint32_t>(settings.size.width);
    const auto height = static_cast<std::uint32_t>(settings.size.height);
    const std::uint64_t max = device.limits().maxStorageBufferRange,
                        row = std::max(keyBytes(width_, layers_), fragmentBytes(width_, layers_));
    rows_ = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(max / row, 1, height));
    keys_ = GpuBuffer(device, "fragment keys", keyBytes(pixels(), layers_), storage);
    fragments_ = GpuBuffer(device, "fragments", fragmentBytes(pixels(), layers_), storage);
}

void FragmentLists::bind(DescriptorSets& sets) const {
    sets.buffer(0, gpu::BINDING_FRAGMENT_KEYS, keys_.handle());
    sets.buffer(0, gpu::BINDING_FRAGMENTS, fragments_.handle());
}

void FragmentLists::addClear(PassList& passes, bool counters) const {
    passes.copy("transparent lists")
        .uses(passes.buffer("fragment keys", keys_), access::transferWrite)
        .record([this, counters](VkCommandBuffer commands) {
            const VkDeviceSize sums = pixels() * layers_ * sizeof(std::uint64_t),
                               after = sums + pixels() * gpu::FRAGMENT_SUMS * sizeof(std::uint64_t);
            vkCmdFillBuffer(commands, keys_.handle(), 0, sums, ~0u);
            vkCmdFillBuffer(commands, keys_.handle(), sums, counters ? VK_WHOLE_SIZE : after - sums, 0);
        });
}

void FragmentLists::use(PassList& passes, Pass& pass) const {
    for (const BufferRef buffer :
         {passes.buffer("fragment keys", keys_), passes.buffer("fragments", fragments_)})
        pass.uses(buffer, access::storageRead(inFragment)).uses(buffer, access::storageWrite(inFragment));
}

FragmentLists::Overflow FragmentLists::overflow() const {
    if (!any()) return {};
    const std::uint64_t size = gpu::FRAGMENT_COUNTERS * sizeof(std::uint64_t);
    const std::vector<std::byte> bytes = readBuffer(device_, keys_, keys_.size() - size, size);
    Overflow overflow;
    std::memcpy(&overflow.fragments, bytes.data(), sizeof overflow.fragments);
    std::memcpy(&overflow.pixels, bytes.data() + sizeof overflow.fragments, sizeof overflow.pixels);
    return overflow;
}

FragmentLists::Contents FragmentLists::contents() const {
    Contents contents;
    contents.keys.resize(pixels() * layers_);
    contents.fragments.resize(pixels() * layers_);
    const std::vector<std::byte> keys =
        readBuffer(device_, keys_, 0, contents.keys.size() * sizeof(std::uint64_t));
    const std::vector<std::byte> fragments = readBuffer(device_, fragments_, 0, fragments_.size());
    std::memcpy(contents.keys.data(), keys.data(), keys.size());
    std::memcpy(contents.fragments.data(), fragments.data(), fragments.size());
    return contents;
}

}  // namespace diptych
