// SPDX-License-Identifier: MIT
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/passes/pass_resource.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

namespace diptych {

namespace {

constexpr std::size_t stagingBytes = std::size_t{64} << 20;

std::size_t texelsOf(const GpuImageInfo& image, const Slice& slice) {
    const VkExtent2D extent = extentOf(image, slice);
    return std::size_t{extent.width} * extent.height;
}

// Float formats smaller than float32.
bool isSmall(VkFormat format) {
    return format == VK_FORMAT_R16G16B16A16_SFLOAT || format == VK_FORMAT_B10G11R11_UFLOAT_PACK32;
}

std::size_t componentsOf(VkFormat format) {
    if (format == VK_FORMAT_B10G11R11_UFLOAT_PACK32) return 3;
    return format == VK_FORMAT_R16G16B16A16_SFLOAT ? 4 : bytesPerTexel(format) / 4;
}

// Texel i of an image in such a format. 11-bit and 10-bit floats are 16-bit floats without sign and
// without the last mantissa bits.
std::array<float, 4> unpacked(VkFormat format, const std::uint16_t* words, std::size_t i) {
    const auto half = [](std::uint32_t bits) {
        return glm::unpackHalf1x16(static_cast<std::uint16_t>(bits));
    };
    if (format == VK_FORMAT_R16G16B16A16_SFLOAT)
        return {half(words[4 * i]), half(words[4 * i + 1]), half(words[4 * i + 2]), half(words[4 * i + 3])};
    const std::uint32_t bits = words[2 * i] | std::uint32_t{words[2 * i + 1]} << 16;  // little-endian
    return {half((bits & 0x7FFu) << 4), half((bits >> 11 & 0x7FFu) << 4), half((bits >> 22) << 5), 0.0f};
}

// Writes the requested components of an image's copy to `to`, texel by texel.
void takeComponents(const GpuImageInfo& image, const PassList::ReadBack& request, const void* copy,
                    float* to) {
    const auto first = static_cast<std::size_t>(request.first),
               kept = static_cast<std::size_t>(request.components);
    const std::size_t stored = componentsOf(image.format);
    if (first + kept > stored)
        throw std::logic_error("PassList: an image has fewer components than are read back");
    const tbb::blocked_range<std::size_t> texels(0, texelsOf(image, request.slice), 65536);
    if (isSmall(image.format)) {
        const auto* words = static_cast<const std::uint16_t*>(copy);
        tbb::parallel_for(texels, [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const std::array<float, 4> texel = unpacked(image.format, words, i);
                std::copy_n(texel.begin() + first, kept, to + i * kept);
            }
        });
        return;
    }
    const auto* from = static_cast<const float*>(copy);
    tbb::parallel_for(texels, [&](const auto& range) {
        if (kept == stored)
            std::copy_n(from + range.begin() * stored, range.size() * stored, to + range.begin() * stored);
        else
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                std::copy_n(from + i * stored + first, kept, to + i * kept);
    });
}

}  // namespace

std::vector<std::vector<float>> PassList::readBack(std::span<const ReadBack> requests) {
    std::vector<std::vector<float>> results;
    std::vector<std::span<float>> into;
    for (const ReadBack& request : requests)
        results.emplace_back(texelsOf(resource(request.image).image->info(), request.slice) *
                             static_cast<std::size_t>(request.components));
    for (std::vector<float>& result : results) into.emplace_back(result);
    readBack(requests, into);
    return results;
}

void PassList::readBack(std::span<const ReadBack> requests, std::span<const std::span<float>> into) {
    const auto bytesOf = [&](const ReadBack& request) {
        const GpuImageInfo& image = resource(request.image).image->info();
        return texelsOf(image, request.slice) * bytesPerTexel(image.format);
    };
    for (std::size_t i = 0; i < requests.size();) {
        std::size_t end = i + 1, bytes = bytesOf(requests[i]);
        while (end < requests.size() && bytes + bytesOf(requests[end]) <= stagingBytes)
            bytes += bytesOf(requests[end++]);
        copyToHost(requests.subspan(i, end - i), into.subspan(i, end - i));
        i = end;
    }
}

std::map<std::string, std::size_t> PassList::kernelResults(std::size_t first, std::size_t last) {
    std::set<std::size_t> written;
    for (std::size_t pass = first; pass < last; ++pass)
        if (passes_[pass]->kind_ == Pass::Kind::compute)
            for (const auto& [buffer, access] : passes_[pass]->buffers_)
                if (writes(access)) written.insert(buffer.index);
    std::map<std::string, std::size_t> results;
    for (const std::size_t index : written) {
        const GpuBuffer& buffer = *resources_[index]->buffer;
        std::size_t& hash = results[tracker_.name(index)];
        for (VkDeviceSize begin = 0; begin < buffer.size(); begin += stagingBytes) {
            const VkDeviceSize bytes = std::min<VkDeviceSize>(buffer.size() - begin, stagingBytes);
            const GpuBuffer read(device_, "read back", bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                 MemoryUse::readback);
            device_.submit([&](VkCommandBuffer commands) {
                barriersBefore(RecordedBarrier::no_pass, {{index, {}, access::transferRead}}, commands);
                const VkBufferCopy copy{begin, 0, bytes};
                vkCmdCopyBuffer(commands, buffer.handle(), read.handle(), 1, &copy);
                memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                              VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
            });
            const std::string_view all(static_cast<const char*>(read.mapped()), bytes);
            hash = hash * 31 + std::hash<std::string_view>()(all);
        }
    }
    return results;
}

void PassList::copyToHost(std::span<const ReadBack> requests, std::span<const std::span<float>> into) {
    const auto infoOf = [&](const ReadBack& request) -> const GpuImageInfo& {
        return resource(request.image).image->info();
    };
    // Consecutive requests for one image share one copy.
    std::vector<ReadBack> copied;
    std::vector<std::size_t> copy_of;
    for (const ReadBack& request : requests) {
        if (copied.empty() || copied.back().image.index != request.image.index ||
            copied.back().slice != request.slice)
            copied.push_back(request);
        copy_of.push_back(copied.size() - 1);
    }
    std::vector<GpuBuffer> buffers;
    std::vector<Use> uses;
    for (const ReadBack& request : copied) {
        const GpuImageInfo& image = infoOf(request);
        buffers.emplace_back(device_, "read back",
                             texelsOf(image, request.slice) * bytesPerTexel(image.format),
                             VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback);
        const Resource& found = resource(request.image);
        if (found.life == Life::transient && (last_run_ < found.first || last_run_ > found.last))
            throw std::logic_error("PassList: " + found.image->info().name +
                                   " is a transient and cannot be read back");
        uses.push_back(
            {request.image.index, {request.slice.level, 1, request.slice.layer, 1}, access::copiedFromImage});
    }
    device_.submit([&](VkCommandBuffer commands) {
        barriersBefore(RecordedBarrier::no_pass, uses, commands);
        for (std::size_t i = 0; i < copied.size(); ++i) {
            const GpuImage& image = *resource(copied[i].image).image;
            const Slice& slice = copied[i].slice;
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
    for (std::size_t i = 0; i < requests.size(); ++i)
        takeComponents(infoOf(requests[i]), requests[i], buffers[copy_of[i]].mapped(), into[i].data());
}

}  // namespace diptych
