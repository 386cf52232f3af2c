// SPDX-License-Identifier: MIT
#include "shared/vulkan/pass_list.h"

#include "shared/vulkan/check.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace diptych {

struct PassList::Resource {
    // Exactly one of the two.
    std::optional<GpuImage> image;
    const GpuBuffer* buffer = nullptr;
    Life life = Life::kept;
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>, OwnedImageView> views;
    // Of a transient, once it has memory: its first and last pass, and whose the memory is before.
    std::size_t first = 0, last = 0;
    std::optional<std::size_t> before;
};

namespace {

bool isDepth(const GpuImage& image) {
    return image.aspect() == VK_IMAGE_ASPECT_DEPTH_BIT;
}

VkImageUsageFlags usageOf(const ImageDeclaration& declared) {
    VkImageUsageFlags usage = declared.usage | VK_IMAGE_USAGE_SAMPLED_BIT;
    usage |= aspectOf(declared.format) == VK_IMAGE_ASPECT_DEPTH_BIT
                 ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                 : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (declared.life == Life::kept) usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    return usage;
}

Part wholeOf(const GpuImage& image) {
    return {0, image.info().levels, 0, image.info().layers};
}

Part partOf(const Slice& slice) {
    return {slice.level, 1, slice.layer, 1};
}

std::uint64_t bytesOf(const GpuImageInfo& info) {
    std::uint64_t texels = 0;
    for (std::uint32_t level = 0; level < info.levels; ++level)
        texels += std::uint64_t{std::max(1u, info.width >> level)} * std::max(1u, info.height >> level);
    return texels * info.layers * static_cast<std::uint64_t>(info.samples) * bytesPerTexel(info.format);
}

}  // namespace

// ---- declaring ---------------------------------------------------------------------------------------

Pass& Pass::color(ImageRef image, Load load, VkClearColorValue clear, Slice slice, ImageRef resolved) {
    colors_.push_back({image, load, {.color = clear}, slice, resolved});
    return *this;
}

Pass& Pass::depth(ImageRef image, Load load, float clear, Slice slice) {
    depth_ = {image, load, {.depthStencil = {clear, 0}}, slice, {}};
    depth_writes_ = true;
    return *this;
}

Pass& Pass::depthTest(ImageRef image, Slice slice) {
    depth_ = {image, Load::keep, {}, slice, {}};
    depth_writes_ = false;
    return *this;
}

// The layout, which depends on the format, is filled in when the pass's uses are listed.
Pass& Pass::samples(ImageRef image, VkPipelineStageFlags2 stages) {
    images_.push_back({image, {stages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}, {}, true});
    return *this;
}

Pass& Pass::samples(ImageRef image, VkPipelineStageFlags2 stages, const Part& part) {
    images_.push_back({image, {stages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}, part});
    return *this;
}

Pass& Pass::uses(ImageRef image, const Access& access, const Part& part, bool discards) {
    images_.push_back({image, access, part, false, discards});
    return *this;
}

Pass& Pass::uses(BufferRef buffer, const Access& access) {
    buffers_.emplace_back(buffer, access);
    return *this;
}

Pass& Pass::prepare(std::function<void()> make) {
    prepare_ = std::move(make);
    return *this;
}

Pass& Pass::record(std::function<void(VkCommandBuffer)> commands) {
    record_ = std::move(commands);
    return *this;
}

PassList::PassList(Device& device, std::uint32_t width, std::uint32_t height)
    : device_(device), width_(width), height_(height) {}
PassList::~PassList() = default;

ImageRef PassList::image(const ImageDeclaration& declared) {
    auto resource = std::make_unique<Resource>();
    const bool own = declared.extent.width == 0;
    resource->life = declared.life;
    resource->image.emplace(device_,
                            GpuImageInfo{declared.name, declared.format, own ? width_ : declared.extent.width,
                                         own ? height_ : declared.extent.height, declared.levels,
                                         usageOf(declared), declared.layers, declared.samples},
                            declared.life == Life::kept ? GpuImage::Memory::own : GpuImage::Memory::none);
    tracker_.add(declared.name, declared.levels, declared.layers);
    resources_.push_back(std::move(resource));
    return {resources_.size() - 1};
}

BufferRef PassList::buffer(const std::string& name, const GpuBuffer& buffer) {
    for (std::size_t i = 0; i < resources_.size(); ++i)
        if (resources_[i]->buffer != nullptr && resources_[i]->buffer->handle() == buffer.handle())
            return {i};
    auto resource = std::make_unique<Resource>();
    resource->buffer = &buffer;
    resources_.push_back(std::move(resource));
    const std::size_t index = tracker_.add(name);
    tracker_.setWritten(index);
    return {index};
}

