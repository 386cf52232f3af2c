// SPDX-License-Identifier: MIT
// What is drawn from one view, in the one order that every pass of both paths keeps.
#pragma once

#include "shared/contract/geometry.h"
#include "shared/draw/geometry.h"
#include "shared/frame/setting_values.h"
#include "shared/material/materials.h"
#include "shared/scene/view.h"

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace diptych {

// Of the corners of a bounding box, m; negative behind the camera.
struct ViewDepths {
    double nearest = 0, farthest = 0;
};

// Indices that follow one another.
struct IndexRun {
    std::uint32_t first = 0, count = 0;
    bool operator==(const IndexRun&) const = default;
};

// Triangles of one draw that follow one another in an order of all draws' triangles.
struct SortedRun {
    std::uint32_t item = 0;  // into DrawList::blended()
    IndexRun run;            // into DrawList::sorted_indices
};

// The sides of its triangles that a draw shows.
enum class Sides {
    of_material,  // the front, or both where the material is double-sided
    back,
    front,
};

struct DrawItem {
    PrimitiveRange range;
    std::uint32_t first_run = 0, runs = 0;  // into DrawList::runs; none: the whole range is drawn
    bool chosen = false;                    // these are indices of Culling, of which there may be none
    std::uint32_t draw = 0;                 // into DrawList::draws
    std::uint32_t instance = 0;             // into Pose::instances
    int box = -1;                           // into Pose::boxes; -1: not posed
    Variant variant;                        // the material's features and the primitive's
    bool mirrored = false;                  // the transform turns front faces round
    bool masked = false;                    // alpha mask
    bool blended = false;                   // alpha blending
    Sides sides = Sides::of_material;
    int distance = 0;  // of the farthest corner: only its order counts
    ViewDepths depths;
    double depth = 0;  // of its box's centre
    // Of blended draws: of the range's first triangle among those of all blended surfaces of the scene.
    std::uint32_t triangle = 0;
};

struct DrawList {
    std::vector<gpu::Draw> draws;
    std::vector<DrawItem> items;  // what is blended comes last
    std::size_t solid = 0;        // of the items those that are not
    std::vector<IndexRun> runs;
    // Transparency::triangles: what is blended, triangle by triangle; else empty.
    std::vector<std::uint32_t> sorted_indices;
    std::vector<SortedRun> sorted_runs;
    std::uint32_t culled = 0;     // instances that are not drawn
    std::uint64_t triangles = 0;  // that are in view; of casters, that are drawn
    std::span<const DrawItem> solids() const { return std::span(items).first(solid); }
    std::span<const DrawItem> blended() const { return std::span(items).subspan(solid); }
};

// Whether the item after `item` may be drawn with it as one more instance, where both draw the same indices
// with one pipeline: all that they differ in is in their draws, which stand side by side.
bool isNextInstance(const DrawItem& item, const DrawItem& next);

// World axes from the eye, of a primitive's stored positions.
glm::dmat4 fromEye(const PlacedPrimitive& placed, const glm::dvec3& eye);

// Orders opaque draws before masked ones, then from near to far by the farthest corner of the bounding box,
// then by variant, material and mesh, then as in the scene. What encloses other things, a room or a ground,
// comes after them, so most of what is hidden fails its depth test before it is shaded. An instance is left
// out only where its bounding box lies wholly beyond one plane of the view. Triangles of a solid draw come in
// the order of clusters, but where it is posed in the scene's. Blended draws come after all others: from far
// to near by the centre of the bounding box, a double-sided one twice, first its backs
// (`Transparency::sorted`), or as in the scene. With `Transparency::triangles` they stay as in the scene, and
// `sorted_runs` has the order in which their triangles are drawn: from far to near by the view depth of the
// centroid, and where two are equal as in the scene. There are none of `Transparency::off`; for
// `Transparency::list` they come from near to far, which spares it work.
DrawList makeDrawList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                      const View& view, Transparency transparency = Transparency::sorted);

// A box in clip space where w is 1 everywhere.
struct ClipBox {
    glm::dvec3 min{0}, max{0};
};

// What is drawn into a shadow map. `clip_from_world`, of world axes with `eye` as the origin, puts what the
// map covers into -1..1, whatever its depth.
struct CasterRequest {
    glm::dmat4 clip_from_world{1};
    glm::dvec3 eye{0};
    // Whether what lies in the box may change what is read of the map; only where w is 1 everywhere. None:
    // all that the map covers may.
    std::function<bool(const ClipBox&)> matters{};
    bool all = false;  // every caster, wherever it is
};

// What may cast a shadow into the map: those clusters of casters whose boxes are not wholly beyond one of its
// sides, and that matter. Ordered as above, for a light that is infinitely far.
DrawList makeCasterList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                        const CasterRequest& request);

// A box along any three axes.
struct SeenBox {
    glm::dvec3 centre{0};                // world axes, from the eye
    std::array<glm::dvec3, 3> halves{};  // of its sides
    // Half its extent along a direction, times its length.
    double reach(const glm::dvec3& along) const;
};

// Of every cluster that is not wholly beyond one plane of the view: where that lies which the picture may
// show.
std::vector<SeenBox> seenBoxes(const Pose& pose, const Geometry& geometry, const View& view);

}  // namespace diptych
