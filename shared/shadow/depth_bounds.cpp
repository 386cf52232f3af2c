// SPDX-License-Identifier: MIT
#include "shared/shadow/depth_bounds.h"

#include "shared/draw/frame_buffers.h"
#include "shared/draw/pipeline_keys.h"
#include "shared/draw/record.h"
#include "shared/shadow/blended_receivers.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

namespace diptych {

namespace {

constexpr auto boundsTypes = bindingTypes({DEPTH_BOUNDS_BINDINGS(DIPTYCH_BINDING_ROW)});

// As in shaders/lib/geometry/position.glsl, so that the bounds are values of the channel depth.
double viewDepth(const gpu::View& view, gpu::uint bits) {
    const auto z = std::bit_cast<float>(bits);
    const float numerator = view.depth_numerator.x + view.depth_numerator.y * z,
                denominator = view.depth_denominator.x + view.depth_denominator.y * z;
    return double{numerator / denominator};
}

double relativeDeviation(const std::vector<double>& values) {
    double mean = 0, squares = 0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (const double value : values) squares += (value - mean) * (value - mean);
    return values.size() < 2 ? 0 : std::sqrt(squares / static_cast<double>(values.size() - 1)) / mean;
}

}  // namespace

DepthBounds::DepthBounds(Device& device)
    : layout_(makeSetLayout(device, boundsTypes)),
      pipeline_layout_(makePipelineLayout(device, std::array<VkDescriptorSetLayout, 1>{layout_})),
      sampler_(makeNearestSampler(device)),
      sets_(device, layout_, boundsTypes, 1),
      bounds_(device, "depth bounds", sizeof(gpu::DepthBounds),
              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                  VK_BUFFER_USAGE_TRANSFER_DST_BIT),
      seen_(device, "depth bounds, read back", sizeof(gpu::DepthBounds), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
            MemoryUse::readback) {
    sets_.buffer(0, gpu::BINDING_DEPTH_BOUNDS, bounds_.handle());
}

void DepthBounds::addPasses(PassList& passes, const FrameInputs& inputs) {
    const char* const name = "shadow depth bounds";
    const ImageRef depth = sceneDepth(passes, inputs, "shown depth");
    const BufferRef bounds = passes.buffer("depth bounds", bounds_),
                    seen = passes.buffer("depth bounds, read back", seen_);
    readGeometry(passes, passes.draw(name), inputs)
        .depth(depth, Load::clear)
        .record(recordDraws(inputs, inputs.draws.solids(), depthKey));
    passes.copy(name).uses(bounds, access::transferWrite).record([this](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, bounds_.handle(), offsetof(gpu::DepthBounds, deepest), 4,
                        gpu::DEEPEST_OF_NOTHING);
        vkCmdFillBuffer(commands, bounds_.handle(), offsetof(gpu::DepthBounds, nearest), 4, 0);
    });
    sets_.image(0, gpu::BINDING_BOUNDED_DEPTH, passes.view(depth), sampler_,
                VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    Variant variant;
    variant.set(gpu::FEATURE_depth_format, inputs.depth.kind)
        .set(gpu::FEATURE_samples, static_cast<gpu::uint>(inputs.samples));
    const Pipeline reduce =
        inputs.pipelines.compute(Shader::shadow_depth_bounds_comp, variant, pipeline_layout_);
    const auto groups = [](std::uint32_t pixels, std::uint32_t each) { return (pixels + each - 1) / each; };
    passes.compute(name)
        .samples(depth, inCompute)
        .uses(bounds, access::storageRead(inCompute))
        .uses(bounds, access::storageWrite(inCompute))
        .record([this, reduce, across = groups(passes.width(), 2 * gpu::MOMENT_THREADS),
                 down = groups(passes.height(), gpu::DEPTH_BOUNDS_ROWS)](VkCommandBuffer commands) {
            const VkDescriptorSet set = sets_[0];
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_layout_, 0, 1, &set, 0,
                                    nullptr);
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, reduce);
            vkCmdDispatch(commands, across, down, 1);
        });
    passes.copy(name)
        .uses(bounds, access::transferRead)
        .uses(seen, access::transferWrite)
        .record([this](VkCommandBuffer commands) {
            const VkBufferCopy all{0, 0, sizeof(gpu::DepthBounds)};
            vkCmdCopyBuffer(commands, bounds_.handle(), seen_.handle(), 1, &all);
            memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                          VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
        });
}

std::optional<DepthRange> DepthBounds::range(const View& view) const {
    gpu::DepthBounds bits{};
    std::memcpy(&bits, seen_.mapped(), sizeof bits);
    if (bits.deepest == gpu::DEEPEST_OF_NOTHING) return {};
    const gpu::View gpu = view.gpuView();
    return DepthRange{viewDepth(gpu, bits.nearest), viewDepth(gpu, bits.deepest)};
}

std::optional<DepthRange> shownDepths(const FrameInputs& inputs, const Pose& pose, const View& view) {
    PassList passes(inputs.device, static_cast<std::uint32_t>(view.width),
                    static_cast<std::uint32_t>(view.height));
    DepthBounds bounds(inputs.device);
    bounds.addPasses(passes, inputs);
    passes.run();
    return united(bounds.range(view), BlendedReceivers{inputs.draws, pose, inputs.geometry, view}.depths());
}

DepthVariation depthVariation(const FrameInputs& inputs, Uploader& uploader, const Pose& pose,
                              const View& view, double step, int steps) {
    std::vector<double> near, far;
    for (int i = 0; i < steps; ++i) {
        View moved = view;
        moved.camera.world_from_camera[3] += glm::dvec4(view.right() * (step * i), 0);
        const DrawList draws = makeDrawList(pose, inputs.geometry, inputs.materials, moved);
        FrameBuffers buffers(inputs.device, uploader, inputs.layouts, {moved, draws, inputs.lights}, {});
        const FrameInputs there{.device = inputs.device,
                                .layouts = inputs.layouts,
                                .pipelines = inputs.pipelines,
                                .geometry = inputs.geometry,
                                .posing = inputs.posing,
                                .materials = inputs.materials,
                                .draws = draws,
                                .lights = inputs.lights,
                                .draw_buffer = buffers.draws(),
                                .frame_set = buffers.set(),
                                .placeholders = buffers.placeholders(),
                                .lists = buffers.lists(),
                                .variant = inputs.variant,
                                .gbuffer = inputs.gbuffer,
                                .shadow = inputs.shadow};
        if (const std::optional<DepthRange> range = shownDepths(there, pose, moved)) {
            near.push_back(range->near);
            far.push_back(range->far);
        }
    }
    return {relativeDeviation(near), relativeDeviation(far)};
}

}  // namespace diptych
