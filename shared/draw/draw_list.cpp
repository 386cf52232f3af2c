// SPDX-License-Identifier: MIT
#include "shared/draw/draw_list.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace diptych {

namespace {

// The cofactor matrix is the inverse transpose times the determinant. It also exists if the transform
// flattens one axis: it then has rank 1, keeps normals along that axis, and makes the others zero.
glm::dmat3 normalFromObject(const glm::dmat3& m) {
    glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const double length =
        std::max({glm::length(cofactors[0]), glm::length(cofactors[1]), glm::length(cofactors[2])});
    if (!(length > 0)) return glm::dmat3(1.0);
    return cofactors * ((glm::determinant(m) < 0 ? -1.0 : 1.0) / length);
}

gpu::Draw gpuDraw(const PlacedPrimitive& placed, const glm::dvec3& eye, const glm::dmat4& clipFromWorld) {
    const glm::dmat4 fromCamera = fromEye(placed, eye);
    return {glm::mat4(clipFromWorld * fromCamera), glm::mat4x3(fromCamera),
            glm::mat3(normalFromObject(glm::dmat3(placed.world_from_object))),
            placed.mirrored ? -1.0f : 1.0f};
}

// Whether the transform may make an interpolated normal vanish. Without flattening, a weighted sum of
// normals that is not zero in object space is not zero in world space. float32 preserves that up to a
// flattening of 1 : 64.
bool flattens(const glm::dmat4& worldFromObject) {
    const glm::dmat3 m(worldFromObject);
    const double longest = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
    return !(std::abs(glm::determinant(m)) > longest * longest * longest / 64);
}

std::array<glm::dvec4, 8> corners(const glm::dmat4& fromObject, const PrimitiveRange& range) {
    std::array<glm::dvec4, 8> result;
    for (std::size_t i = 0; i < 8; ++i)
        result[i] = fromObject * glm::dvec4(i & 1 ? range.bounds_max.x : range.bounds_min.x,
                                            i & 2 ? range.bounds_max.y : range.bounds_min.y,
                                            i & 4 ? range.bounds_max.z : range.bounds_min.z, 1.0);
    return result;
}

struct ObjectBox {
    glm::dvec3 centre, half;
    template <class Vector>
    ObjectBox(const Vector& min, const Vector& max)
        : centre((glm::dvec3(min) + glm::dvec3(max)) / 2.0),
          half((glm::dvec3(max) - glm::dvec3(min)) / 2.0) {}
};

// Clip planes in object space. An infinite far plane culls nothing, because z = 0 is never reached.
class ClipSides {
public:
    // `range`: its bounds contain all tested boxes. The slack covers float32 rounding.
    ClipSides(const glm::dmat4& clipFromObject, const PrimitiveRange& range) {
        const glm::dmat4 rows = glm::transpose(clipFromObject);
        sides_ = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                  rows[3] - rows[1], rows[3] - rows[2], rows[2]};
        double scale = 0;
        for (const glm::dvec4& corner : corners(clipFromObject, range))
            for (int c = 0; c < 4; ++c) scale = std::max(scale, std::abs(corner[c]));
        slack_ = 1e-5 * scale;
    }
    // Whether the box is entirely outside one plane.
    bool exclude(const ObjectBox& box) const {
        return std::ranges::any_of(sides_, [&](const glm::dvec4& side) {
            const glm::dvec3 normal(side);
            return glm::dot(normal, box.centre) + glm::dot(glm::abs(normal), box.half) + side.w < -slack_;
        });
    }

private:
    std::array<glm::dvec4, 6> sides_;
    double slack_ = 0;
};

ViewDepths viewDepths(const glm::dmat4& cameraFromObject, const glm::dvec3& forward,
                      const PrimitiveRange& range) {
    ViewDepths depths{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const glm::dvec4& corner : corners(cameraFromObject, range)) {
        const double depth = glm::dot(forward, glm::dvec3(corner));
        depths = {std::min(depths.nearest, depth), std::max(depths.farthest, depth)};
    }
    return depths;
}

// In steps of 1/16 octave, so that draws at a similar depth are sorted by variant and material.
int distanceOf(double depth) {
    return depth > 0 ? static_cast<int>(std::floor(16 * std::log2(depth))) : std::numeric_limits<int>::min();
}

