// SPDX-License-Identifier: MIT
#include "shared/vulkan/pass_list.h"
#include "shared/vulkan/pass_resource.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {

namespace {

std::size_t texelsOf(const GpuImageInfo& image, const Slice& slice) {
    const VkExtent2D extent = extentOf(image, slice);
    return std::size_t{extent.width} * extent.height;
}

}  // namespace

std::vector<std::vector<float>> PassList::readBack(std::span<const ReadBack> requests) {
    constexpr std::size_t stagingBytes = std::size_t{256} << 20;
    std::vector<std::vector<float>> results(requests.size());
    for (std::size_t i = 0; i < requests.size();) {
        std::size_t count = 0, bytes = 0;
        while (i + count < requests.size()) {
            const GpuImageInfo& image = resource(requests[i + count].image).image->info();
            const std::size_t next = texelsOf(image, requests[i + count].slice) * bytesPerTexel(image.format);
            if (count > 0 && bytes + next > stagingBytes) break;
            bytes += next;
            ++count;
        }
        copyToHost(requests.subspan(i, count), std::span(results).subspan(i, count));
        i += count;
    }
    return results;
}

void PassList::copyToHost(std::span<const ReadBack> requests, std::span<std::vector<float>> results) {
    const auto infoOf = [&](const ReadBack& request) -> const GpuImageInfo& {
        return resource(request.image).image->info();
    };
    std::vector<GpuBuffer> buffers;
    for (const ReadBack& request : requests) {
        const GpuImageInfo& image = infoOf(request);
        buffers.emplace_back(device_, "read back",
                             texelsOf(image, request.slice) * bytesPerTexel(image.format),
                             VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback);
    }
    std::vector<Use> uses;
    for (const ReadBack& request : requests) {
        const Resource& found = resource(request.image);
        if (found.life == Life::transient)
            throw std::logic_error("PassList: " + found.image->info().name +
                                   " is a transient and cannot be read back");
        uses.push_back(
            {request.image.index, {request.slice.level, 1, request.slice.layer, 1}, access::copiedFromImage});
    }
    device_.submit([&](VkCommandBuffer commands) {
        barriersBefore("read back", uses, commands);
        for (std::size_t i = 0; i < requests.size(); ++i) {
            const GpuImage& image = *resource(requests[i].image).image;
            const Slice& slice = requests[i].slice;
            const VkExtent2D extent = diptych::extentOf(image.info(), slice);
            const VkBufferImageCopy copy{.bufferOffset = 0,
                                         .bufferRowLength = 0,
                                         .bufferImageHeight = 0,
                                         .imageSubresource = {image.aspect(), slice.level, slice.layer, 1},
                                         .imageOffset = {},
                                         .imageExtent = {extent.width, extent.height, 1}};
            vkCmdCopyImageToBuffer(commands, image.handle(), access::copiedFromImage.layout,
                                   buffers[i].handle(), 1, &copy);
        }
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    tbb::parallel_for(std::size_t{0}, requests.size(), [&](std::size_t image) {
        const std::size_t texels = texelsOf(infoOf(requests[image]), requests[image].slice);
        const auto kept = static_cast<std::size_t>(requests[image].components);
        const std::size_t stored = bytesPerTexel(infoOf(requests[image]).format) / 4;
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

}  // namespace diptych
