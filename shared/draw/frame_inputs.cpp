// SPDX-License-Identifier: MIT
#include "shared/draw/frame_inputs.h"

#include "shared/contract/bindings.h"
#include "shared/contract/debug_mode.h"
#include "shared/contract/geometry.h"
#include "shared/environment/directional_albedo.h"
#include "shared/frame/debug_modes.h"
#include "shared/vulkan/check.h"

#include <algorithm>
#include <array>

namespace diptych {

namespace {

constexpr VkDescriptorType uniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                           storage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                           texels = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
// In the order of BINDING_* of SET_FRAME.
constexpr std::array frameTypes{
    uniform, uniform, texels,  texels,  texels, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, texels, texels,
    storage, storage, storage, storage, texels};

constexpr std::array carriedTypes{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                  VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

constexpr VkShaderStageFlags drawStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VkFormat formatFor(const DebugMode& mode) {
    return mode.width == 1   ? VK_FORMAT_R32_SFLOAT
           : mode.width == 2 ? VK_FORMAT_R32G32_SFLOAT
                             : VK_FORMAT_R32G32B32A32_SFLOAT;
}

gpu::PackedView packedView(const gpu::View& view, const gpu::LightGrid& grid) {
    return {view.direction_0,
            view.depth_numerator.x,
            view.direction_x,
            view.depth_numerator.y,
            view.direction_y,
            view.depth_denominator.x,
            view.depth_denominator.y,
            grid.slice_offset,
            grid.slice_shift | (grid.tile_shift << 16),
            grid.tiles.x | (grid.tiles.y << 16),
            grid.slices,
            view.directional_light_count,
            view.point_light_count,
            view.spot_light_count};
}

}  // namespace

std::span<const VkDescriptorType> frameBindings() {
    return frameTypes;
}

Layouts::Layouts(Device& device, VkDescriptorSetLayout material) : frame(makeSetLayout(device, frameTypes)) {
    std::array<VkDescriptorType, gpu::GBUFFER_ATTACHMENTS + 1> gbufferTypes;
    gbufferTypes.fill(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    gbuffer = makeSetLayout(device, gbufferTypes);
    carried = makeSetLayout(device, carriedTypes);
    const std::array<VkDescriptorSetLayout, 4> sets{frame, material, gbuffer, carried};
    const VkPushConstantRange constants{drawStages, 0, sizeof(gpu::DrawConstants)};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .pNext = nullptr,
                                          .flags = 0,
                                          .setLayoutCount = sets.size(),
                                          .pSetLayouts = sets.data(),
                                          .pushConstantRangeCount = 1,
                                          .pPushConstantRanges = &constants};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout), "vkCreatePipelineLayout");
    pipeline = OwnedPipelineLayout(device.handle(), layout);
    nearest = makeNearestSampler(device);
    lists = ListLayouts(device, frame);
}