// Properties of an instance's draw that do not depend on the view.
DrawItem itemOf(const PlacedPrimitive& placed, const Materials& materials) {
    const PrimitiveRange& range = placed.range;
    DrawItem item;
    item.range = range;
    item.box = placed.box;
    item.variant = materials.variant(range.material);
    if (range.vertex_color) item.variant.set(gpu::FEATURE_vertex_color);
    if (range.vanishing_normals || item.variant.get(gpu::FEATURE_normal_texture) != 0 ||
        item.variant.get(gpu::FEATURE_clearcoat_normal_texture) != 0 || flattens(placed.world_from_object))
        item.variant.set(gpu::FEATURE_vanishing_normals);
    item.transmissive = item.variant.get(gpu::FEATURE_transmission) != 0;
    item.blended = materials.blends(range.material) && !item.transmissive;
    item.masked = item.variant.get(gpu::FEATURE_alpha_mask) != 0;
    return item;
}

bool isSolid(const DrawItem& item) {
    return !item.blended && !item.transmissive;
}

ClipBox clipBox(const glm::dmat4& clipFromObject, const ObjectBox& box) {
    const glm::dvec3 centre(clipFromObject * glm::dvec4(box.centre, 1));
    glm::dvec3 extent(0);
    for (int i = 0; i < 3; ++i) extent += glm::abs(glm::dvec3(clipFromObject[i])) * box.half[i];
    return {centre - extent, centre + extent};
}

void add(DrawList& list, DrawItem item, const PlacedPrimitive& placed, const glm::dvec3& eye,
         const glm::dmat4& clipFromWorld) {
    item.draw = static_cast<std::uint32_t>(list.draws.size());
    list.draws.push_back(gpuDraw(placed, eye, clipFromWorld));
    item.mirrored = placed.mirrored;
    item.distance = distanceOf(item.depths.farthest);
    list.items.push_back(item);
}

void sort(DrawList& list) {
    std::stable_sort(list.items.begin(), list.items.end(), [](const DrawItem& a, const DrawItem& b) {
        const auto key = [](const DrawItem& i) {
            return std::tie(i.forward_shaded, i.masked, i.distance, i.variant, i.range.material,
                            i.range.first_index, i.mirrored);
        };
        return key(a) < key(b);
    });
    list.solid_count = list.items.size();
    list.stored_count = static_cast<std::size_t>(
        std::ranges::count_if(list.items, [](const DrawItem& item) { return !item.forward_shaded; }));
}

// Renumbers the draws in the order of the items: instances of one draw call need consecutive indices.
void number(DrawList& list) {
    constexpr std::uint32_t none = ~0u;
    std::vector<std::uint32_t> numbers(list.draws.size(), none);
    std::vector<gpu::Draw> draws;
    draws.reserve(list.draws.size());
    for (DrawItem& item : list.items) {
        std::uint32_t& now = numbers[item.draw];
        if (now == none) {
            now = static_cast<std::uint32_t>(draws.size());
            draws.push_back(list.draws[item.draw]);
        }
        item.draw = now;
    }
    list.draws = std::move(draws);
}

// `transparent_items`: in scene order.
void addTransparentItems(DrawList& list, std::vector<DrawItem> transparent_items, Transparency transparency) {
    const auto first = std::ranges::stable_partition(transparent_items, &DrawItem::transmissive).begin();
    std::stable_sort(transparent_items.begin(), first,
                     [](const DrawItem& a, const DrawItem& b) { return a.depth < b.depth; });
    list.items.insert(list.items.end(), transparent_items.begin(), first);
    list.transmissive_count = static_cast<std::size_t>(first - transparent_items.begin());
    std::vector<DrawItem> blended(first, transparent_items.end());
    const bool sorts = transparency == Transparency::sorted;
    if (sorts) std::ranges::stable_sort(blended, std::greater{}, &DrawItem::depth);
    // The image does not depend on this order, but near to far is fast: fragments beyond a full list are
    // finished immediately.
    if (transparency == Transparency::list) std::ranges::stable_sort(blended, std::less{}, &DrawItem::depth);
    for (DrawItem& item : blended) {
        if (sorts && item.variant.get(gpu::FEATURE_double_sided) != 0) {
            item.sides = Sides::back;
            list.items.push_back(item);
            item.sides = Sides::front;
        }
        list.items.push_back(item);
    }
}

