// SPDX-License-Identifier: MIT
// Receivers among blended surfaces, which are not in the depth buffer. Computed from their triangles on
// the CPU, in double. No Vulkan.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/shadow/clipmap.h"

#include <optional>
#include <span>

namespace diptych {

// Blended draws of a view. The referenced objects must outlive it.
struct BlendedReceivers {
    const DrawList& draws;  // of `pose` and `view`
    const Pose& pose;
    const Geometry& geometry;
    const View& view;

    // View depths of visible blended geometry, m; nothing if there is none. Ignores occlusion by opaque
    // surfaces.
    std::optional<DepthRange> depths() const;

    // Marks the clipmap pages that blended receivers sample (clipmap_mark.comp does it for opaque ones).
    // Where part of a triangle is not smaller than a page, it may also mark neighbours. `marks`: a bit per
    // ClipmapPage.
    void mark(const Clipmap& clipmap, std::span<gpu::uint> marks) const;
};

// Union of both; nothing if both are empty.
std::optional<DepthRange> united(const std::optional<DepthRange>& a, const std::optional<DepthRange>& b);

}  // namespace diptych
