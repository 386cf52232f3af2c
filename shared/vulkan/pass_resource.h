// SPDX-License-Identifier: MIT
// An image or a buffer of a pass list. Read by the sources of PassList alone.
#pragma once

#include "shared/vulkan/pass.h"
#include "shared/vulkan/resources.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace diptych {

struct PassResource {
    // Exactly one of the two.
    std::optional<GpuImage> image;
    const GpuBuffer* buffer = nullptr;
    Life life = Life::kept;
    bool has_size = false;      // by its declaration, not the list's
    bool with_picture = false;  // that grows with the list's
    StoredDepths depths;
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>, OwnedImageView> views;
    // Of a transient, once it has memory: its first and last pass, and whose the memory is before.
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
