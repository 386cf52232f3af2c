// SPDX-License-Identifier: MIT
// Runs a pass list: barriers, bands, submits, timings.
#include "shared/vulkan/device/commands.h"
#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/passes/pass_resource.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace diptych {

namespace {

// Source and destination scope of an image or buffer barrier.
template <class VulkanBarrier>
VulkanBarrier scopesOf(VkStructureType type, const Barrier& barrier) {
    VulkanBarrier scopes{};
    scopes.sType = type;
    scopes.srcStageMask = barrier.from.stages;
    scopes.srcAccessMask = barrier.from.access;
    scopes.dstStageMask = barrier.to.stages;
    scopes.dstAccessMask = barrier.to.access;
    scopes.srcQueueFamilyIndex = scopes.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    return scopes;
}

double msSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

VkImageView PassList::attachmentView(ImageRef image, const Slice& slice) {
    return view(image, {slice.level, 1, slice.layer, 1});
}

void PassList::barriersBefore(std::size_t pass, const std::vector<Use>& uses, VkCommandBuffer commands) {
    const std::string name = pass == RecordedBarrier::no_pass ? "read back" : passes_[pass]->name_;
    std::vector<VkImageMemoryBarrier2> images;
    std::vector<VkBufferMemoryBarrier2> buffers;
    std::vector<VkMemoryBarrier2> memory;
    for (const Barrier& barrier : tracker_.before(name, uses)) {
        recorded_.push_back(
            {name, tracker_.name(barrier.resource), barrier.part, barrier.from, barrier.to, pass});
        const Resource& found = *resources_[barrier.resource];
        if (found.image) {
            auto of = scopesOf<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2, barrier);
            of.oldLayout = barrier.from.layout;
            of.newLayout = barrier.to.layout;
            of.image = found.image->handle();
            of.subresourceRange = {found.image->aspect(), barrier.part.level, barrier.part.levels,
                                   barrier.part.layer, barrier.part.layers};
            images.push_back(of);
            // The image barrier does not cover accesses through an earlier image in the same memory.
            if (found.before && barrier.from.layout == VK_IMAGE_LAYOUT_UNDEFINED)
                memory.push_back({.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                  .pNext = nullptr,
                                  .srcStageMask = of.srcStageMask,
                                  .srcAccessMask = of.srcAccessMask,
                                  .dstStageMask = of.dstStageMask,
                                  .dstAccessMask = of.dstAccessMask});
        } else {
            auto of = scopesOf<VkBufferMemoryBarrier2>(VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2, barrier);
            of.buffer = found.buffer->handle();
            of.size = VK_WHOLE_SIZE;
            buffers.push_back(of);
        }
    }
    if (images.empty() && buffers.empty()) return;
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .pNext = nullptr,
                                .dependencyFlags = 0,
                                .memoryBarrierCount = static_cast<std::uint32_t>(memory.size()),
                                .pMemoryBarriers = memory.data(),
                                .bufferMemoryBarrierCount = static_cast<std::uint32_t>(buffers.size()),
                                .pBufferMemoryBarriers = buffers.data(),
                                .imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size()),
                                .pImageMemoryBarriers = images.data()};
    vkCmdPipelineBarrier2(commands, &info);
}

// Transients whose first pass this is wait for the previous user of their memory.
void PassList::beginLives(BarrierTracker& tracker, std::size_t pass) const {
    for (std::size_t i = 0; i < resources_.size(); ++i)
        if (resources_[i]->before && resources_[i]->first == pass) tracker.alias(i, *resources_[i]->before);
}

// Rows of a band.
Pass::Rows PassList::rowsOf(std::uint32_t rows, const Piece& piece) {
    const auto row = [&](std::uint32_t band) {
        return static_cast<std::uint32_t>(std::uint64_t{rows} * band / piece.bands);
    };
    return {row(piece.band), row(piece.band + 1) - row(piece.band)};
}

void PassList::runPiece(const Piece& piece, VkCommandBuffer commands) {
    const Pass& pass = *passes_[piece.pass];
    last_run_ = piece.pass;
    if (piece.band == 0) {
        beginLives(tracker_, piece.pass);
        barriersBefore(piece.pass, usesOf(pass), commands);
    } else {
        // Keeps the contents drawn by earlier bands.
        std::vector<Use> uses = usesOf(pass);
        for (Use& use : uses) use.discards = false;
        barriersBefore(piece.pass, uses, commands);
    }
    device_.beginLabel(commands, pass.name_);
    if (pass.kind_ == Pass::Kind::draw)
        renderPass(pass, piece, commands);
    else if (pass.record_rows_)
        pass.record_rows_(commands, rowsOf(pass.rows_, piece));
    else if (pass.record_)
        pass.record_(commands);
    device_.endLabel(commands);
}

