// SPDX-License-Identifier: MIT
#include "shared/shadow/cascades.h"

#include "shared/scene/model/axes.h"
#include "shared/shadow/scene_bounds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych {

namespace {

// Weight of the logarithmic split in the practical split.
constexpr double logarithmicFraction = 0.75;
// The first cascade begins at the near plane, but not nearer than this fraction of the shadow distance.
// Otherwise a near plane of 1 mm would spend all but the last cascade on the first metre.
constexpr double nearestFraction = 1.0 / 500;

struct Sphere {
    glm::dvec3 centre;
    double radius;
};

// Bounding sphere of the view between two depths. It depends only on the depths and the projection.
Sphere sphereOf(const View& view, double begin, double end) {
    const double aspect = static_cast<double>(view.width) / view.height;
    double depth = (begin + end) / 2, radius = 0;
    if (view.camera.orthographic) {
        const double side = view.camera.ymag * std::hypot(aspect, 1);
        radius = std::hypot(side, (end - begin) / 2);
    } else {
        // Half the image's diagonal at view depth 1. The centre has the same distance from the corners of
        // both ends, unless the sphere around the far end is larger.
        const double side = std::tan(view.camera.yfov / 2) * std::hypot(aspect, 1);
        depth = std::min((begin + end) / 2 * (1 + side * side), end);
        radius = std::max(std::hypot(end - depth, end * side), std::hypot(begin - depth, begin * side));
    }
    return {view.eye() - view.backward() * depth, radius};
}

// Extent of the scene, rounded up in steps, so that it mostly stays constant while the camera moves.
double sceneExtent(const View& view, const Bounds& bounds) {
    double extent = glm::length(bounds.max - bounds.min);
    for (const glm::dvec3& corner : cornersOf(bounds))
        extent = std::max(extent, glm::dot(corner - view.eye(), -view.backward()));
    const double steps = std::ceil(2 * std::log2(std::max(extent, std::numeric_limits<double>::min())));
    return std::exp2(steps / 2);
}

}  // namespace

double marginOf(const CascadeRequest& request) {
    const double radius = (request.kernel + 1) / 2.0;
    return radius + std::sqrt(2.0) * radius + request.bias + 1;
}

glm::dvec3 LightSpace::from(const glm::dvec3& world) const {
    return {glm::dot(x, world), glm::dot(y, world), glm::dot(z, world)};
}

LightSpace lightSpace(const glm::dvec3& to_light) {
    const glm::dvec3 x = perpendicularTo(to_light);
    return {x, glm::cross(to_light, x), to_light};
}

glm::dmat4 Cascades::clipFromWorld(const CascadeArea& area, int size, const glm::dvec3& eye) const {
    const glm::dvec3 origin = space.from(eye);
    const double scale = 2 / (area.texel * size), depth = 1 / (near - far);
    glm::dmat4 clip(0);
    for (int i = 0; i < 3; ++i)
        clip[i] = glm::dvec4(scale * space.x[i], scale * space.y[i], depth * space.z[i], 0);
    clip[3] = glm::dvec4(scale * (origin.x - area.corner.x) - 1, scale * (origin.y - area.corner.y) - 1,
                         depth * (origin.z - far), 1);
    return clip;
}

std::vector<double> splitDepths(double near, double far, int count) {
    std::vector<double> ends;
    for (int i = 1; i <= count; ++i) {
        const double fraction = static_cast<double>(i) / count;
        const double ratios = near * std::pow(far / near, fraction),
                     differences = near + (far - near) * fraction;
        ends.push_back(i == count ? far
                                  : logarithmicFraction * ratios + (1 - logarithmicFraction) * differences);
    }
    return ends;
}

Cascades fitCascades(const View& view, const Bounds& bounds, const glm::dvec3& to_light,
                     const CascadeRequest& request) {
    Cascades cascades{.space = lightSpace(to_light)};
    glm::dvec3 min(std::numeric_limits<double>::infinity()), max(-min);
    for (const glm::dvec3& corner : cornersOf(bounds)) {
        min = glm::min(min, cascades.space.from(corner));
        max = glm::max(max, cascades.space.from(corner));
    }
    // Margin for rounding, and a range that is not empty for flat scenes.
    const double room = 1e-4 * std::max({max.z - min.z, max.x - min.x, max.y - min.y, 1e-9});
    cascades.near = max.z + room;
    cascades.far = min.z - room;

    const double distance = request.distance > 0 ? request.distance : sceneExtent(view, bounds);
    double far = std::min(view.camera.far, distance), begin = 0, near = view.camera.near;
    if (request.shown) {
        // Margin for different float32 roundings of a view depth.
        constexpr double rounding = 1e-5;
        far = std::min(far, request.shown->far * (1 + rounding));
        begin = near = std::min(request.shown->near * (1 - rounding), far);
    } else {
        near = std::min(near, far / 2);
    }
    near = std::max(near, far * nearestFraction);
    const double inner = std::max(request.size - 2 * marginOf(request), 1.0);
    const double sceneSide = std::max(max.x - min.x, max.y - min.y) + 2 * room;
    for (const double end : splitDepths(near, far, request.count)) {
        CascadeArea area{.begin = begin, .end = end};
        const Sphere sphere = sphereOf(view, begin, end);
        const bool whole = sceneSide <= 2 * sphere.radius;
        const double side = whole ? sceneSide : 2 * sphere.radius;
        area.texel = side / inner;
        const glm::dvec2 centre =
            whole ? glm::dvec2(min + max) / 2.0 : glm::dvec2(cascades.space.from(sphere.centre));
        area.corner = (glm::floor(centre / area.texel) - request.size / 2.0) * area.texel;
        cascades.areas.push_back(area);
        begin = end - cascadeBlend * (end - begin);
    }
    return cascades;
}

gpu::ShadowLight gpuShadowLight(const Cascades& cascades, const View& view, gpu::uint light) {
    const double scale = 1 / (cascades.near - cascades.far);
    gpu::ShadowLight g{
        .x = cascades.space.x,
        .depth_scale = static_cast<float>(scale),
        .y = cascades.space.y,
        .depth_offset = static_cast<float>((cascades.space.from(view.eye()).z - cascades.far) * scale),
        .to_light = cascades.space.z,
        // Four units in the last place: depth of a position, position, depth in the map, and compared
        // depth.
        .rounding = 4 * std::numeric_limits<float>::epsilon(),
        .ends = glm::vec4(0),
        .fades = glm::vec4(0),
        .forward = -view.backward(),
        .light = light,
        .exponent = 0,
        .nearest = 0,
        .bleed = 0,
        .min_variance = 0,
        .negative = 0,
        .moment_bias = 0,
        .disc = 0,
        .widest = 0};
    for (std::size_t i = 0; i < cascades.areas.size(); ++i) {
        const CascadeArea& area = cascades.areas[i];
        const bool last = i + 1 == cascades.areas.size();
        const auto at = static_cast<glm::length_t>(i);
        g.ends[at] = static_cast<float>(area.end);
        g.fades[at] = static_cast<float>(last ? area.end : cascades.areas[i + 1].begin);
    }
    return g;
}

std::vector<gpu::Cascade> gpuCascades(const Cascades& cascades, const glm::dvec3& eye, double bias) {
    std::vector<gpu::Cascade> result;
    const glm::dvec2 origin(cascades.space.from(eye));
    for (const CascadeArea& area : cascades.areas)
        result.push_back({.offset = (origin - area.corner) / area.texel,
                          .texels_per_metre = static_cast<float>(1 / area.texel),
                          .bias = static_cast<float>(bias)});
    return result;
}

}  // namespace diptych
