// SPDX-License-Identifier: MIT
#include "shared/vulkan/passes/pass_list.h"

#include "shared/vulkan/device/pipeline_compiler.h"
#include "shared/vulkan/passes/pass_resource.h"
#include "shared/vulkan/passes/transients.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {

namespace {

bool isDepth(const GpuImage& image) {
    return image.aspect() == VK_IMAGE_ASPECT_DEPTH_BIT;
}

VkImageUsageFlags usageOf(const ImageDeclaration& declared) {
    VkImageUsageFlags usage = declared.usage | VK_IMAGE_USAGE_SAMPLED_BIT;
    if (declared.drawn)
        usage |= aspectOf(declared.format) == VK_IMAGE_ASPECT_DEPTH_BIT
                     ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                     : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (declared.life == Life::kept) usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    return usage;
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

PassList::PassList(Device& device, std::uint32_t width, std::uint32_t height)
    : device_(device), width_(width), height_(height) {}
PassList::~PassList() = default;

ImageRef PassList::image(const ImageDeclaration& declared) {
    auto resource = std::make_unique<Resource>();
    const bool own = declared.extent.width == 0;
    resource->life = declared.life;
    resource->has_size = !own;
    resource->with_image = declared.with_image;
    resource->depths = declared.depths;
    resource->image.emplace(
        device_,
        GpuImageInfo{declared.name, declared.format, own ? width_ : declared.extent.width,
                     own ? height_ : declared.extent.height, declared.levels, usageOf(declared),
                     declared.layers, declared.samples, declared.array, declared.filtered},
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
            fmt::format("PassList: {} is transient; its view exists only from Pass::prepare() on",
                        found.image->info().name));
    return found.image->view();
}

VkImageView PassList::view(ImageRef image, const Part& part) {
    Resource& found = resource(image);
    if (part == wholeOf(*found.image)) return view(image);
    OwnedImageView& made = found.views[{part.level, part.levels, part.layer, part.layers}];
    if (made == VK_NULL_HANDLE)
        made = found.image->makeView(part.level, part.levels, part.layer, part.layers);
    return made;
}

VkImage PassList::handle(ImageRef image) const {
    return resource(image).image->handle();
}

VkFormat PassList::format(ImageRef image) const {
    return resource(image).image->info().format;
}

Pass& PassList::draw(const std::string& name) {
    passes_.push_back(std::make_unique<Pass>());
    prepared_.push_back(false);
    passes_.back()->name_ = name;
    if (PipelineCompiler* const compiler = device_.compiler()) compiler->beginPass(name);
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
    if (pass.depth_.resolved.valid())
        uses.push_back({pass.depth_.resolved.index, {}, access::resolvedDepth, true});
    return uses;
}

// Allocates transients that have no memory yet.
void PassList::allocate() {
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < resources_.size(); ++i)
        if (resources_[i]->image && !resources_[i]->image->bound()) waiting.push_back(i);
    if (waiting.empty()) return;
    for (const std::size_t i : waiting) resources_[i]->first = passes_.size();
    for (std::size_t p = 0; p < passes_.size(); ++p)
        for (const Use& use : usesOf(*passes_[p])) {
            Resource& used = *resources_[use.resource];
            if (!used.image || used.image->bound())
                continue;  // later passes do not extend an allocated
                           // transient's lifetime
            used.first = std::min(used.first, p);
            used.last = std::max(used.last, p);
        }
    std::vector<Transient> transients;
    std::uint64_t alone = 0, together = 0;
    for (const std::size_t i : waiting) {
        const Resource& r = *resources_[i];
        transients.push_back({r.image->requirements(), r.first, r.last});
        alone += bytesOf(r.image->info());
    }
    for (const SharedBlock& block : shareMemory(transients)) {
        blocks_.push_back(device_.memory().allocate(
            block.needs, MemoryUse::device, true,
            "the image " + resources_[waiting[block.members.front()]]->image->info().name));
        std::uint64_t largest = 0;
        for (std::size_t k = 0; k < block.members.size(); ++k) {
            const auto at = [&](std::size_t member) { return waiting[block.members[member]]; };
            Resource& here = *resources_[at(k)];
            here.image->bind(blocks_.back().memory(), blocks_.back().offset());
            largest = std::max(largest, bytesOf(here.image->info()));
            // The first transient of a run follows the last of the previous run.
            const std::size_t count = block.members.size();
            if (count > 1) here.before = at((k + count - 1) % count);
        }
        together += largest;
    }
    shared_bytes_ += alone - together;
}

void PassList::prepare(std::size_t first, std::size_t last) {
    allocate();
    for (std::size_t i = first; i < last; ++i) {
        for (const Use& use : usesOf(*passes_[i])) {
            const Resource& used = *resources_[use.resource];
            if (used.life == Life::transient && (i < used.first || i > used.last))
                throw std::logic_error(
                    fmt::format("pass {}: the memory of the transient {} is already reused",
                                passes_[i]->name_, tracker_.name(use.resource)));
        }
        if (!prepared_[i] && passes_[i]->prepare_) passes_[i]->prepare_();
        prepared_[i] = true;
    }
    recorded_.clear();
}

std::vector<DeclaredUse> PassList::declarations() const {
    std::vector<DeclaredUse> all;
    for (std::size_t i = 0; i < passes_.size(); ++i)
        for (const Use& use : usesOf(*passes_[i]))
            all.push_back({passes_[i]->name_, tracker_.name(use.resource), use.access, use.part, i});
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
                                   barrier.from, barrier.to, p});
        }
    }
    return planned;
}

std::vector<std::string> PassList::names() const {
    std::vector<std::string> names;
    for (const Span& span : spans(0, size())) names.push_back(passes_[span.first]->name_);
    return names;
}

std::uint64_t PassList::pixelBytes(ImageRef image) const {
    return bytesOf(resource(image).image->info()) / (std::uint64_t{width_} * height_);
}

std::uint64_t PassList::pixelBytes() const {
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < resources_.size(); ++i) {
        const Resource& r = *resources_[i];
        if (r.image && (!r.has_size || r.with_image)) bytes += pixelBytes(ImageRef{i});
    }
    return bytes;
}

std::uint64_t PassList::imageBytes() const {
    std::uint64_t bytes = 0;
    for (const auto& resource : resources_)
        if (resource->image) bytes += bytesOf(resource->image->info());
    return bytes;
}

}  // namespace diptych