VkExtent2D PassList::extentOf(const Pass& pass) const {
    const Pass::Attachment* const any = !pass.colors_.empty()       ? &pass.colors_.front()
                                        : pass.depth_.image.valid() ? &pass.depth_
                                                                    : nullptr;
    if (any == nullptr) return pass.covered_.width > 0 ? pass.covered_ : VkExtent2D{width_, height_};
    return diptych::extentOf(resource(any->image).image->info(), any->slice);
}

void PassList::renderPass(const Pass& pass, const Piece& piece, VkCommandBuffer commands) {
    const VkExtent2D extent = extentOf(pass);
    const auto attach = [&](const Pass::Attachment& a, VkImageLayout layout, bool store) {
        VkRenderingAttachmentInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        info.imageView = attachmentView(a.image, a.slice);
        info.imageLayout = layout;
        info.loadOp = a.load == Load::clear && piece.band == 0 ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                                               : VK_ATTACHMENT_LOAD_OP_LOAD;
        info.storeOp = store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_NONE;
        info.clearValue = a.clear;
        if (a.resolved.valid() && piece.band + 1 == piece.bands) {
            info.resolveMode =
                &a == &pass.depth_ ? VK_RESOLVE_MODE_SAMPLE_ZERO_BIT : VK_RESOLVE_MODE_AVERAGE_BIT;
            info.resolveImageView = view(a.resolved);
            info.resolveImageLayout = layout;
        }
        return info;
    };
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const auto& color : pass.colors_)
        colors.push_back(attach(color, access::colorAttachment.layout, true));
    VkRenderingAttachmentInfo depth{};
    StoredDepths depths;
    if (pass.depth_.image.valid()) {
        depths = resource(pass.depth_.image).depths;
        depth = attach(pass.depth_,
                       pass.depth_writes_ ? access::depthAttachment.layout : access::depthTest.layout,
                       pass.depth_writes_);
        depth.clearValue.depthStencil = {depths.cleared, 0};
    }
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .pNext = nullptr,
                               .flags = 0,
                               .renderArea = {{0, 0}, extent},
                               .layerCount = 1,
                               .viewMask = 0,
                               .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                               .pColorAttachments = colors.data(),
                               .pDepthAttachment = pass.depth_.image.valid() ? &depth : nullptr,
                               .pStencilAttachment = nullptr};
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{0,
                              0,
                              static_cast<float>(extent.width),
                              static_cast<float>(extent.height),
                              depths.farthest,
                              depths.nearest};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    const Pass::Rows rows = rowsOf(extent.height, piece);
    const VkRect2D scissor{{0, static_cast<std::int32_t>(rows.first)}, {extent.width, rows.count}};
    vkCmdSetScissor(commands, 0, 1, &scissor);
    if (pass.record_) pass.record_(commands);
    vkCmdEndRendering(commands);
    device_.drawDivision().endPass();
}

std::vector<PassList::Span> PassList::spans(std::size_t first, std::size_t last) const {
    std::vector<Span> all;
    for (std::size_t i = first; i < last; ++i)
        if (!all.empty() && passes_[i]->name_ == passes_[all.back().first]->name_)
            all.back().last = i + 1;
        else
            all.push_back({i, i + 1});
    return all;
}

// Splits passes into bands if their estimated time exceeds the device's longest submit.
std::vector<PassList::Piece> PassList::pieces(const std::vector<Span>& spans) const {
    const double longest = device_.profile().longest_submit_ms;
    std::vector<Piece> all;
    for (std::size_t span = 0; span < spans.size(); ++span)
        for (std::size_t i = spans[span].first; i < spans[span].last; ++i) {
            const Pass& pass = *passes_[i];
            const double rows = pass.kind_ == Pass::Kind::draw ? extentOf(pass).height : pass.rows_;
            const auto bands =
                static_cast<std::uint32_t>(std::clamp(std::ceil(pass.ms_ / longest), 1.0, rows));
            for (std::uint32_t band = 0; band < bands; ++band)
                all.push_back({i, span, band, bands, pass.ms_ / bands});
        }
    return all;
}

