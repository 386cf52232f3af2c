// SPDX-License-Identifier: MIT
// An image or a buffer of a pass list. For the sources of PassList alone.
#pragma once

#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/passes/pass.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace diptych {

struct PassResource {
    // Exactly one of the two is set.
    std::optional<GpuImage> image;
    const GpuBuffer* buffer = nullptr;
    Life life = Life::kept;
    bool has_size = false;    // declared, instead of the list's size
    bool with_image = false;  // that depends on the list's size
    StoredDepths depths;
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>, OwnedImageView> views;
    // Transients with memory: first and last pass, and the previous user of the memory.
    std::size_t first = 0, last = 0;
    std::optional<std::size_t> before;
};

inline Part wholeOf(const GpuImage& image) {
    return {0, image.info().levels, 0, image.info().layers};
}

inline VkExtent2D extentOf(const GpuImageInfo& image, const Slice& slice) {
    return {std::max(1u, image.width >> slice.level), std::max(1u, image.height >> slice.level)};
}

}  // namespace diptych