PassList::Resource& PassList::resource(ImageRef image) const {
    Resource& found = *resources_.at(image.index);
    if (!found.image) throw std::logic_error("PassList: " + tracker_.name(image.index) + " is no image");
    return found;
}

VkImageView PassList::view(ImageRef image) const {
    const Resource& found = resource(image);
    if (!found.image->bound())
        throw std::logic_error(
            fmt::format("PassList: {} is a transient: its view is there from Pass::prepare() on",
                        found.image->info().name));
    return found.image->view();
}

VkFormat PassList::format(ImageRef image) const {
    return resource(image).image->info().format;
}

Pass& PassList::draw(const std::string& name) {
    passes_.push_back(std::make_unique<Pass>());
    prepared_.push_back(false);
    passes_.back()->name_ = name;
    return *passes_.back();
}

Pass& PassList::compute(const std::string& name) {
    Pass& pass = draw(name);
    pass.kind_ = Pass::Kind::compute;
    return pass;
}

Pass& PassList::copy(const std::string& name) {
    Pass& pass = draw(name);
    pass.kind_ = Pass::Kind::copy;
    return pass;
}

// ---- what a pass uses, and memory --------------------------------------------------------------------

std::vector<Use> PassList::usesOf(const Pass& pass) const {
    std::vector<Use> uses;
    for (const Pass::ImageUse& use : pass.images_) {
        const GpuImage& image = *resource(use.image).image;
        Access access = use.access;
        if (access.layout == VK_IMAGE_LAYOUT_UNDEFINED)
            access =
                isDepth(image) ? access::sampledDepth(access.stages) : access::sampledColor(access.stages);
        uses.push_back({use.image.index, use.whole ? wholeOf(image) : use.part, access, use.discards});
    }
    for (const auto& [buffer, access] : pass.buffers_) uses.push_back({buffer.index, {}, access});
    for (const Pass::Attachment& color : pass.colors_) {
        uses.push_back(
            {color.image.index, partOf(color.slice), access::colorAttachment, color.load == Load::clear});
        if (color.resolved.valid()) uses.push_back({color.resolved.index, {}, access::colorAttachment, true});
    }
    if (pass.depth_.image.valid())
        uses.push_back({pass.depth_.image.index, partOf(pass.depth_.slice),
                        pass.depth_writes_ ? access::depthAttachment : access::depthTest,
                        pass.depth_writes_ && pass.depth_.load == Load::clear});
    return uses;
}

// Transients that have no memory yet: in the order of their sizes each goes into the first block where no
// other lives while it does (first fit, decreasing), or into a new one.
void PassList::allocate() {
    struct Block {
        VkMemoryRequirements needs;
        std::vector<std::size_t> images;  // by the time of their lives, which do not overlap
    };
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < resources_.size(); ++i)
        if (resources_[i]->image && !resources_[i]->image->bound()) waiting.push_back(i);
    if (waiting.empty()) return;
    for (const std::size_t i : waiting) resources_[i]->first = passes_.size();
    for (std::size_t p = 0; p < passes_.size(); ++p)
        for (const Use& use : usesOf(*passes_[p])) {
            Resource& used = *resources_[use.resource];
            used.first = std::min(used.first, p);
            used.last = std::max(used.last, p);
        }
    std::map<std::size_t, VkMemoryRequirements> needs;
    for (const std::size_t i : waiting) needs[i] = resources_[i]->image->requirements();
    std::ranges::stable_sort(waiting,
                             [&](std::size_t a, std::size_t b) { return needs[a].size > needs[b].size; });
    std::vector<Block> blocks;
    std::uint64_t alone = 0, together = 0;
    for (const std::size_t i : waiting) {
        const auto apart = [&](std::size_t other) {
            return resources_[other]->last < resources_[i]->first ||
                   resources_[i]->last < resources_[other]->first;
        };
        const auto block = std::ranges::find_if(blocks, [&](const Block& b) {
            return (b.needs.memoryTypeBits & needs[i].memoryTypeBits) != 0 &&
                   std::ranges::all_of(b.images, apart);
        });
        alone += bytesOf(resources_[i]->image->info());
        if (block == blocks.end()) {
            blocks.push_back({needs[i], {i}});
            together += bytesOf(resources_[i]->image->info());
            continue;
        }
        block->needs.memoryTypeBits &= needs[i].memoryTypeBits;
        block->needs.alignment = std::max(block->needs.alignment, needs[i].alignment);
        block->images.push_back(i);
    }
    for (Block& block : blocks) {
        blocks_.push_back(device_.memory().allocate(block.needs, MemoryUse::device, true));
        std::ranges::sort(block.images, {}, [&](std::size_t i) { return resources_[i]->first; });
        for (std::size_t k = 0; k < block.images.size(); ++k) {
            Resource& here = *resources_[block.images[k]];
            here.image->bind(blocks_.back().memory(), blocks_.back().offset());
            // The first of a run comes after the last of the run before.
            if (block.images.size() > 1)
                here.before = block.images[(k + block.images.size() - 1) % block.images.size()];
        }
    }
    shared_bytes_ += alone - together;
}