NothingCarried::NothingCarried(Device& device, Uploader& uploader, const Layouts& layouts)
    : image_(device,
             {"nothing", litFormat, 1, 1, 1, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT}),
      sets_(device, layouts.carried, carriedTypes, 1) {
    constexpr std::array<float, 4> black{};
    uploader.level(image_, 0, std::as_bytes(std::span(black)));
    uploader.flush();
    for (gpu::uint i = 0; i < carriedTypes.size(); ++i)
        sets_.image(0, i, image_.view(), layouts.nearest, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

FrameBuffers::FrameBuffers(Device& device, Uploader& uploader, const Layouts& layouts, const View& view,
                           const DrawList& draws, const GpuLights& lights, const LightLists::Choice& choice,
                           std::optional<std::uint32_t> objectPixelLights)
    : lists_(device, uploader, layouts.lists, choice, view, lights),
      objects_(device, uploader, draws, lights, objectPixelLights),
      carried_nothing_(device, uploader, layouts),
      sets_(device, layouts.frame, frameTypes, 1) {
    gpu::View gpuView = view.gpuView();
    gpuView.directional_light_count = lights.directional;
    gpuView.point_light_count = lights.point;
    gpuView.spot_light_count = lights.spot;
    gpuView.rect_light_count = lights.rect;
    gpuView.disc_light_count = lights.disc;
    gpuView.tube_light_count = lights.tube;
    gpuView.ambient = lights.ambient;
    view_ = makeBuffer<gpu::View>(device, uploader, "view", std::span(&gpuView, 1),
                                  VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    const gpu::PackedView packed = packedView(gpuView, lists_.grid());
    packed_view_ = makeBuffer<gpu::PackedView>(device, uploader, "packed view", std::span(&packed, 1),
                                               VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    packed_view_texels_ = makeTexelView(device, "packed view", packed_view_, VK_FORMAT_R32G32B32A32_UINT);
    draws_ = makeBuffer<gpu::Draw>(device, uploader, "draws", draws.draws, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    lights_ = makeBuffer<gpu::Light>(device, uploader, "lights", lights.lights,
                                     VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    spot_cones_ = makeBuffer<gpu::SpotCone>(device, uploader, "spot cones", lights.spot_cones,
                                            VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    lights_view_ = makeTexelView(device, "lights", lights_, VK_FORMAT_R32G32B32A32_SFLOAT);
    spot_cones_view_ = makeTexelView(device, "spot cones", spot_cones_, VK_FORMAT_R32G32B32A32_SFLOAT);
    area_lights_ = makeBuffer<gpu::AreaLight>(device, uploader, "area lights", lights.area_lights,
                                              VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    area_lights_view_ = makeTexelView(device, "area lights", area_lights_, VK_FORMAT_R32G32B32A32_SFLOAT);
    ltc_ = LtcImage(device, uploader, lights.area() > 0);
    std::span<const glm::vec2> albedo;
    const bool lightmaps = std::ranges::any_of(draws.items, [](const DrawItem& item) {
        return item.variant.get(gpu::FEATURE_lightmap_texture) != 0;
    });
    if (lightmaps || lights.ambient != glm::vec3(0) || objects_.features() > gpu::OBJECT_LIGHTS_LISTS)
        albedo = directionalAlbedoTable();
    albedo_ = makeBuffer<glm::vec2>(device, uploader, "directional albedo", albedo,
                                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    uploader.flush();
    sets_.buffer(0, gpu::BINDING_VIEW, view_.handle());
    sets_.texels(0, gpu::BINDING_VIEW_TEXELS, packed_view_texels_);
    sets_.texels(0, gpu::BINDING_LIGHTS, lights_view_);
    sets_.texels(0, gpu::BINDING_SPOT_CONES, spot_cones_view_);
    sets_.texels(0, gpu::BINDING_AREA_LIGHTS, area_lights_view_);
    sets_.image(0, gpu::BINDING_LTC_TABLE, ltc_.view(), ltc_.sampler(),
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    sets_.buffer(0, gpu::BINDING_ALBEDO, albedo_.handle());
    lists_.bind(sets_);
    objects_.bind(sets_);
}

Variant sceneVariant(const Requirements& needs, const GpuLights& lights, const View& view,
                     const GBufferLayout& gbuffer, AreaLights area_lights) {
    Variant variant;
    gpu::uint area = 0;
    if (lights.rect > 0) area |= gpu::AREA_RECTS;
    if (lights.disc > 0) area |= gpu::AREA_DISCS;
    if (lights.tube > 0) area |= gpu::AREA_TUBES;
    if (area != 0 && area_lights == AreaLights::representative) area |= gpu::AREA_POINTS;
    variant.set(gpu::FEATURE_emission, needs.emission)
        .set(gpu::FEATURE_dielectric_specular, needs.dielectric_specular)
        .set(gpu::FEATURE_directional_lights, lights.directional > 0)
        .set(gpu::FEATURE_point_lights, lights.point > 0)
        .set(gpu::FEATURE_spot_lights, lights.spot > 0)
        .set(gpu::FEATURE_area_lights, area)
        .set(gpu::FEATURE_lightmap, needs.lightmap)
        .set(gpu::FEATURE_ambient, lights.ambient != glm::vec3(0))
        .set(gpu::FEATURE_orthographic, view.camera.orthographic);
    gbuffer.specialise(variant);
    return variant;
}

std::function<void(VkCommandBuffer)> recordDraws(const FrameInputs& inputs, const KeyOf& keyOf,
                                                 const LightChunk& chunk) {
    std::vector<PipelineKey> keys;
    for (const DrawItem& item : inputs.draws.items) keys.push_back(keyOf(item));
    std::vector<VkPipeline> pipelines = inputs.pipelines.get(keys);
    return [&inputs, chunk, pipelines = std::move(pipelines)](VkCommandBuffer commands) {
        const auto bind = [&](gpu::uint set, VkDescriptorSet descriptors) {
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, inputs.layouts.pipeline, set,
                                    1, &descriptors, 0, nullptr);
        };
        bind(gpu::SET_FRAME, inputs.frame_set);
        bind(gpu::SET_CARRIED, chunk.carried ? (*chunk.carried)[0] : inputs.carried_nothing);
        inputs.geometry.bind(commands, inputs.draw_buffer);
        const DrawItem* last = nullptr;
        VkPipeline lastPipeline = VK_NULL_HANDLE;
        for (std::size_t i = 0; i < pipelines.size(); ++i) {
            const DrawItem& item = inputs.draws.items[i];
            if (pipelines[i] != lastPipeline)
                vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[i]);
            if (last == nullptr || item.range.material != last->range.material)
                bind(gpu::SET_MATERIAL, inputs.materials.set(item.range.material));
            const bool twoSided = item.variant.get(gpu::FEATURE_double_sided) != 0;
            vkCmdSetCullMode(commands, twoSided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
            // glTF's front faces are counter-clockwise; clip space has y down, as has the framebuffer.
            vkCmdSetFrontFace(commands,
                              item.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
            const gpu::DrawConstants constants{item.draw, item.range.material, chunk.first, chunk.end};
            vkCmdPushConstants(commands, inputs.layouts.pipeline, drawStages, 0, sizeof constants,
                               &constants);
            vkCmdDrawIndexed(commands, item.range.index_count, 1, item.range.first_index,
                             item.range.vertex_offset, item.draw);
            last = &item;
            lastPipeline = pipelines[i];
        }
    };
}

void recordTriangle(VkCommandBuffer commands, VkPipeline pipeline) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    vkCmdDraw(commands, 3, 1, 0, 0);
}

void recordFullScreen(VkCommandBuffer commands, const FrameInputs& inputs, VkPipeline pipeline,
                      VkDescriptorSet gbuffer, const LightChunk& chunk) {
    const auto bind = [&](gpu::uint set, VkDescriptorSet descriptors) {
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, inputs.layouts.pipeline, set, 1,
                                &descriptors, 0, nullptr);
    };
    bind(gpu::SET_FRAME, inputs.frame_set);
    bind(gpu::SET_GBUFFER, gbuffer);
    bind(gpu::SET_CARRIED, chunk.carried ? (*chunk.carried)[0] : inputs.carried_nothing);
    const gpu::DrawConstants constants{0, 0, chunk.first, chunk.end};
    vkCmdPushConstants(commands, inputs.layouts.pipeline, drawStages, 0, sizeof constants, &constants);
    recordTriangle(commands, pipeline);
}

void LightChunk::read(Pass& pass) const {
    if (carried)
        for (const ImageRef image : images) pass.samples(image);
}

LightChunk addEarlierLights(PassList& passes, const FrameInputs& inputs, const AddChunk& add) {
    const gpu::uint groups = inputs.light_groups, most = gpu::MAX_LIGHTS_PER_DRAW;
    if (groups <= most) return {};
    LightChunk chunk{gpu::CHUNK_FIRST, 0, most};
    while (chunk.first + most < groups) {
        Pass& pass = passes.draw("shade earlier lights");
        chunk.read(pass);
        const std::array<ImageRef, 2> sums{passes.image("carried diffuse", litFormat),
                                           passes.image("carried specular", litFormat)};
        for (const ImageRef sum : sums) pass.color(sum, Load::clear);
        add(pass, chunk);
        auto carried =
            std::make_shared<DescriptorSets>(inputs.device, inputs.layouts.carried, carriedTypes, 1);
        for (gpu::uint i = 0; i < sums.size(); ++i)
            carried->image(0, i, passes.view(sums[i]), inputs.layouts.nearest,
                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        chunk = {gpu::CHUNK_LATER, chunk.end, std::min(chunk.end + most, groups), sums, std::move(carried)};
    }
    return chunk;
}

PipelineKey depthKey(const DrawItem& item) {
    PipelineKey key;
    key.depth = depthFormat;
    key.depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL;
    key.depth_write = true;
    if (item.variant.get(gpu::FEATURE_alpha_mask) == 0) {
        key.vertex = "depth.vert";
        key.input = VertexInput::positions;
        return key;
    }
    key.vertex = "surface.vert";
    key.fragment = "depth_mask.frag";
    key.input = VertexInput::all;
    for (const gpu::uint feature :
         {gpu::FEATURE_alpha_mask, gpu::FEATURE_base_color_texture, gpu::FEATURE_texture_transform,
          gpu::FEATURE_second_texcoord, gpu::FEATURE_vertex_color})
        key.variant.set(feature, item.variant.get(feature));
    return key;
}

void CaptureGroup::specialise(Variant& variant) const {
    for (gpu::uint i = 0; i < gpu::CAPTURE_ATTACHMENTS; ++i)
        variant.set(gpu::FEATURE_capture_0 + i,
                    i < modes.size() ? static_cast<gpu::uint>(modes[i]) : gpu::DEBUG_none);
}

std::vector<CaptureGroup> captureGroups(std::span<const int> modes) {
    std::vector<int> ordered(modes.begin(), modes.end());
    std::stable_partition(ordered.begin(), ordered.end(), [](int mode) { return !isLit(mode); });
    std::vector<CaptureGroup> groups;
    for (std::size_t i = 0; i < ordered.size(); ++i) {
        if (i % gpu::CAPTURE_ATTACHMENTS == 0) groups.emplace_back();
        groups.back().modes.push_back(ordered[i]);
        groups.back().formats.push_back(formatFor(debugMode(ordered[i])));
    }
    return groups;
}

std::vector<CapturedImage> addCaptureImages(PassList& passes, Pass& pass, const CaptureGroup& group) {
    std::vector<CapturedImage> images;
    for (std::size_t i = 0; i < group.modes.size(); ++i) {
        const ImageRef image = passes.image(std::string(debugMode(group.modes[i]).name), group.formats[i]);
        const float background = group.modes[i] == static_cast<int>(gpu::DEBUG_material_id) ? -1.0f : 0.0f;
        pass.color(image, Load::clear, {.float32 = {background, 0, 0, 0}});
        images.push_back({group.modes[i], image});
    }
    return images;
}

}  // namespace diptych
