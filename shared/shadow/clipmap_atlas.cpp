// SPDX-License-Identifier: MIT
#include "shared/shadow/clipmap_atlas.h"

#include "shared/draw/record.h"
#include "shared/shadow/scene_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace diptych {

namespace {

constexpr auto clipmapTypes = bindingTypes({CLIPMAP_BINDINGS(DIPTYCH_BINDING_ROW)});

constexpr Access readByShaders = access::sampledDepth(inFragment);
constexpr ImageState readable{readByShaders.layout, readByShaders.stages, readByShaders.access},
    copied{access::copiedToImage.layout, access::copiedToImage.stages, access::copiedToImage.access};

// Number of pages drawn in one submit; their casters are in memory at the same time.
constexpr std::size_t pagesAtOnce = 32;

void change(VkCommandBuffer commands, const GpuImage& image, const ImageState& from, const ImageState& to) {
    const VkImageMemoryBarrier2 one = barrier(image.handle(), image.aspect(), from, to);
    submitBarriers(commands, std::span(&one, 1));
}

VkOffset3D offsetOf(const glm::uvec2& corner) {
    return {static_cast<std::int32_t>(corner.x), static_cast<std::int32_t>(corner.y), 0};
}

}  // namespace

std::span<const VkDescriptorType> clipmapBindings() {
    return clipmapTypes;
}

// ---- the image ---------------------------------------------------------------------------------------

std::uint32_t AtlasShape::perRow() const {
    return static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(pages))));
}
glm::uvec2 AtlasShape::size() const {
    return glm::uvec2(perRow(), (pages + perRow() - 1) / perRow()) * slot;
}
glm::uvec2 AtlasShape::cornerOf(std::uint32_t at) const {
    return glm::uvec2(at % perRow(), at / perRow()) * slot;
}

ClipmapAtlas::ClipmapAtlas(Device& device, const AtlasShape& shape)
    : device_(device), shape_(shape), cache_(shape.pages) {
    const std::uint32_t max = device.limits().maxImageDimension2D;
    if (shape.size().x > max)
        throw std::runtime_error(
            fmt::format("--clipmap-pages {}: only {} pages of {}x{} texels (with filter borders) fit in the "
                        "largest image of {}, {}x{}",
                        shape.pages, (max / shape.slot) * (max / shape.slot), shape.slot, shape.slot,
                        device.info().name, max, max));
    image_ = GpuImage(device, {.name = "clipmap atlas",
                               .format = depthFormat,
                               .width = shape.size().x,
                               .height = shape.size().y,
                               .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                        VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                               .array = true});
    device_.submit([&](VkCommandBuffer commands) { change(commands, image_, {}, readable); });
}

std::uint64_t ClipmapAtlas::bytes() const {
    return std::uint64_t{shape_.size().x} * shape_.size().y * bytesPerTexel(depthFormat);
}

void ClipmapAtlas::fill(float value) {
    const GpuBuffer texels(device_, "clipmap fill", VkDeviceSize{shape_.slot} * shape_.slot * sizeof value,
                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    std::vector<VkBufferImageCopy> copies;
    for (std::uint32_t y = 0; y < shape_.size().y; y += shape_.slot)
        for (std::uint32_t x = 0; x < shape_.size().x; x += shape_.slot)
            copies.push_back({.bufferOffset = 0,
                              .bufferRowLength = 0,
                              .bufferImageHeight = 0,
                              .imageSubresource = {image_.aspect(), 0, 0, 1},
                              .imageOffset = offsetOf({x, y}),
                              .imageExtent = {shape_.slot, shape_.slot, 1}});
    device_.submit([&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, texels.handle(), 0, VK_WHOLE_SIZE, std::bit_cast<std::uint32_t>(value));
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        change(commands, image_, readable, copied);
        vkCmdCopyBufferToImage(commands, texels.handle(), image_.handle(), copied.layout,
                               static_cast<std::uint32_t>(copies.size()), copies.data());
        change(commands, image_, copied, readable);
    });
}

