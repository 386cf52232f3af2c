// SPDX-License-Identifier: MIT
// Workload of passes from pipeline statistics (Vulkan 1.3, 18.3) and declarations.
#include "shared/vulkan/device/commands.h"
#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/passes/pass_resource.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace diptych {

namespace {

// In bit order, which is the order of results. Fragment shader invocations are not included: lavapipe
// counts whole blocks of 4x4 pixels, before the depth test.
constexpr VkQueryPipelineStatisticFlags drawStatistics =
    VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_CLIPPING_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT;
constexpr std::size_t statistics = 3;

template <std::size_t N>
std::array<std::uint64_t, N> resultsOf(VkDevice device, VkQueryPool pool) {
    std::array<std::uint64_t, N> found{};
    checkResult(vkGetQueryPoolResults(device, pool, 0, 1, sizeof found, found.data(), sizeof found,
                                      VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                "vkGetQueryPoolResults");
    return found;
}

std::uint64_t bytesOfPart(const GpuImageInfo& info, const Part& part) {
    std::uint64_t texels = 0;
    for (std::uint32_t level = part.level; level < part.level + part.levels; ++level) {
        const VkExtent2D extent = extentOf(info, {level, 0});
        texels += std::uint64_t{extent.width} * extent.height;
    }
    return texels * part.layers * static_cast<std::uint64_t>(info.samples) * bytesPerTexel(info.format);
}

}  // namespace

// Samples per pixel of the pass's attachments.
std::uint64_t PassList::samplesOf(const Pass& pass) const {
    return static_cast<std::uint64_t>(resource(pass.colors_.front().image).image->info().samples);
}

// Attachments count as read if their contents are kept, not if they are cleared. Reads by the depth test
// are not counted, because they mostly see the pass's own writes.
void PassList::addTraffic(const Pass& pass, PassCounts& counts) const {
    const auto bytes = [&](ImageRef image, const Part& part) {
        return bytesOfPart(resource(image).image->info(), part);
    };
    const auto attach = [&](const Pass::Attachment& a, bool written) {
        if (!a.image.valid()) return;
        const std::uint64_t size = bytes(a.image, {a.slice.level, 1, a.slice.layer, 1});
        if (a.load == Load::keep) counts.read += size;
        if (written) counts.written += size;
        if (a.resolved.valid()) counts.written += bytes(a.resolved, {0, 1, 0, 1});
    };
    for (const Pass::Attachment& color : pass.colors_) attach(color, true);
    attach(pass.depth_, pass.depth_writes_);
    for (const Pass::ImageUse& use : pass.images_) {
        const Part part = use.whole ? wholeOf(*resource(use.image).image) : use.part;
        const std::uint64_t size = bytes(use.image, part);
        (writes(use.access) ? counts.written : counts.read) += size;
    }
    for (const auto& [buffer, access] : pass.buffers_)
        (writes(access) ? counts.written : counts.read) += resources_[buffer.index]->buffer->size();
}

std::vector<PassCounts> PassList::count(std::size_t first, std::size_t last) {
    if (!device_.support().has(DeviceFeature::pipelineStatisticsQuery) ||
        !device_.support().has(DeviceFeature::occlusionQueryPrecise))
        throw std::runtime_error(
            fmt::format("{}: counting needs pipeline statistics and precise occlusion queries, which this "
                        "device lacks; choose another device with --device",
                        device_.info().name));
    prepare(first, last);
    const OwnedQueryPool stages = makeQueryPool(device_.handle(), VK_QUERY_TYPE_PIPELINE_STATISTICS, 1,
                                                drawStatistics),
                         samples = makeQueryPool(device_.handle(), VK_QUERY_TYPE_OCCLUSION, 1);
    std::vector<PassCounts> all;
    for (const Span& span : spans(first, last)) {
        PassCounts& counts = all.emplace_back(PassCounts{.name = passes_[span.first]->name_});
        for (std::size_t i = span.first; i < span.last; ++i) {
            const Pass& pass = *passes_[i];
            addTraffic(pass, counts);
            device_.submit(
                [&](VkCommandBuffer commands) {
                    vkCmdResetQueryPool(commands, stages, 0, 1);
                    vkCmdResetQueryPool(commands, samples, 0, 1);
                    vkCmdBeginQuery(commands, stages, 0, 0);
                    vkCmdBeginQuery(commands, samples, 0, VK_QUERY_CONTROL_PRECISE_BIT);
                    runPiece({.pass = i, .span = 0}, commands);
                    vkCmdEndQuery(commands, samples, 0);
                    vkCmdEndQuery(commands, stages, 0);
                },
                pass.name_);
            const auto [vertices, triangles, compute] = resultsOf<statistics>(device_.handle(), stages);
            counts.vertices += vertices;
            counts.triangles += triangles;
            counts.compute += compute;
            if (pass.kind_ != Pass::Kind::draw) continue;
            const std::uint64_t passed = resultsOf<1>(device_.handle(), samples)[0];
            counts.samples += passed;
            counts.outputs += passed * pass.colors_.size();
            if (!pass.colors_.empty()) counts.fragments += passed / samplesOf(pass);
        }
    }
    return all;
}

}  // namespace diptych
