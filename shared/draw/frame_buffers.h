// SPDX-License-Identifier: MIT
// Buffers of one view and their descriptor set.
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

// Buffers of one view: camera, draws, lights and light lists; bound as SET_FRAME.
class FrameBuffers {
public:
    struct Choice {
        LightLists::Choice lists{};
        std::optional<std::uint32_t> object_pixel_lights{};  // --pixel-lights with --assign per_object
        bool albedo_table = false, sheen_table = false;      // uploads the tables of albedo.h
        float specular_aa_limit = 0;                         // --spec-aa-limit
    };
    struct Content {
        const View& view;
        const DrawList& draws;
        const GpuLights& lights;
    };
    FrameBuffers(Device& device, Uploader& uploader, const Layouts& layouts, const Content& content,
                 const Choice& choice);
    VkDescriptorSet set() const { return sets_[0]; }
    DescriptorSets& sets() { return sets_; }
    VkBuffer draws() const { return draws_.handle(); }
    VkBuffer sortedIndices() const { return sorted_indices_.handle(); }
    const Placeholders& placeholders() const { return placeholders_; }
    LightLists& lists() { return lists_; }
    const ObjectLightBuffers& objects() const { return objects_; }
    // Replaces the lights by as many others; light lists and bounds do not change. No frame may be in
    // flight.
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