std::vector<float> ClipmapAtlas::read(std::uint32_t at) const {
    std::vector<float> texels(std::size_t{shape_.slot} * shape_.slot);
    const GpuBuffer seen(device_, "clipmap slot, read back", texels.size() * sizeof(float),
                         VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback);
    constexpr ImageState from{access::copiedFromImage.layout, access::copiedFromImage.stages,
                              access::copiedFromImage.access};
    const VkBufferImageCopy copy{.bufferOffset = 0,
                                 .bufferRowLength = 0,
                                 .bufferImageHeight = 0,
                                 .imageSubresource = {image_.aspect(), 0, 0, 1},
                                 .imageOffset = offsetOf(shape_.cornerOf(at)),
                                 .imageExtent = {shape_.slot, shape_.slot, 1}};
    device_.submit([&](VkCommandBuffer commands) {
        change(commands, image_, readable, from);
        vkCmdCopyImageToBuffer(commands, image_.handle(), from.layout, seen.handle(), 1, &copy);
        change(commands, image_, from, readable);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    std::memcpy(texels.data(), seen.mapped(), texels.size() * sizeof(float));
    return texels;
}

// ---- pages -------------------------------------------------------------------------------------------

void ClipmapAtlas::follow(const Pose& pose, const Geometry& geometry, const LightSpace& space) {
    std::vector<Caster> now;
    for (const Instance& instance : pose.instances) {
        const PlacedPrimitive placed = geometry.placed(pose, instance);
        const Material& material =
            materialsOf(geometry.scene(), pose)[static_cast<std::size_t>(placed.range.material)];
        Caster& caster = now.emplace_back();
        caster = {instance.mesh,
                  instance.primitive,
                  placed.world_from_object,
                  placed.range.bounds_min,
                  placed.range.bounds_max,
                  {},
                  {},
                  blends(material),
                  material.alpha_mode};
        if (material.alpha_mode == AlphaMode::mask) {
            caster.alpha = material.base_color.a;
            caster.alpha_cutoff = material.alpha_cutoff;
            caster.base_color = material.base_color_texture;
        }
        if (instance.skin >= 0) caster.world_from_mesh = pose.skins[static_cast<std::size_t>(instance.skin)];
        if (instance.weights >= 0) caster.weights = pose.weights[static_cast<std::size_t>(instance.weights)];
    }
    const auto forget = [&](const Caster& caster) {
        if (geometry.range(caster.mesh, caster.primitive).index_count == 0) return;
        Bounds bounds;
        bounds.min = caster.bounds_min;
        bounds.max = caster.bounds_max;
        glm::dvec2 lower(std::numeric_limits<double>::infinity()), upper(-lower);
        for (glm::dvec3 corner : cornersOf(bounds)) {
            corner = caster.world_from_object * glm::dvec4(corner, 1);
            lower = glm::min(lower, glm::dvec2(space.from(corner)));
            upper = glm::max(upper, glm::dvec2(space.from(corner)));
        }
        cache_.moved(lower, upper);
    };
    for (std::size_t i = 0; i < std::max(now.size(), casters_.size()); ++i) {
        if (i < now.size() && i < casters_.size() && now[i] == casters_[i]) continue;
        if (i < now.size()) forget(now[i]);
        if (i < casters_.size()) forget(casters_[i]);
    }
    casters_ = std::move(now);
}

std::size_t ClipmapAtlas::draw(const FrameInputs& inputs, Uploader& uploader, const Pose& pose,
                               const PageGrid& grid, std::span<const PageDraw> pages, bool all) {
    const std::vector<PageDraw> stale = cache_.stale(pages);
    const Cascades space{.space = grid.space, .near = grid.near, .far = grid.far, .areas = {}};
    for (std::size_t first = 0; first < stale.size(); first += pagesAtOnce) {
        const std::span now(stale.data() + first, std::min(pagesAtOnce, stale.size() - first));
        // Relative to the world's origin, not the camera, so that the texels depend on the page alone.
        std::vector<DrawList> lists;
        std::vector<gpu::Draw> draws;
        for (const PageDraw& page : now) {
            DrawList list = makeCasterList(
                pose, inputs.geometry, inputs.materials,
                {.clip_from_world = space.clipFromWorld(grid.areaOf(page.page), grid.slot(), glm::dvec3(0)),
                 .all = all});
            for (DrawItem& item : list.items) item.draw += static_cast<std::uint32_t>(draws.size());
            draws.insert(draws.end(), list.draws.begin(), list.draws.end());
            lists.push_back(std::move(list));
        }
        const GpuBuffer buffer =
            makeBuffer<gpu::Draw>(device_, uploader, "casters", draws, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        uploader.flush();
        PassList passes(device_, shape_.slot, shape_.slot);
        const ImageRef drawn = passes.image("shadow page", depthFormat);
        for (std::size_t i = 0; i < now.size(); ++i) {
            inputs.posing.read(passes, passes.draw("shadow page"))
                .depth(drawn, Load::clear)
                .record(recordCasters(inputs, lists[i], buffer.handle()));
            passes.copy("shadow page to atlas")
                .uses(drawn, access::copiedFromImage, {})
                .record([&, i](VkCommandBuffer commands) {
                    const VkImageCopy copy{.srcSubresource = {image_.aspect(), 0, 0, 1},
                                           .srcOffset = {},
                                           .dstSubresource = {image_.aspect(), 0, 0, 1},
                                           .dstOffset = offsetOf(shape_.cornerOf(now[i].slot)),
                                           .extent = {shape_.slot, shape_.slot, 1}};
                    if (i == 0) change(commands, image_, readable, copied);
                    vkCmdCopyImage(commands, passes.handle(drawn), access::copiedFromImage.layout,
                                   image_.handle(), copied.layout, 1, &copy);
                    if (i + 1 == now.size()) change(commands, image_, copied, readable);
                });
        }
        passes.run();
        for (const PageDraw& page : now) cache_.drawn(page);
    }
    return stale.size();
}

// ---- all atlases -------------------------------------------------------------------------------------

ClipmapAtlases::ClipmapAtlases(Device& device, VkDescriptorSetLayout frame)
    : device_(device), marks_(makeSetLayout(device, clipmapTypes)) {
    const std::array<VkDescriptorSetLayout, 2> sets{frame, marks_};
    pipeline_ = makePipelineLayout(device, sets);
}

std::shared_ptr<ClipmapAtlas> ClipmapAtlases::lend(const AtlasShape& shape) {
    std::erase_if(atlases_,
                  [&](const auto& atlas) { return atlas.use_count() == 1 && atlas->shape() != shape; });
    for (const auto& atlas : atlases_)
        if (atlas.use_count() == 1) return atlas;
    return atlases_.emplace_back(std::make_shared<ClipmapAtlas>(device_, shape));
}

}  // namespace diptych
