// SPDX-License-Identifier: MIT
// The buffers of one view and the descriptor set that binds them.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/draw/layouts.h"
#include "shared/draw/object_lights.h"
#include "shared/frame/setting_values.h"
#include "shared/light/ltc_image.h"

#include <cstdint>
#include <optional>
#include <span>

namespace diptych {

// The buffers of one view: camera, draws, lights and their lists; bound as SET_FRAME.
class FrameBuffers {
public:
    // `albedoTable`: whether the table of albedo.h is read.
    // `objectPixelLights`: --pixel-lights of --assign per_object; nothing with any other assignment.
    FrameBuffers(Device& device, Uploader& uploader, const Layouts& layouts, const View& view,
                 const DrawList& draws, const GpuLights& lights, const LightLists::Choice& choice,
                 std::optional<std::uint32_t> objectPixelLights = {}, bool albedoTable = false);
    VkDescriptorSet set() const { return sets_[0]; }
    DescriptorSets& sets() { return sets_; }
    VkBuffer draws() const { return draws_.handle(); }
    VkBuffer sortedIndices() const { return sorted_indices_.handle(); }
    const Placeholders& placeholders() const { return placeholders_; }
    LightLists& lists() { return lists_; }
    const ObjectLightBuffers& objects() const { return objects_; }
    // Takes other lights in the place of those that this was made of, equal in number: what chooses them,
    // lists and bounds, stays. No frame may be in flight.
    void replaceLights(Uploader& uploader, std::span<const gpu::Light> lights) const;
    std::uint64_t bytes() const {
        return view_.size() + packed_view_.size() + draws_.size() + sorted_indices_.size() + lights_.size() +
               spot_cones_.size() + area_lights_.size() + ltc_.bytes() + albedo_.size() + lists_.bytes() +
               objects_.bytes();
    }

private:
    GpuBuffer view_, packed_view_, draws_, sorted_indices_, lights_, spot_cones_, area_lights_, albedo_;
    OwnedBufferView packed_view_texels_, lights_view_, spot_cones_view_, area_lights_view_, albedo_view_;
    LtcImage ltc_;
    LightLists lists_;
    ObjectLightBuffers objects_;
    Placeholders placeholders_;
    DescriptorSets sets_;
};

}  // namespace diptych
