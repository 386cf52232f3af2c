// SPDX-License-Identifier: MIT
#include "shared/draw/frame_buffers.h"

#include "shared/contract/bindings.h"
#include "shared/contract/view.h"
#include "shared/draw/packed_view.h"
#include "shared/environment/directional_albedo.h"
#include "shared/environment/sheen_albedo.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vector>

namespace diptych {

FrameBuffers::FrameBuffers(Device& device, Uploader& uploader, const Layouts& layouts, const Content& content,
                           const Choice& choice)
    : lists_(device, uploader, layouts.lists, choice.lists, content.view, content.lights),
      objects_(device, uploader, content.draws, content.lights, choice.object_pixel_lights),
      placeholders_(device, uploader, layouts),
      sets_(device, layouts.frame, frameBindings(), 1) {
    const auto& [view, draws, lights] = content;
    gpu::View gpuView = view.gpuView();
    gpuView.directional_light_count = lights.directional;
    gpuView.point_light_count = lights.point;
    gpuView.spot_light_count = lights.spot;
    std::inclusive_scan(lights.areas.begin(), lights.areas.end(), gpuView.area_ends);
    gpuView.ambient = lights.ambient;
    gpuView.specular_aa_limit = choice.specular_aa_limit;
    const auto upload = [&]<typename T>(const char* name, const std::vector<T>& from, GpuBuffer& buffer,
                                        OwnedBufferView& texels) {
        buffer = makeBuffer<T>(device, uploader, name, from, texelsOrAddress);
        texels = texelsUnless(lists_.addressed(), device, name, buffer, VK_FORMAT_R32G32B32A32_SFLOAT);
        return addressWords(buffer.address());
    };
    gpuView.lights = upload("lights", lights.lights, lights_, lights_view_);
    gpuView.spot_cones = upload("spot cones", lights.spot_cones, spot_cones_, spot_cones_view_);
    gpuView.area_lights = upload("area lights", lights.area_lights, area_lights_, area_lights_view_);
    view_ = makeBuffer<gpu::View>(device, uploader, "view", std::span(&gpuView, 1),
                                  VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    const PackedView packed = packedView(gpuView, lists_.grid());
    packed_view_ = makeBuffer<glm::uvec4>(device, uploader, "packed view", packed,
                                          VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    packed_view_texels_ = makeTexelView(device, "packed view", packed_view_, VK_FORMAT_R32G32B32A32_UINT);
    draws_ = makeBuffer<gpu::Draw>(device, uploader, "draws", draws.draws, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    if (!draws.sorted_indices.empty())
        sorted_indices_ = makeBuffer<std::uint32_t>(device, uploader, "sorted indices", draws.sorted_indices,
                                                    VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    ltc_ = LtcImage(device, uploader, lights.area() > 0);
    std::vector<glm::vec4> albedo;
    if (choice.albedo_table || choice.sheen_table) albedo = directionalAlbedoPairs();
    if (choice.sheen_table) std::ranges::copy(sheenAlbedoRows(), std::back_inserter(albedo));
    albedo_ = makeBuffer<glm::vec4>(device, uploader, "directional albedo", albedo,
                                    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    albedo_view_ = makeTexelView(device, "directional albedo", albedo_, VK_FORMAT_R32G32B32A32_SFLOAT);
    uploader.flush();
    placeholders_.bindFrame(sets_);
    sets_.buffer(0, gpu::BINDING_VIEW, view_.handle());
    sets_.texels(0, gpu::BINDING_VIEW_TEXELS, packed_view_texels_);
    sets_.texels(0, gpu::BINDING_LIGHTS, lights_view_);
    sets_.texels(0, gpu::BINDING_SPOT_CONES, spot_cones_view_);
    sets_.texels(0, gpu::BINDING_AREA_LIGHTS, area_lights_view_);
    sets_.image(0, gpu::BINDING_LTC_TABLE, ltc_.view(), ltc_.sampler(),
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    sets_.texels(0, gpu::BINDING_ALBEDO, albedo_view_);
    lists_.bind(sets_);
    objects_.bind(sets_);
}

void FrameBuffers::replaceLights(Uploader& uploader, std::span<const gpu::Light> lights) const {
    uploader.buffer(lights_, std::as_bytes(lights));
    uploader.flush();
}

}  // namespace diptych
