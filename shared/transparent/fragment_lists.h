// SPDX-License-Identifier: MIT
// The buffers that hold the nearest blended fragments of every pixel (shaders/lib/fragment_list.glsl).
#pragma once

#include "shared/contract/transparency.h"
#include "shared/draw/draw_list.h"
#include "shared/frame/settings.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/pass_list.h"

#include <cstdint>

namespace diptych {

class FragmentLists {
public:
    // Empty where the Settings ask for none or nothing is blended. A picture that needs larger buffers than a
    // device binds is made in parts of so many rows that they fit. Throws std::runtime_error where the device
    // lacks what sorts fragments.
    FragmentLists(Device& device, const DrawList& draws, const Settings& settings);

    bool any() const { return layers_ > 0; }
    std::uint32_t layers() const { return layers_; }
    std::uint32_t rows() const { return rows_; }  // of the picture that the buffers hold at a time
    std::uint64_t bytes() const { return any() ? keys_.size() + fragments_.size() : 0; }

    void bind(DescriptorSets& sets) const;
    // A pass that empties the lists; with `counters` also what they have counted so far.
    void addClear(PassList& passes, bool counters) const;
    // Declares that a pass's fragment shaders read and write them.
    void use(PassList& passes, Pass& pass) const;

    // Of the last picture: fragments that found no room, and the pixels that have some. Waits.
    struct Overflow {
        std::uint64_t fragments = 0, pixels = 0;
    };
    Overflow overflow() const;
    // For tests: [layers][pixels] keys and fragments of the part that was drawn last. Waits.
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
