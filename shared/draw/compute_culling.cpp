// SPDX-License-Identifier: MIT
#include "shared/draw/compute_culling.h"

#include "shared/draw/deformations.h"
#include "shared/draw/meshlets.h"

#include <algorithm>
#include <cstring>

namespace diptych {

static_assert(maxMeshletTriangles == gpu::MAX_MESHLET_TRIANGLES);
static_assert(sizeof(gpu::IndirectDraw) == sizeof(VkDrawIndexedIndirectCommand));

namespace {

// Error of each of two devices, plus one for the other rounding in the compute shader.
constexpr double placesApart = 3;

}  // namespace

ComputeCulling::ComputeCulling(Device& device, Pipelines& pipelines, VkPipelineLayout layout,
                               const Geometry& geometry, const SampleGrid& grid, const Sizes& sizes)
    : device_(device), pipelines_(pipelines), layout_(layout), sizes_(sizes) {
    constexpr VkBufferUsageFlags addressed = VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                 read = VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    const auto bytesOf = [](std::uint64_t count, std::size_t each) { return count * each; };
    items_ = GpuBuffer(device, "culled items", bytesOf(sizes.items, sizeof(gpu::CulledItem)), addressed,
                       MemoryUse::upload);
    parts_ = GpuBuffer(device, "culled parts", bytesOf(sizes.parts, sizeof(gpu::CulledPart)), addressed,
                       MemoryUse::upload);
    order_ = GpuBuffer(device, "order of clusters", bytesOf(sizes.meshlets, sizeof(gpu::uint)), addressed,
                       MemoryUse::upload);
    indices_ = GpuBuffer(device, "chosen indices", bytesOf(sizes.indices, sizeof(gpu::uint)),
                         addressed | read | VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    draws_ = GpuBuffer(device, "indirect draws", bytesOf(sizes.draws, sizeof(gpu::IndirectDraw)),
                       addressed | read | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    constants_ = {addressWords(geometry.positions().address()),
                  addressWords(geometry.indices().address()),
                  addressWords(geometry.meshletBuffer().address()),
                  addressWords(items_.address()),
                  addressWords(parts_.address()),
                  addressWords(order_.address()),
                  addressWords(indices_.address()),
                  addressWords(draws_.address()),
                  sizes.parts,
                  static_cast<gpu::uint>(grid.samples),
                  glm::vec2(grid.width, grid.height) * 0.5f,
                  static_cast<float>(placesApart * positionError(grid)),
                  static_cast<float>(grid.snap)};
}

std::span<gpu::CulledItem> ComputeCulling::items() {
    return {static_cast<gpu::CulledItem*>(items_.mapped()), sizes_.items};
}

std::span<gpu::CulledPart> ComputeCulling::parts() {
    return {static_cast<gpu::CulledPart*>(parts_.mapped()), sizes_.parts};
}

std::span<std::uint32_t> ComputeCulling::order() {
    return {static_cast<std::uint32_t*>(order_.mapped()), sizes_.meshlets};
}

void ComputeCulling::addPass(PassList& passes, const char* name) const {
    Pass& pass = passes.compute(name);
    const Pipeline pipeline = pipelines_.compute(Shader::cull_meshlets_comp, {}, layout_);
    pass.uses(passes.buffer("chosen indices", indices_), access::storageWrite(inCompute))
        .uses(passes.buffer("indirect draws", draws_), access::storageWrite(inCompute))
        .record([this, pipeline](VkCommandBuffer commands) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants_,
                               &constants_);
            vkCmdDispatch(commands, std::min(sizes_.parts, gpu::CULLING_GROUPS),
                          (sizes_.parts + gpu::CULLING_GROUPS - 1) / gpu::CULLING_GROUPS, 1);
        });
}

void ComputeCulling::read(PassList& passes, Pass& pass) const {
    pass.uses(passes.buffer("chosen indices", indices_), access::indexRead)
        .uses(passes.buffer("indirect draws", draws_), access::indirectRead);
}

void ComputeCulling::runOnce(const char* name) const {
    PassList once(device_, 1, 1);
    addPass(once, name);
    once.run();
    device_.submit([&](VkCommandBuffer commands) {
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                      access::indexRead.stages | access::indirectRead.stages,
                      access::indexRead.access | access::indirectRead.access);
    });
}

template <class T>
std::vector<T> ComputeCulling::readBack(const GpuBuffer& from) const {
    const GpuBuffer seen(device_, "chosen, read back", from.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         MemoryUse::readback);
    device_.submit([&](VkCommandBuffer commands) {
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        const VkBufferCopy all{0, 0, from.size()};
        vkCmdCopyBuffer(commands, from.handle(), seen.handle(), 1, &all);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    std::vector<T> values(from.size() / sizeof(T));
    std::memcpy(values.data(), seen.mapped(), values.size() * sizeof(T));
    return values;
}

std::vector<gpu::IndirectDraw> ComputeCulling::readDraws() const {
    return readBack<gpu::IndirectDraw>(draws_);
}

std::vector<std::uint32_t> ComputeCulling::readIndices() const {
    return readBack<std::uint32_t>(indices_);
}

std::uint64_t ComputeCulling::bytes() const {
    return items_.size() + parts_.size() + order_.size() + indices_.size() + draws_.size();
}

}  // namespace diptych