void PassList::prepare(std::size_t first, std::size_t last) {
    allocate();
    for (std::size_t i = first; i < last; ++i) {
        for (const Use& use : usesOf(*passes_[i])) {
            const Resource& used = *resources_[use.resource];
            if (used.life == Life::transient && (i < used.first || i > used.last))
                throw std::logic_error(fmt::format("pass {}: the transient {} has given its memory to others",
                                                   passes_[i]->name_, tracker_.name(use.resource)));
        }
        if (!prepared_[i] && passes_[i]->prepare_) passes_[i]->prepare_();
        prepared_[i] = true;
    }
    recorded_.clear();
}

// ---- running -----------------------------------------------------------------------------------------

VkImageView PassList::attachmentView(ImageRef image, const Slice& slice) {
    Resource& found = resource(image);
    const GpuImageInfo& info = found.image->info();
    if (info.levels == 1 && info.layers == 1) return view(image);
    OwnedImageView& made = found.views[{slice.level, 1, slice.layer, 1}];
    if (made == VK_NULL_HANDLE) made = found.image->makeView(slice.level, 1, slice.layer, 1);
    return made;
}

void PassList::barriersBefore(const Pass& pass, const std::vector<Use>& uses, VkCommandBuffer commands) {
    std::vector<VkImageMemoryBarrier2> images;
    std::vector<VkBufferMemoryBarrier2> buffers;
    for (const Barrier& barrier : tracker_.before(pass.name_, uses)) {
        recorded_.push_back(
            {pass.name_, tracker_.name(barrier.resource), barrier.part, barrier.from, barrier.to});
        const Resource& found = *resources_[barrier.resource];
        if (found.image)
            images.push_back(
                {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                 .pNext = nullptr,
                 .srcStageMask = barrier.from.stages,
                 .srcAccessMask = barrier.from.access,
                 .dstStageMask = barrier.to.stages,
                 .dstAccessMask = barrier.to.access,
                 .oldLayout = barrier.from.layout,
                 .newLayout = barrier.to.layout,
                 .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                 .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                 .image = found.image->handle(),
                 .subresourceRange = {found.image->aspect(), barrier.part.level, barrier.part.levels,
                                      barrier.part.layer, barrier.part.layers}});
        else
            buffers.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                               .pNext = nullptr,
                               .srcStageMask = barrier.from.stages,
                               .srcAccessMask = barrier.from.access,
                               .dstStageMask = barrier.to.stages,
                               .dstAccessMask = barrier.to.access,
                               .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                               .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                               .buffer = found.buffer->handle(),
                               .offset = 0,
                               .size = VK_WHOLE_SIZE});
    }
    if (images.empty() && buffers.empty()) return;
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .pNext = nullptr,
                                .dependencyFlags = 0,
                                .memoryBarrierCount = 0,
                                .pMemoryBarriers = nullptr,
                                .bufferMemoryBarrierCount = static_cast<std::uint32_t>(buffers.size()),
                                .pBufferMemoryBarriers = buffers.data(),
                                .imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size()),
                                .pImageMemoryBarriers = images.data()};
    vkCmdPipelineBarrier2(commands, &info);
}

// Transients that are used by this pass first wait for whoever had their memory before.
void PassList::beginLives(BarrierTracker& tracker, std::size_t pass) const {
    for (std::size_t i = 0; i < resources_.size(); ++i)
        if (resources_[i]->before && resources_[i]->first == pass) tracker.alias(i, *resources_[i]->before);
}

void PassList::runPass(std::size_t index, VkCommandBuffer commands) {
    const Pass& pass = *passes_[index];
    last_run_ = index;
    beginLives(tracker_, index);
    barriersBefore(pass, usesOf(pass), commands);
    device_.beginLabel(commands, pass.name_);
    if (pass.kind_ == Pass::Kind::draw)
        renderPass(pass, commands);
    else if (pass.record_)
        pass.record_(commands);
    device_.endLabel(commands);
}

