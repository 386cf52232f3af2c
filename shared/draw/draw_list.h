// SPDX-License-Identifier: MIT
// What is drawn from one view, in the one order that every pass of both paths keeps.
#pragma once

#include "shared/contract/geometry.h"
#include "shared/draw/geometry.h"
#include "shared/material/materials.h"
#include "shared/scene/view.h"

#include <vector>

namespace diptych {

struct DrawItem {
    PrimitiveRange range;
    std::uint32_t draw = 0;  // into DrawList::draws
    Variant variant;         // the material's features and the primitive's
    bool mirrored = false;   // the transform turns front faces round
    bool masked = false;     // alpha mask
    int distance = 0;        // of the farthest corner: only its order counts
};

struct DrawList {
    std::vector<gpu::Draw> draws;
    std::vector<DrawItem> items;
    std::uint32_t culled = 0;  // instances outside the view
};

// Orders opaque draws before masked ones, then from near to far by the farthest corner of the bounding box,
// then by variant and material, then as in the scene. What encloses other things, a room or a ground, comes
// after them, so most of what is hidden fails its depth test before it is shaded. An instance is left out
// only where its bounding box lies wholly beyond one plane of the view.
DrawList makeDrawList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                      const View& view);

}  // namespace diptych