// For the error message when the device is lost.
std::string PassList::describe(const std::vector<Piece>& pieces) const {
    const auto nameOfPiece = [&](const Piece& piece) {
        const std::string& name = passes_[piece.pass]->name_;
        return piece.bands == 1 ? name : fmt::format("{} ({} of {})", name, piece.band + 1, piece.bands);
    };
    const std::string first = nameOfPiece(pieces.front()), last = nameOfPiece(pieces.back());
    return first == last ? first : fmt::format("{} to {}", first, last);
}

// Adds each piece's time to its span. With time stamps, at span boundaries; otherwise the CPU time of all
// pieces, which then belong to one span.
void PassList::submit(const std::vector<Piece>& pieces, std::vector<double>& ms) {
    std::vector<std::size_t> ended;  // span that ends at each time stamp after the first
    OwnedQueryPool pool;
    const bool stamped = device_.profile().time_stamps;
    const auto max = static_cast<std::uint32_t>(pieces.size() + 1);
    if (stamped) pool = makeQueryPool(device_.handle(), VK_QUERY_TYPE_TIMESTAMP, max);
    const auto stamp = [&](VkCommandBuffer commands, std::uint32_t query) {
        if (stamped) vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, query);
    };
    const double elapsed = device_.submit(
        [&](VkCommandBuffer commands) {
            const auto start = std::chrono::steady_clock::now();
            if (stamped) vkCmdResetQueryPool(commands, pool, 0, max);
            stamp(commands, 0);
            for (std::size_t i = 0; i < pieces.size(); ++i) {
                runPiece(pieces[i], commands);
                if (i + 1 < pieces.size() && pieces[i + 1].span == pieces[i].span) continue;
                ended.push_back(pieces[i].span);
                stamp(commands, static_cast<std::uint32_t>(ended.size()));
            }
            record_ms_ += msSince(start);
        },
        describe(pieces));
    if (!stamped) {
        ms[pieces.front().span] += elapsed;
        return;
    }
    std::vector<std::uint64_t> ticks(ended.size() + 1);
    checkResult(
        vkGetQueryPoolResults(device_.handle(), pool, 0, static_cast<std::uint32_t>(ticks.size()),
                              ticks.size() * sizeof(std::uint64_t), ticks.data(), sizeof(std::uint64_t),
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
    for (std::size_t i = 0; i < ended.size(); ++i)
        ms[ended[i]] += static_cast<double>(device_.ticksBetween(ticks[i], ticks[i + 1])) *
                        static_cast<double>(device_.limits().timestampPeriod) * 1e-6;
}

// Milliseconds of each span. A submit contains pieces up to the longest submit time; without time stamps,
// only pieces of one span.
std::vector<double> PassList::runSpans(const std::vector<Span>& spans) {
    std::vector<double> ms(spans.size());
    std::vector<Piece> waiting;
    double work = 0;
    record_ms_ = 0;
    for (const Piece& piece : pieces(spans)) {
        const bool apart =
            !device_.profile().time_stamps && !waiting.empty() && waiting.back().span != piece.span;
        if (!waiting.empty() && (apart || work + piece.ms > device_.profile().longest_submit_ms)) {
            submit(waiting, ms);
            waiting.clear();
            work = 0;
        }
        waiting.push_back(piece);
        work += piece.ms;
    }
    if (!waiting.empty()) submit(waiting, ms);
    return ms;
}

double PassList::run(std::size_t first, std::size_t last) {
    prepare(first, last);
    return runSpans({{first, last}}).front();
}

std::vector<PassMs> PassList::profile(std::size_t first, std::size_t last) {
    prepare(first, last);
    const std::vector<Span> all = spans(first, last);
    const std::vector<double> ms = runSpans(all);
    std::vector<PassMs> times;
    for (std::size_t s = 0; s < all.size(); ++s) times.push_back({passes_[all[s].first]->name_, ms[s]});
    return times;
}

void PassList::enqueue(FramesInFlight& frames) {
    prepare(0, size());
    frames.submit(
        [&](VkCommandBuffer commands) {
            for (std::size_t i = 0; i < size(); ++i) runPiece({.pass = i, .span = 0}, commands);
        },
        describe({{.pass = 0, .span = 0}, {.pass = size() - 1, .span = 0}}));
}

}  // namespace diptych