void PassList::renderPass(const Pass& pass, VkCommandBuffer commands) {
    VkExtent2D extent{width_, height_};
    const auto attach = [&](const Pass::Attachment& a, VkImageLayout layout, bool store) {
        const GpuImageInfo& image = resource(a.image).image->info();
        extent = {std::max(1u, image.width >> a.slice.level), std::max(1u, image.height >> a.slice.level)};
        VkRenderingAttachmentInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        info.imageView = attachmentView(a.image, a.slice);
        info.imageLayout = layout;
        info.loadOp = a.load == Load::clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
        info.storeOp = store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_NONE;
        info.clearValue = a.clear;
        if (a.resolved.valid()) {
            info.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
            info.resolveImageView = view(a.resolved);
            info.resolveImageLayout = layout;
        }
        return info;
    };
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const auto& color : pass.colors_)
        colors.push_back(attach(color, access::colorAttachment.layout, true));
    VkRenderingAttachmentInfo depth{};
    if (pass.depth_.image.valid())
        depth = attach(pass.depth_,
                       pass.depth_writes_ ? access::depthAttachment.layout : access::depthTest.layout,
                       pass.depth_writes_);
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
    // Depth is reversed and 0 says that nothing was drawn: what lies exactly on the far plane gets the least
    // depth above it. Everything else is unchanged, being far larger.
    constexpr float leastDepth = 1e-37f;
    const VkViewport viewport{
        0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), leastDepth, 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &info.renderArea);
    if (pass.record_) pass.record_(commands);
    vkCmdEndRendering(commands);
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

