// SPDX-License-Identifier: MIT
// Buffers of the nearest blended fragments of each pixel (shaders/lib/blending/fragment_list.glsl).
#pragma once

#include "shared/contract/transparency.h"
#include "shared/draw/draw_list.h"
#include "shared/frame/settings.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <cstdint>

namespace diptych {

class FragmentLists {
public:
    // Empty unless --transparency list and there are blended surfaces. If the buffers would exceed the
    // device's largest binding, they cover only part of the image's rows at a time. Throws
    // std::runtime_error if the device does not support sorting fragments.
    FragmentLists(Device& device, const DrawList& draws, const Settings& settings);

    bool any() const { return layers_ > 0; }
    std::uint32_t layers() const { return layers_; }
    std::uint32_t rows() const { return rows_; }  // rows of the image that the buffers cover at a time
    std::uint64_t bytes() const { return any() ? keys_.size() + fragments_.size() : 0; }

    void bind(DescriptorSets& sets) const;
    // Adds a pass that clears the lists; `counters`: also their counters.
    void addClear(PassList& passes, bool counters) const;
    // Declares that fragment shaders of the pass read and write the lists.
    void use(PassList& passes, Pass& pass) const;

    // Counts of the last image: fragments that overflowed, and pixels with blended fragments. Waits.
    struct Overflow {
        std::uint64_t fragments = 0, pixels = 0;
    };
    Overflow overflow() const;
    // For tests: [layers][pixels] keys and fragments of the rows drawn last. Waits.
    struct Contents {
        std::vector<std::uint64_t> keys;
        std::vector<glm::vec4> fragments;
    };
    Contents contents() const;

private:
    std::uint64_t pixels() const { return std::uint64_t{width_} * rows_; }

    Device& device_;
    std::uint32_t layers_ = 0, width_ = 0, rows_ = 0;
    GpuBuffer keys_, fragments_;
};

}  // namespace diptych