// Sorts the triangles of the list's blended draws.
void sortTriangles(DrawList& list, const Pose& pose, const Geometry& geometry, const View& view) {
    struct Triangle {
        double depth;
        std::uint32_t item, number;
    };
    std::vector<Triangle> triangles;
    std::vector<std::span<const std::uint32_t>> indices;
    for (const DrawItem& item : list.blended()) {
        const PlacedTriangles of = geometry.triangles(pose, pose.instances[item.instance]);
        glm::dmat4 fromCamera = of.world_from_object;
        fromCamera[3] -= glm::dvec4(view.eye(), 0);
        // View depth of an object-space point: dot(depth, (point, 1)).
        const glm::dvec4 depth = glm::transpose(fromCamera) * glm::dvec4(-view.backward(), 0);
        const auto number = static_cast<std::uint32_t>(indices.size());
        for (std::uint32_t i = 0; i < of.rest.indices.size() / 3; ++i) {
            const std::size_t first = 3 * std::size_t{i};
            const glm::dvec3 centroid =
                (of.corner(first) + of.corner(first + 1) + of.corner(first + 2)) / 3.0;
            const double away = glm::dot(depth, glm::dvec4(centroid, 1));
            // NaN: the triangle is not drawn, but it needs a sort key.
            triangles.push_back({std::isnan(away) ? 0 : away, number, i});
        }
        indices.push_back(of.rest.indices);
    }
    if (3 * triangles.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error(
            fmt::format("--transparency triangles: {} blended triangles do not fit in one index buffer; use "
                        "--transparency sorted",
                        triangles.size()));
    std::ranges::stable_sort(triangles, std::greater{}, &Triangle::depth);
    list.sorted_indices.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        if (list.sorted_runs.empty() || list.sorted_runs.back().item != t.item)
            list.sorted_runs.push_back({t.item, {static_cast<std::uint32_t>(list.sorted_indices.size()), 0}});
        list.sorted_runs.back().run.count += 3;
        const auto corners = indices[t.item].subspan(3 * std::size_t{t.number}, 3);
        list.sorted_indices.insert(list.sorted_indices.end(), corners.begin(), corners.end());
    }
}

// Adds runs of the meshlets that `keeps` accepts; returns false if there are none.
template <class Keeps>
bool addRuns(DrawList& list, DrawItem& item, std::span<const Meshlet> meshlets, const Keeps& keeps) {
    item.first_run = static_cast<std::uint32_t>(list.runs.size());
    for (const Meshlet& meshlet : meshlets) {
        if (!keeps(ObjectBox(meshlet.min, meshlet.max))) continue;
        const bool follows = list.runs.size() > item.first_run &&
                             list.runs.back().first + list.runs.back().count == meshlet.first_index;
        if (!follows) list.runs.push_back({meshlet.first_index, 0});
        list.runs.back().count += meshlet.index_count;
        list.triangles += meshlet.index_count / 3;
    }
    item.runs = static_cast<std::uint32_t>(list.runs.size()) - item.first_run;
    return item.runs > 0;
}

}  // namespace

bool isNextInstance(const DrawItem& item, const DrawItem& next) {
    return next.draw == item.draw + 1 && next.range.first_index == item.range.first_index &&
           next.range.material == item.range.material && next.mirrored == item.mirrored && item.box < 0 &&
           next.box < 0 && next.sides == item.sides && next.uses_visible_indices == item.uses_visible_indices;
}

glm::dmat4 fromEye(const PlacedPrimitive& placed, const glm::dvec3& eye) {
    glm::dmat4 fromCamera = placed.world_from_object;
    fromCamera[3] -= glm::dvec4(eye, 0.0);
    return fromCamera;
}

