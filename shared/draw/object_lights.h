// SPDX-License-Identifier: MIT
// GPU buffers of --assign per_object: one light list per draw.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/light/per_object.h"
#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <cstdint>
#include <optional>

namespace diptych {

class ObjectLightBuffers {
public:
    // `pixels`: lights per pixel; empty with any other assignment, which leaves the buffers empty.
    ObjectLightBuffers(Device& device, Uploader& uploader, const DrawList& draws, const GpuLights& lights,
                       std::optional<std::uint32_t> pixels);

    void bind(DescriptorSets& sets) const;                // BINDING_OBJECT_LIST, BINDING_OBJECTS
    std::uint32_t features() const { return features_; }  // FEATURE_object_lights
    std::uint32_t longest() const { return longest_; }    // local lights per pixel of one draw
    double selectionMs() const { return selection_ms_; }  // CPU time of the selection
    std::uint64_t bytes() const { return entries_.size() + objects_.size(); }

private:
    GpuBuffer entries_, objects_;
    std::uint32_t features_ = 0, longest_ = 0;
    double selection_ms_ = 0;
};

}  // namespace diptych
