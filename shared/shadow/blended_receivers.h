// SPDX-License-Identifier: MIT
// Where blended surfaces receive the sun's shadow: a picture's depth, of what is opaque, does not show them.
// From their triangles, on the host. No Vulkan; in double.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/shadow/clipmap.h"

#include <optional>
#include <span>

namespace diptych {

// A view's blended draws. What is referred to outlives it.
struct BlendedReceivers {
    const DrawList& draws;  // of `pose` and `view`
    const Pose& pose;
    const Geometry& geometry;
    const View& view;

    // View depths of what lies in the view, m; nothing where nothing blended does. What something opaque
    // hides is counted too.
    std::optional<DepthRange> depths() const;

    // Sets the bits of the pages that are read there (clipmap_mark.comp does of what is opaque), and where a
    // part of a triangle is not smaller than a page, of neighbours of these. `marks`: a bit for each
    // ClipmapPage.
    void mark(const Clipmap& clipmap, std::span<gpu::uint> marks) const;
};

// Of both; nothing where there is neither.
std::optional<DepthRange> united(const std::optional<DepthRange>& a, const std::optional<DepthRange>& b);

}  // namespace diptych