// Milliseconds of each span, from time stamps around it; the device must have true ones.
std::vector<double> PassList::runWithTimestamps(const std::vector<Span>& spans) {
    const auto count = static_cast<std::uint32_t>(spans.size() + 1);
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
        for (std::uint32_t s = 0; s + 1 < count; ++s) {
            for (std::size_t i = spans[s].first; i < spans[s].last; ++i) runPass(i, commands);
            vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, s + 1);
        }
    });
    std::vector<std::uint64_t> ticks(count);
    checkResult(
        vkGetQueryPoolResults(device_.handle(), pool, 0, count, count * sizeof(std::uint64_t), ticks.data(),
                              sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
    std::vector<double> ms;
    for (std::size_t i = 0; i + 1 < count; ++i)
        ms.push_back(static_cast<double>(device_.ticksBetween(ticks[i], ticks[i + 1])) *
                     static_cast<double>(device_.limits().timestampPeriod) * 1e-6);
    return ms;
}

double PassList::run(std::size_t first, std::size_t last) {
    prepare(first, last);
    if (device_.profile().time_stamps) {
        double total = 0;
        for (const double ms : runWithTimestamps(spans(first, last))) total += ms;
        return total;
    }
    return device_.submit([&](VkCommandBuffer commands) {
        for (std::size_t i = first; i < last; ++i) runPass(i, commands);
    });
}

std::vector<PassMs> PassList::profile(std::size_t first, std::size_t last) {
    prepare(first, last);
    const std::vector<Span> all = spans(first, last);
    std::vector<PassMs> times;
    if (device_.profile().time_stamps) {
        const std::vector<double> ms = runWithTimestamps(all);
        for (std::size_t s = 0; s < all.size(); ++s) times.push_back({passes_[all[s].first]->name_, ms[s]});
    } else {
        for (const Span& span : all)
            times.push_back({passes_[span.first]->name_, device_.submit([&](VkCommandBuffer commands) {
                                 for (std::size_t i = span.first; i < span.last; ++i) runPass(i, commands);
                             })});
    }
    return times;
}

// ---- reading back ------------------------------------------------------------------------------------

std::vector<std::vector<float>> PassList::readBack(std::span<const ReadBack> requests) {
    std::vector<std::vector<float>> results;
    std::vector<std::span<float>> into;
    for (const ReadBack& request : requests)
        results.emplace_back(std::size_t{width_} * height_ * static_cast<std::size_t>(request.components));
    for (std::vector<float>& result : results) into.emplace_back(result);
    readBack(requests, into);
    return results;
}

void PassList::readBack(std::span<const ReadBack> requests, std::span<const std::span<float>> into) {
    constexpr std::size_t stagingBytes = std::size_t{64} << 20;
    const std::size_t largest = std::size_t{width_} * height_ * 16;
    const std::size_t atOnce = std::max<std::size_t>(1, stagingBytes / largest);
    for (std::size_t i = 0; i < requests.size(); i += atOnce) {
        const std::size_t count = std::min(atOnce, requests.size() - i);
        copyToHost(requests.subspan(i, count), into.subspan(i, count));
    }
}

void PassList::copyToHost(std::span<const ReadBack> requests, std::span<const std::span<float>> into) {
    const std::size_t texels = std::size_t{width_} * height_;
    const auto floatsPerTexel = [&](ImageRef image) { return bytesPerTexel(format(image)) / 4; };
    std::vector<GpuBuffer> buffers;
    for (const ReadBack& request : requests)
        buffers.emplace_back(device_, "read back", texels * floatsPerTexel(request.image) * 4,
                             VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback);
    Pass pass;
    pass.name_ = "read back";
    std::vector<Use> uses;
    for (const ReadBack& request : requests) {
        const Resource& found = resource(request.image);
        if (found.life == Life::transient && found.last != last_run_)
            throw std::logic_error("PassList: " + found.image->info().name +
                                   " is a transient and cannot be read back");
        uses.push_back({request.image.index, wholeOf(*found.image), access::copiedFromImage});
    }
    device_.submit([&](VkCommandBuffer commands) {
        barriersBefore(pass, uses, commands);
        for (std::size_t i = 0; i < requests.size(); ++i) {
            const GpuImage& image = *resource(requests[i].image).image;
            const VkBufferImageCopy copy{.bufferOffset = 0,
                                         .bufferRowLength = 0,
                                         .bufferImageHeight = 0,
                                         .imageSubresource = {image.aspect(), 0, 0, 1},
                                         .imageOffset = {},
                                         .imageExtent = {width_, height_, 1}};
            vkCmdCopyImageToBuffer(commands, image.handle(), access::copiedFromImage.layout,
                                   buffers[i].handle(), 1, &copy);
        }
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    for (std::size_t image = 0; image < requests.size(); ++image) {
        const auto kept = static_cast<std::size_t>(requests[image].components);
        const std::size_t stored = floatsPerTexel(requests[image].image);
        if (kept > stored)
            throw std::logic_error("PassList: an image has fewer components than are read back");
        const auto* from = static_cast<const float*>(buffers[image].mapped());
        float* const to = into[image].data();
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels, 65536), [&](const auto& range) {
            if (kept == stored)
                std::copy_n(from + range.begin() * stored, range.size() * stored,
                            to + range.begin() * stored);
            else
                for (std::size_t i = range.begin(); i < range.end(); ++i)
                    std::copy_n(from + i * stored, kept, to + i * kept);
        });
    }
}

std::vector<DeclaredUse> PassList::declarations() const {
    std::vector<DeclaredUse> all;
    for (const auto& pass : passes_)
        for (const Use& use : usesOf(*pass))
            all.push_back({pass->name_, tracker_.name(use.resource), use.access});
    return all;
}

std::vector<RecordedBarrier> PassList::plannedBarriers(int runs, const std::set<std::size_t>& without) const {
    BarrierTracker tracker;
    for (std::size_t i = 0; i < resources_.size(); ++i) {
        const auto& image = resources_[i]->image;
        tracker.add(tracker_.name(i), image ? image->info().levels : 1, image ? image->info().layers : 1);
        if (!image) tracker.setWritten(i);
    }
    std::vector<RecordedBarrier> planned;
    for (int run = 0; run < runs; ++run) {
        std::size_t declaration = 0;
        for (std::size_t p = 0; p < passes_.size(); ++p) {
            beginLives(tracker, p);
            std::vector<Use> uses;
            for (const Use& use : usesOf(*passes_[p]))
                if (!without.contains(declaration++)) uses.push_back(use);
            for (const Barrier& barrier : tracker.before(passes_[p]->name_, uses))
                planned.push_back({passes_[p]->name_, tracker.name(barrier.resource), barrier.part,
                                   barrier.from, barrier.to});
        }
    }
    return planned;
}

std::vector<std::string> PassList::names() const {
    std::vector<std::string> names;
    for (const Span& span : spans(0, size())) names.push_back(passes_[span.first]->name_);
    return names;
}

std::uint64_t PassList::imageBytes() const {
    std::uint64_t bytes = 0;
    for (const auto& resource : resources_)
        if (resource->image) bytes += bytesOf(resource->image->info());
    return bytes;
}

}  // namespace diptych
