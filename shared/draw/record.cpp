// SPDX-License-Identifier: MIT
#include "shared/draw/record.h"

#include "shared/contract/bindings.h"
#include "shared/contract/geometry.h"
#include "shared/contract/lighting_tiles.h"
#include "shared/contract/material.h"
#include "shared/draw/culling.h"
#include "shared/draw/pipeline_keys.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace diptych {

namespace {

void bind(VkCommandBuffer commands, const FrameInputs& inputs, gpu::uint set, VkDescriptorSet descriptors,
          VkPipelineBindPoint point = VK_PIPELINE_BIND_POINT_GRAPHICS) {
    vkCmdBindDescriptorSets(commands, point, inputs.layouts.pipeline, set, 1, &descriptors, 0, nullptr);
}

// Binds all sets but SET_MATERIAL.
void bindFrame(VkCommandBuffer commands, const FrameInputs& inputs, const LightBatch& batch,
               const DescriptorSets* gbuffer, VkPipelineBindPoint point = VK_PIPELINE_BIND_POINT_GRAPHICS) {
    const Placeholders& none = inputs.placeholders;
    bind(commands, inputs, gpu::SET_FRAME, inputs.frame_set, point);
    bind(commands, inputs, gpu::SET_GBUFFER, gbuffer != nullptr ? (*gbuffer)[0] : none.gbuffer(), point);
    bind(commands, inputs, gpu::SET_PARTIAL_SUMS, batch.sums ? (*batch.sums)[0] : none.partialSums(), point);
}

void push(VkCommandBuffer commands, const FrameInputs& inputs, const gpu::DrawConstants& constants) {
    vkCmdPushConstants(commands, inputs.layouts.pipeline, drawStages, 0, sizeof constants, &constants);
}

// For draws of vertices that the shader generates.
void bindUnculled(VkCommandBuffer commands, const Pipeline& pipeline) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

void recordUnculled(VkCommandBuffer commands, const Pipeline& pipeline, gpu::uint vertices) {
    bindUnculled(commands, pipeline);
    vkCmdDraw(commands, vertices, 1, 0, 0);
}

gpu::DrawConstants constantsOf(const LightBatch& batch) {
    gpu::DrawConstants constants{};
    constants.light_first = batch.first;
    constants.light_end = batch.end;
    return constants;
}

gpu::DrawConstants constantsOf(const FrameInputs& inputs, const DrawItem& item) {
    gpu::DrawConstants constants{};
    // Else 0 for all draws, because unchanged constants are not pushed again.
    if (inputs.variant.get(gpu::FEATURE_object_lights) != 0) constants.draw = item.draw;
    constants.material = item.range.material;
    constants.posing = inputs.posing.address(item);
    if (item.transmissive || item.variant.get(gpu::FEATURE_absorbing) != 0) constants.scale = item.scale;
    return constants;
}

// `sampled`: draws to images with the frame's samples; shadow maps have one.
std::vector<Pipeline> pipelinesOf(const FrameInputs& inputs, std::span<const DrawItem> items,
                                  const KeyOf& keyOf, bool sampled) {
    std::vector<PipelineKey> keys;
    for (const DrawItem& item : items) {
        keys.push_back(keyOf(item));
        PipelineKey& key = keys.back();
        key.variant.set(gpu::FEATURE_vertex_posing, inputs.posing.vertexPosing(item));
        if (sampled) {
            key = inputs.depth.stored(std::move(key));
            key.samples = inputs.samples;
            key.sample_shading = inputs.sample_shading;
            if (inputs.alpha_to_coverage && key.variant.get(gpu::FEATURE_alpha_mask) != 0)
                key.variant.set(gpu::FEATURE_alpha_mask, gpu::MASK_COVERS);
        }
        if (key.fragment != Shader::none)
            key.variant.set(gpu::FEATURE_samples, sampled ? inputs.variant.get(gpu::FEATURE_samples) : 0);
    }
    return inputs.pipelines.get(keys);
}

struct DrawSource {
    std::span<const DrawItem> items;
    std::span<const IndexRange> runs;
    VkBuffer buffer;   // Draw[draws.draws]
    bool culls_backs;  // of materials that are not double-sided
};

VkCullModeFlags culledOf(const DrawSource& source, const DrawItem& item) {
    switch (item.sides) {
        case Sides::back:
            return VK_CULL_MODE_FRONT_BIT;
        case Sides::front:
            return VK_CULL_MODE_BACK_BIT;
        case Sides::of_material:
            break;
    }
    const bool twoSided = !source.culls_backs || item.variant.get(gpu::FEATURE_double_sided) != 0;
    return twoSided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT;
}

bool areSame(const gpu::DrawConstants& a, const gpu::DrawConstants& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

// Records draws of a source's items, and only the state that changes between them.
template <class ConstantsOf>
class ItemRecorder {
public:
    ItemRecorder(VkCommandBuffer commands, const FrameInputs& inputs, const DrawSource& source,
                 const std::vector<Pipeline>& pipelines, const ConstantsOf& constantsOf)
        : commands_(commands),
          inputs_(inputs),
          source_(source),
          pipelines_(pipelines),
          constants_of_(constantsOf),
          indirect_draws_(inputs.device.indirectDraws()) {}

    // Sets the state of item i for the next draws.
    void take(std::size_t i) {
        const DrawItem& item = source_.items[i];
        if (last_ == nullptr || pipelines_[i] != pipelines_[taken_])
            vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[i]);
        if (last_ == nullptr || item.range.material != last_->range.material)
            bind(commands_, inputs_, gpu::SET_MATERIAL, inputs_.materials.set(item.range.material));
        const bool posed = inputs_.posing.isPosed(item);
        if (posed != posed_) {
            if (posed)
                inputs_.posing.bind(commands_);
            else
                inputs_.geometry.bindVertices(commands_);
            posed_ = posed;
        }
        if (item.uses_visible_indices != binds_visible_indices_) {
            inputs_.geometry.bindIndices(
                commands_, item.uses_visible_indices ? inputs_.culling->indices() : VK_NULL_HANDLE);
            binds_visible_indices_ = item.uses_visible_indices;
        }
        const VkCullModeFlags culled = culledOf(source_, item);
        if (last_ == nullptr || culled != culled_) vkCmdSetCullMode(commands_, culled);
        // glTF's front faces are counter-clockwise; clip space and framebuffer both have y down.
        if (last_ == nullptr || item.mirrored != last_->mirrored)
            vkCmdSetFrontFace(commands_,
                              item.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
        const gpu::DrawConstants constants = constants_of_(item);
        if (last_ == nullptr || !areSame(constants, constants_)) push(commands_, inputs_, constants);
        constants_ = constants;
        culled_ = culled;
        last_ = &item;
        taken_ = i;
    }
    // `instances`: number of instances, the current item included.
    void draw(const IndexRange& run, std::uint32_t instances = 1) const {
        vkCmdDrawIndexed(commands_, run.count, instances, run.first, inputs_.posing.vertexOffset(*last_),
                         last_->draw);
        inputs_.device.drawDivision().drawn(commands_, std::uint64_t{run.count / 3} * instances);
    }

    // Number of items from index i, the current item, that share its state.
    std::size_t sameFrom(std::size_t i) const {
        std::size_t end = i + 1;
        while (end < pipelines_.size() && drawsAs(i, end)) ++end;
        return end - i;
    }
    // Indirect draws of this many items from the current one, one for each of their index ranges.
    void drawIndirect(VkBuffer draws, std::size_t items) const {
        constexpr std::uint32_t stride = sizeof(VkDrawIndexedIndirectCommand);
        const DrawItem& last = source_.items[taken_ + items - 1];
        const std::uint32_t end = last.first_run + last.runs;
        for (std::uint32_t first = last_->first_run, count = 0; first < end; first += count) {
            count = std::min(indirect_draws_, end - first);
            vkCmdDrawIndexedIndirect(commands_, draws, VkDeviceSize{first} * stride, count, stride);
        }
        std::uint64_t triangles = 0;
        for (const IndexRange& run : source_.runs.subspan(last_->first_run, end - last_->first_run))
            triangles += run.count / 3;
        inputs_.device.drawDivision().drawn(commands_, triangles);
    }

private:
    bool drawsAs(std::size_t i, std::size_t next) const {
        const DrawItem &item = source_.items[i], &other = source_.items[next];
        return other.uses_visible_indices &&
               other.first_run == source_.items[next - 1].first_run + source_.items[next - 1].runs &&
               pipelines_[next] == pipelines_[i] && other.range.material == item.range.material &&
               other.mirrored == item.mirrored && culledOf(source_, other) == culledOf(source_, item) &&
               areSame(constants_of_(other), constants_);
    }

    VkCommandBuffer commands_;
    const FrameInputs& inputs_;
    const DrawSource& source_;
    const std::vector<Pipeline>& pipelines_;
    const ConstantsOf& constants_of_;
    std::uint32_t indirect_draws_;  // per command
    const DrawItem* last_ = nullptr;
    std::size_t taken_ = 0;
    gpu::DrawConstants constants_{};
    VkCullModeFlags culled_ = 0;
    bool posed_ = false;                  // deformed vertices are bound
    bool binds_visible_indices_ = false;  // index buffer of Culling is bound
};

// Index ranges that a source draws of item i; some may be empty.
struct ItemRuns {
    ItemRuns(const DrawSource& source, std::size_t i)
        : item(source.items[i]), whole{item.range.first_index, item.range.index_count}, source_(source) {}
    std::span<const IndexRange> all() const {
        return item.runs == 0 ? std::span(&whole, 1) : source_.runs.subspan(item.first_run, item.runs);
    }
    const DrawItem& item;
    IndexRange whole;

private:
    const DrawSource& source_;
};

// Number of items from index i that one draw covers as instances: same triangles, and their gpu::Draw data
// is adjacent. Push constants (lights by object, indices of blended triangles) must be equal.
template <class ConstantsOf>
std::uint32_t instancesFrom(std::size_t i, const DrawSource& source, const std::vector<Pipeline>& pipelines,
                            const ConstantsOf& constantsOf) {
    const ItemRuns first(source, i);
    if (first.all().size() != 1) return 1;
    const gpu::DrawConstants constants = constantsOf(first.item);
    std::size_t end = i + 1;
    for (; end < pipelines.size(); ++end) {
        const ItemRuns next(source, end);
        const bool same = isNextInstance(source.items[end - 1], next.item) &&
                          pipelines[end] == pipelines[i] && next.all().size() == 1 &&
                          next.all().front() == first.all().front() &&
                          areSame(constantsOf(next.item), constants);
        if (!same) break;
    }
    return static_cast<std::uint32_t>(end - i);
}

template <class ConstantsOf>
void recordItems(VkCommandBuffer commands, const FrameInputs& inputs, const DrawSource& source,
                 const std::vector<Pipeline>& pipelines, const ConstantsOf& constantsOf) {
    inputs.geometry.bind(commands, source.buffer);
    ItemRecorder recorder(commands, inputs, source, pipelines, constantsOf);
    const VkBuffer indirect =
        inputs.culling != nullptr ? inputs.culling->indirectDraws() : VkBuffer{VK_NULL_HANDLE};
    std::uint32_t instances = 1;
    for (std::size_t i = 0; i < pipelines.size(); i += instances) {
        if (source.items[i].uses_visible_indices && indirect != VK_NULL_HANDLE) {
            recorder.take(i);
            const std::size_t same = recorder.sameFrom(i);
            recorder.drawIndirect(indirect, same);
            instances = static_cast<std::uint32_t>(same);
            continue;
        }
        instances = instancesFrom(i, source, pipelines, constantsOf);
        const ItemRuns runs(source, i);
        bool taken = false;
        for (const IndexRange& run : runs.all()) {
            if (run.count == 0) continue;
            if (!taken) recorder.take(i);
            taken = true;
            recorder.draw(run, instances);
        }
    }
}

// The same, in the order of sorted triangles.
template <class ConstantsOf>
void recordSorted(VkCommandBuffer commands, const FrameInputs& inputs, const DrawSource& source,
                  const std::vector<Pipeline>& pipelines, const ConstantsOf& constantsOf) {
    inputs.geometry.bind(commands, source.buffer, inputs.sorted_indices);
    ItemRecorder recorder(commands, inputs, source, pipelines, constantsOf);
    for (const SortedRange& run : inputs.draws.sorted_runs) {
        recorder.take(run.item);
        recorder.draw(run.run);
    }
}

}  // namespace

std::function<void(VkCommandBuffer)> recordDraws(const FrameInputs& inputs, std::span<const DrawItem> items,
                                                 const KeyOf& keyOf, const LightBatch& batch,
                                                 std::shared_ptr<const DescriptorSets> gbuffer) {
    return [&inputs, items, batch, gbuffer = std::move(gbuffer),
            pipelines = pipelinesOf(inputs, items, keyOf, true)](VkCommandBuffer commands) {
        bindFrame(commands, inputs, batch, gbuffer.get());
        recordItems(commands, inputs, {items, inputs.draws.runs, inputs.draw_buffer, true}, pipelines,
                    [&](const DrawItem& item) {
                        gpu::DrawConstants constants = constantsOf(inputs, item);
                        constants.light_first = batch.first;
                        constants.light_end = batch.end;
                        return constants;
                    });
    };
}

std::function<void(VkCommandBuffer)> recordBlended(const FrameInputs& inputs, const KeyOf& keyOf,
                                                   std::shared_ptr<const DescriptorSets> gbuffer,
                                                   const gpu::BlendedConstants& constants) {
    return [&inputs, constants, gbuffer = std::move(gbuffer),
            pipelines = pipelinesOf(inputs, inputs.draws.blended(), keyOf, true)](VkCommandBuffer commands) {
        bindFrame(commands, inputs, {}, gbuffer.get());
        const DrawSource source{inputs.draws.blended(), inputs.draws.runs, inputs.draw_buffer, true};
        const auto blendedConstants = [&](const DrawItem& item) {
            gpu::DrawConstants own = constantsOf(inputs, item);
            own.triangle = item.triangle;
            own.blended = constants;
            return own;
        };
        if (inputs.draws.sorted_runs.empty())
            recordItems(commands, inputs, source, pipelines, blendedConstants);
        else
            recordSorted(commands, inputs, source, pipelines, blendedConstants);
    };
}

std::function<void(VkCommandBuffer)> recordCasters(const FrameInputs& inputs, const DrawList& draws,
                                                   VkBuffer draw_buffer) {
    return [&inputs, &draws, draw_buffer,
            pipelines = pipelinesOf(inputs, draws.items, depthKey, false)](VkCommandBuffer commands) {
        bindFrame(commands, inputs, {}, nullptr);
        recordItems(commands, inputs, {draws.items, draws.runs, draw_buffer, false}, pipelines,
                    [&](const DrawItem& item) { return constantsOf(inputs, item); });
    };
}

void recordTriangle(VkCommandBuffer commands, const Pipeline& pipeline) {
    recordUnculled(commands, pipeline, 3);
}

std::function<void(VkCommandBuffer)> recordVertices(const FrameInputs& inputs, const Pipeline& pipeline,
                                                    std::shared_ptr<const DescriptorSets> gbuffer,
                                                    gpu::uint vertices, gpu::uint draws) {
    return [&inputs, pipeline, gbuffer = std::move(gbuffer), vertices, draws](VkCommandBuffer commands) {
        bindFrame(commands, inputs, {}, gbuffer.get());
        gpu::DrawConstants constants{};
        for (; constants.group < draws; ++constants.group) {
            push(commands, inputs, constants);
            recordUnculled(commands, pipeline, vertices);
        }
    };
}

std::function<void(VkCommandBuffer)> recordFullScreen(const FrameInputs& inputs, const Pipeline& pipeline,
                                                      DescriptorSets gbuffer, const LightBatch& batch,
                                                      gpu::uint groups) {
    return [&inputs, pipeline, batch, groups,
            sets = std::make_shared<const DescriptorSets>(std::move(gbuffer))](VkCommandBuffer commands) {
        bindFrame(commands, inputs, batch, sets.get());
        gpu::DrawConstants constants = constantsOf(batch);
        for (; constants.group < groups; ++constants.group) {
            push(commands, inputs, constants);
            recordTriangle(commands, pipeline);
        }
    };
}

std::function<void(VkCommandBuffer, const Pass::Rows&)> recordDispatch(
    const FrameInputs& inputs, const Pipeline& pipeline, std::shared_ptr<const DescriptorSets> gbuffer,
    const LightBatch& batch, std::uint32_t across, gpu::uint group) {
    return [&inputs, pipeline, gbuffer = std::move(gbuffer), batch, across, group](VkCommandBuffer commands,
                                                                                   const Pass::Rows& rows) {
        bindFrame(commands, inputs, batch, gbuffer.get(), VK_PIPELINE_BIND_POINT_COMPUTE);
        gpu::DrawConstants constants = constantsOf(batch);
        constants.group = group;
        push(commands, inputs, constants);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdDispatchBase(commands, 0, rows.first, 0, across, rows.count, 1);
    };
}

std::function<void(VkCommandBuffer)> recordTiles(const FrameInputs& inputs, TiledLighting tiled,
                                                 DescriptorSets gbuffer, const LightBatch& batch,
                                                 gpu::uint groups) {
    return [&inputs, tiled = std::move(tiled), batch, groups,
            sets = std::make_shared<const DescriptorSets>(std::move(gbuffer))](VkCommandBuffer commands) {
        bindFrame(commands, inputs, batch, sets.get());
        gpu::DrawConstants constants = constantsOf(batch);
        constants.tile_size = tiled.tile_size;
        for (const TiledLighting::Class& of_class : tiled.classes) {
            bindUnculled(commands, of_class.pipeline);
            constants.tiles = addressWords(of_class.list);
            for (constants.group = 0; constants.group < groups; ++constants.group) {
                push(commands, inputs, constants);
                vkCmdDrawIndirect(commands, tiled.buffer->handle(), of_class.commands, 1, 0);
            }
        }
    };
}

std::function<void(VkCommandBuffer, const Pass::Rows&)> recordTileDispatches(
    const FrameInputs& inputs, TiledLighting tiled, std::shared_ptr<const DescriptorSets> gbuffer,
    const LightBatch& batch, gpu::uint group) {
    return [&inputs, tiled = std::move(tiled), gbuffer = std::move(gbuffer), batch, group](
               VkCommandBuffer commands, const Pass::Rows& rows) {
        bindFrame(commands, inputs, batch, gbuffer.get(), VK_PIPELINE_BIND_POINT_COMPUTE);
        gpu::DrawConstants constants = constantsOf(batch);
        constants.group = group;
        constexpr VkDeviceSize bytes = gpu::TILES_PER_DISPATCH * sizeof(gpu::uint);
        for (const TiledLighting::Class& of_class : tiled.classes) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, of_class.pipeline);
            for (std::uint32_t row = rows.first; row < rows.first + rows.count; ++row) {
                constants.tiles = addressWords(of_class.list + row * bytes);
                push(commands, inputs, constants);
                vkCmdDispatchIndirect(commands, tiled.buffer->handle(),
                                      of_class.commands + row * sizeof(gpu::TileDispatch));
            }
        }
    };
}

std::function<void(VkCommandBuffer)> recordFullScreen(const FrameInputs& inputs, const Pipeline& pipeline,
                                                      std::shared_ptr<const DescriptorSets> gbuffer,
                                                      const gpu::BlendedConstants& constants) {
    return [&inputs, pipeline, constants, gbuffer = std::move(gbuffer)](VkCommandBuffer commands) {
        bindFrame(commands, inputs, {}, gbuffer.get());
        gpu::DrawConstants own{};
        own.blended = constants;
        push(commands, inputs, own);
        recordTriangle(commands, pipeline);
    };
}

std::function<void(VkCommandBuffer)> recordFullScreen(const FrameInputs& inputs, const Pipeline& pipeline) {
    return [&inputs, pipeline](VkCommandBuffer commands) {
        bindFrame(commands, inputs, {}, nullptr);
        recordTriangle(commands, pipeline);
    };
}

}  // namespace diptych