DrawList makeDrawList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                      const View& view, Transparency transparency, bool forward_shades_layers) {
    DrawList list;
    const glm::dmat4 clipFromWorld = view.clipFromWorld();
    std::uint32_t blendedTriangles = 0;
    for (std::uint32_t i = 0; i < pose.instances.size(); ++i) {
        const Instance& instance = pose.instances[i];
        const PlacedPrimitive placed = geometry.placed(pose, instance);
        const PrimitiveRange& range = placed.range;
        if (range.index_count == 0) continue;
        const std::uint32_t triangle = blendedTriangles;
        if (materials.blends(range.material)) {
            if (transparency == Transparency::off) continue;
            blendedTriangles += range.index_count / 3;
        }
        const glm::dmat4 fromCamera = fromEye(placed, view.eye());
        if (ClipSides(clipFromWorld * fromCamera, range).exclude({range.bounds_min, range.bounds_max})) {
            ++list.culled;
            continue;
        }
        DrawItem item = itemOf(placed, materials);
        item.forward_shaded =
            forward_shades_layers && isSolid(item) && item.variant.get(gpu::FEATURE_layers) != 0;
        item.triangle = triangle;
        item.instance = i;
        item.scale = static_cast<float>(lengthScale(instance));
        item.depths = viewDepths(fromCamera, -view.backward(), range);
        list.triangles += range.index_count / 3;
        if (isSolid(item) && item.box < 0) {
            item.first_run = static_cast<std::uint32_t>(list.runs.size());
            item.runs = 1;
            list.runs.push_back({geometry.meshlets(range).front().first_index, range.index_count});
        }
        const ObjectBox box(range.bounds_min, range.bounds_max);
        item.depth = glm::dot(-view.backward(), glm::dvec3(fromCamera * glm::dvec4(box.centre, 1)));
        add(list, item, placed, view.eye(), clipFromWorld);
    }
    const auto first = std::stable_partition(list.items.begin(), list.items.end(),
                                             [](const DrawItem& item) { return isSolid(item); });
    std::vector<DrawItem> transparent_items(first, list.items.end());
    list.items.erase(first, list.items.end());
    sort(list);
    addTransparentItems(list, std::move(transparent_items), transparency);
    number(list);
    if (transparency == Transparency::triangles) sortTriangles(list, pose, geometry, view);
    return list;
}

DrawList makeCasterList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                        const CasterRequest& request) {
    DrawList list;
    for (const Instance& instance : pose.instances) {
        const PlacedPrimitive placed = geometry.placed(pose, instance);
        const PrimitiveRange& range = placed.range;
        if (range.index_count == 0 || materials.blends(range.material)) continue;
        const glm::dmat4 clipFromObject = request.clip_from_world * fromEye(placed, request.eye);
        const ClipSides sides(clipFromObject, range);
        const auto keeps = [&](const ObjectBox& box) {
            return !sides.exclude(box) && (!request.matters || request.matters(clipBox(clipFromObject, box)));
        };
        DrawItem item = itemOf(placed, materials);
        if (request.all) {
            list.triangles += range.index_count / 3;
        } else if (!keeps({range.bounds_min, range.bounds_max}) ||
                   !addRuns(list, item, geometry.meshlets(placed), keeps)) {
            ++list.culled;
            continue;
        }
        add(list, item, placed, request.eye, request.clip_from_world);
    }
    sort(list);
    number(list);
    return list;
}

double VisibleBox::halfExtent(const glm::dvec3& along) const {
    return std::abs(glm::dot(along, halves[0])) + std::abs(glm::dot(along, halves[1])) +
           std::abs(glm::dot(along, halves[2]));
}

std::vector<VisibleBox> visibleBoxes(const Pose& pose, const Geometry& geometry, const View& view) {
    std::vector<VisibleBox> boxes;
    for (const Instance& instance : pose.instances) {
        const PlacedPrimitive placed = geometry.placed(pose, instance);
        const PrimitiveRange& range = placed.range;
        if (range.index_count == 0) continue;
        const glm::dmat4 fromCamera = fromEye(placed, view.eye());
        const ClipSides sides(view.clipFromWorld() * fromCamera, range);
        if (sides.exclude({range.bounds_min, range.bounds_max})) continue;
        for (const Meshlet& meshlet : geometry.meshlets(placed)) {
            const ObjectBox box(meshlet.min, meshlet.max);
            if (sides.exclude(box)) continue;
            const glm::dmat3 linear(fromCamera);
            boxes.push_back(
                {.centre = fromCamera * glm::dvec4(box.centre, 1),
                 .halves = {linear[0] * box.half.x, linear[1] * box.half.y, linear[2] * box.half.z}});
        }
    }
    return boxes;
}

}  // namespace diptych
