// SPDX-License-Identifier: MIT
#include "shared/draw/draw_list.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace diptych {

namespace {

// Columns of the cofactor matrix are the inverse transpose times the determinant. A transform that flattens
// one axis has one too, of rank 1: normals along that axis keep theirs, others become zero.
glm::dmat3 normalFromObject(const glm::dmat3& m) {
    glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const double length =
        std::max({glm::length(cofactors[0]), glm::length(cofactors[1]), glm::length(cofactors[2])});
    if (!(length > 0)) return glm::dmat3(1.0);
    return cofactors * ((glm::determinant(m) < 0 ? -1.0 : 1.0) / length);
}

gpu::Draw gpuDraw(const glm::dmat4& worldFromObject, const glm::dvec3& eye, const glm::dmat4& clipFromWorld) {
    const glm::dmat3 linear(worldFromObject);
    glm::dmat4 fromCamera = worldFromObject;
    fromCamera[3] -= glm::dvec4(eye, 0.0);
    return {glm::mat4(clipFromWorld * fromCamera), glm::mat4x3(fromCamera),
            glm::mat3(normalFromObject(linear)), glm::determinant(linear) < 0 ? -1.0f : 1.0f};
}

// Whether the transform may make an interpolated normal vanish. Without flattening, a weighted sum of normals
// that is not zero in the object is not zero in the world; float32 is trusted with that up to a flattening of
// 1 : 64.
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

// Whether all corners of the box are beyond one of the clip planes (far excepted where it is at infinity:
// there z = 0 is reached by nothing). The slack keeps a box that float32 might still touch.
bool outside(const glm::dmat4& clipFromObject, const PrimitiveRange& range) {
    const std::array<glm::dvec4, 8> box = corners(clipFromObject, range);
    double scale = 0;
    for (const glm::dvec4& corner : box)
        for (int c = 0; c < 4; ++c) scale = std::max(scale, std::abs(corner[c]));
    const double slack = 1e-5 * scale;
    const auto allBeyond = [&](auto distance) {
        return std::all_of(box.begin(), box.end(), [&](const glm::dvec4& c) { return distance(c) < -slack; });
    };
    return allBeyond([](const glm::dvec4& c) { return c.w + c.x; }) ||
           allBeyond([](const glm::dvec4& c) { return c.w - c.x; }) ||
           allBeyond([](const glm::dvec4& c) { return c.w + c.y; }) ||
           allBeyond([](const glm::dvec4& c) { return c.w - c.y; }) ||
           allBeyond([](const glm::dvec4& c) { return c.w - c.z; }) ||
           allBeyond([](const glm::dvec4& c) { return c.z; });
}

ViewDepths viewDepths(const glm::dmat4& cameraFromObject, const glm::dvec3& forward,
                      const PrimitiveRange& range) {
    ViewDepths depths{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const glm::dvec4& corner : corners(cameraFromObject, range)) {
        const double depth = glm::dot(forward, glm::dvec3(corner));
        depths = {std::min(depths.nearest, depth), std::max(depths.farthest, depth)};
    }
    return depths;
}

// In steps of 1/16 octave: draws at about the same depth still get sorted by variant and material.
int distanceOf(double depth) {
    return depth > 0 ? static_cast<int>(std::floor(16 * std::log2(depth))) : std::numeric_limits<int>::min();
}

// What every draw of an instance has, whatever it is drawn to.
DrawItem itemOf(const Instance& instance, const PrimitiveRange& range, const Materials& materials) {
    DrawItem item;
    item.range = range;
    item.variant = materials.variant(range.material);
    if (range.vertex_color) item.variant.set(gpu::FEATURE_vertex_color);
    if (range.vanishing_normals || item.variant.get(gpu::FEATURE_normal_texture) != 0 ||
        flattens(instance.world_from_object))
        item.variant.set(gpu::FEATURE_vanishing_normals);
    item.masked = item.variant.get(gpu::FEATURE_alpha_mask) != 0;
    return item;
}

// The instances that `draws` and that are not wholly outside of clip space. `depthsOf` gives the view depths
// of one, of its transform relative to `eye`; they are ordered by the farthest.
template <class Draws, class DepthsOf>
DrawList listOf(const Pose& pose, const Geometry& geometry, const Materials& materials,
                const glm::dmat4& clipFromWorld, const glm::dvec3& eye, const Draws& draws,
                const DepthsOf& depthsOf) {
    DrawList list;
    for (const Instance& instance : pose.instances) {
        const PrimitiveRange& range = geometry.range(instance.mesh, instance.primitive);
        if (range.index_count == 0 || !draws(range)) continue;
        glm::dmat4 fromCamera = instance.world_from_object;
        fromCamera[3] -= glm::dvec4(eye, 0.0);
        if (outside(clipFromWorld * fromCamera, range)) {
            ++list.culled;
            continue;
        }
        DrawItem item = itemOf(instance, range, materials);
        item.draw = static_cast<std::uint32_t>(list.draws.size());
        list.draws.push_back(gpuDraw(instance.world_from_object, eye, clipFromWorld));
        item.mirrored = list.draws.back().handedness < 0;
        item.depths = depthsOf(fromCamera, range);
        item.distance = distanceOf(item.depths.farthest);
        list.items.push_back(item);
    }
    std::stable_sort(list.items.begin(), list.items.end(), [](const DrawItem& a, const DrawItem& b) {
        const auto key = [](const DrawItem& i) {
            return std::tie(i.masked, i.distance, i.variant, i.range.material);
        };
        return key(a) < key(b);
    });
    return list;
}

}  // namespace

DrawList makeDrawList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                      const View& view) {
    return listOf(
        pose, geometry, materials, view.clipFromWorld(), view.eye(),
        [](const PrimitiveRange&) { return true; },
        [&](const glm::dmat4& fromCamera, const PrimitiveRange& range) {
            return viewDepths(fromCamera, -view.backward(), range);
        });
}

DrawList makeCasterList(const Pose& pose, const Geometry& geometry, const Materials& materials,
                        const glm::dmat4& clipFromWorld, const glm::dvec3& eye) {
    return listOf(
        pose, geometry, materials, clipFromWorld, eye,
        [&](const PrimitiveRange& range) { return materials.castsShadow(range.material); },
        [](const glm::dmat4&, const PrimitiveRange&) { return ViewDepths(); });
}

}  // namespace diptych
