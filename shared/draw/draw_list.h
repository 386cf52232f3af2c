// SPDX-License-Identifier: MIT
// Draws of one view, in the order that every pass of both paths uses.
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

// Depth range of a bounding box's corners, m; negative behind the camera.
struct ViewDepths {
    double nearest = 0, farthest = 0;
};

struct IndexRange {
    std::uint32_t first = 0, count = 0;
    bool operator==(const IndexRange&) const = default;
};

// Consecutive triangles of one draw in an order over all draws' triangles.
struct SortedRange {
    std::uint32_t item = 0;  // into DrawList::blended()
    IndexRange run;          // into DrawList::sorted_indices
};

// Sides of its triangles that a draw shows.
enum class Sides {
    of_material,  // the front, or both if the material is double-sided
    back,
    front,
};

struct DrawItem {
    PrimitiveRange range;
    std::uint32_t first_run = 0, runs = 0;  // into DrawList::runs; 0: the whole range is drawn
    bool uses_visible_indices = false;      // runs index the result of Culling, and may be empty
    std::uint32_t draw = 0;                 // into DrawList::draws
    std::uint32_t instance = 0;             // into Pose::instances
    int box = -1;                           // into Pose::boxes; -1: not posed
    Variant variant;                        // features of material and primitive
    bool mirrored = false;                  // the transform reverses the winding of front faces
    bool masked = false;
    bool blended = false;
    bool transmissive = false;    // drawn between opaque and blended surfaces
    float scale = 1;              // lengthScale()
    bool forward_shaded = false;  // by the deferred path, after lighting
    Sides sides = Sides::of_material;
    int distance = 0;  // of the farthest corner, quantized; a sort key
    ViewDepths depths;
    double depth = 0;  // of the centre of its box
    // Blended draws: index of the range's first triangle among the scene's blended triangles.
    std::uint32_t triangle = 0;
};

struct DrawList {
    std::vector<gpu::Draw> draws;
    std::vector<DrawItem> items;         // solids, transmissive ones, then blended ones
    std::size_t solid_count = 0;         // number of solids
    std::size_t stored_count = 0;        // number of solids before those that are forward-shaded
    std::size_t transmissive_count = 0;  // number of transmissive items
    std::vector<IndexRange> runs;
    // Transparency::triangles: blended triangles, sorted; else empty.
    std::vector<std::uint32_t> sorted_indices;
    std::vector<SortedRange> sorted_runs;
    std::uint32_t culled = 0;     // number of culled instances
    std::uint64_t triangles = 0;  // triangles in view; in a caster list, drawn triangles
    std::span<const DrawItem> solids() const { return std::span(items).first(solid_count); }
    // The deferred path stores the former in its G-buffer and shades the latter forward, after lighting.
    std::span<const DrawItem> storedSolids() const { return std::span(items).first(stored_count); }
    std::span<const DrawItem> forwardShadedSolids() const { return solids().subspan(stored_count); }
    std::span<const DrawItem> transmissive() const { return transparent().first(transmissive_count); }
    std::span<const DrawItem> blended() const { return transparent().subspan(transmissive_count); }
    std::span<const DrawItem> transparent() const { return std::span(items).subspan(solid_count); }
};

// Whether one draw call can cover `item` and `next` as instances, if both use the same indices and one
// pipeline: they differ only in their gpu::Draw, and these are adjacent.
bool isNextInstance(const DrawItem& item, const DrawItem& next);

// Transform from a primitive's stored positions to world axes relative to the eye.
glm::dmat4 fromEye(const PlacedPrimitive& placed, const glm::dvec3& eye);

// Draws of a view. Opaque draws come before masked ones, then near to far by the farthest corner of the
// bounding box, then by variant, material and mesh, then in scene order. So a room or ground comes after
// its contents, and most hidden fragments fail the depth test before shading.
// An instance is culled if its bounding box lies outside one plane of the view. Triangles of an opaque
// draw are in meshlet order, those of a deformed one in scene order.
// Transmissive draws come next, near to far by the centre of the bounding box, then in scene order: they
// write depth. Blended draws come last, in an order that depends on `transparency`:
//  - sorted: far to near by the centre of the bounding box; double-sided ones twice, back faces first
//  - triangles: in scene order; `sorted_runs` orders their triangles far to near by the view depth of the
//    centroid, ties in scene order
//  - list: near to far, which saves work in the fragment lists
//  - off: none, and no transmissive ones
//  - others: in scene order
// `forward_shades_layers`: solids whose materials have layers come after all others.
DrawList makeDrawList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                      const View& view, Transparency transparency = Transparency::sorted,
                      bool forward_shades_layers = false);

// A box in a clip space where w is 1 everywhere.
struct ClipBox {
    glm::dvec3 min{0}, max{0};
};

// Casters of a shadow map. `clip_from_world`, of world axes relative to `eye`, maps the map's area to
// -1..1 at every depth.
struct CasterRequest {
    glm::dmat4 clip_from_world{1};
    glm::dvec3 eye{0};
    // Whether geometry in the box can change a sampled texel of the map; only if w is 1 everywhere. Empty:
    // all geometry in the map's area can.
    std::function<bool(const ClipBox&)> matters{};
    bool all = false;  // every caster, without culling
};

// Meshlets that may cast a shadow into the map: not outside one of its sides, and accepted by `matters`.
// Ordered as above for a directional light.
DrawList makeCasterList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                        const CasterRequest& request);

// A box along three arbitrary axes.
struct VisibleBox {
    glm::dvec3 centre{0};                // world axes, relative to the eye
    std::array<glm::dvec3, 3> halves{};  // half axes
    // Half its extent along a direction, times the direction's length.
    double halfExtent(const glm::dvec3& along) const;
};

// Boxes of all meshlets that are not outside one plane of the view: a bound of the visible geometry.
std::vector<VisibleBox> visibleBoxes(const Pose& pose, const Geometry& geometry, const View& view);

}  // namespace diptych
