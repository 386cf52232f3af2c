// SPDX-License-Identifier: MIT
// What is drawn from one view, in the one order that every pass of both paths keeps.
#pragma once

#include "shared/contract/geometry.h"
#include "shared/draw/geometry.h"
#include "shared/material/materials.h"
#include "shared/scene/view.h"

#include <vector>

namespace diptych {

// Of the corners of a bounding box, m; negative behind the camera.
struct ViewDepths {
    double nearest = 0, farthest = 0;
};

struct DrawItem {
    PrimitiveRange range;
    std::uint32_t draw = 0;  // into DrawList::draws
    Variant variant;         // the material's features and the primitive's
    bool mirrored = false;   // the transform turns front faces round
    bool masked = false;     // alpha mask
    int distance = 0;        // of the farthest corner: only its order counts
    ViewDepths depths;
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

// What may cast a shadow into a part of light space: `clipFromWorld`, of world axes with `eye` as the origin,
// puts it into -1..1, whatever its depth. Ordered as above, for a light that is infinitely far.
DrawList makeCasterList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                        const glm::dmat4& clipFromWorld, const glm::dvec3& eye);

}  // namespace diptych
