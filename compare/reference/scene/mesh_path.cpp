// SPDX-License-Identifier: MIT
#include "compare/reference/scene/mesh_path.h"

#include "compare/reference/scattering/microsurface.h"
#include "compare/reference/scattering/transmission.h"
#include "shared/scene/model/axes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::reference {
namespace {

// Start of a ray, relative to the distance from the camera: as of shadow rays.
constexpr double ray_start = 1e-9;

}  // namespace

glm::dvec3 MeshPaths::facetOf(const Boundary& b, const glm::dvec3& along, Random& random) {
    if (!(b.roughness > min_roughness)) return b.normal;
    const glm::dvec3 x = perpendicularTo(b.normal), y = glm::cross(b.normal, x), back = -along;
    const glm::dvec3 from(glm::dot(x, back), glm::dot(y, back), glm::dot(b.normal, back));
    if (!(from.z > 0)) return b.normal;
    const glm::dvec3 h = Microsurface(b.roughness * b.roughness).visibleNormal(from, random);
    return glm::normalize(x * h.x + y * h.y + b.normal * h.z);
}

// The geometric normal replaces one that would send the ray to the wrong side.
glm::dvec3 MeshPaths::entered(const Boundary& b, const glm::dvec3& along, double index, Random& random) {
    const glm::dvec3 n = facetOf(b, along, random);
    if (glm::dot(n, along) < 0) {
        const glm::dvec3 d = refractedInto(along, n, index);
        if (glm::dot(d, b.geometric_normal) < 0) return d;
    }
    return refractedInto(along, b.geometric_normal, index);
}

MeshPaths::Branch MeshPaths::branched(const Boundary& b, const glm::dvec3& along, double index,
                                      Random& random) {
    glm::dvec3 n = facetOf(b, along, random);
    if (!(glm::dot(n, along) < 0)) n = b.geometric_normal;
    const double chance = random();
    for (const glm::dvec3& normal : {n, b.geometric_normal}) {
        const bool reflects = chance < reflectedInside(-glm::dot(normal, along), index);
        const std::optional<glm::dvec3> out = reflects ? std::nullopt : refractedOut(along, normal, index);
        const glm::dvec3 d = out ? *out : along - normal * (2 * glm::dot(normal, along));
        if ((glm::dot(d, b.geometric_normal) < 0) == out.has_value()) return {d, out.has_value()};
    }
    return {along - b.geometric_normal * (2 * glm::dot(b.geometric_normal, along)), false};
}

bool MeshPaths::isSameMesh(const TriangleId& a, const TriangleId& b) const {
    const Instance &one = geometry_.instance(a), &other = geometry_.instance(b);
    return one.node == other.node && one.copy == other.copy;
}

std::optional<Hit> MeshPaths::next(const Ray& ray, const TriangleId& entry) const {
    return geometry_.nearest(ray, [&](const Hit& hit) {
        if (!materials_.blends(hit)) return materials_.isThere(hit, nullptr);
        return materials_.transmits(hit) && !hit.front && isSameMesh(hit.id, entry) &&
               !materials_.isHole(hit);
    });
}

std::optional<MeshPaths::End> MeshPaths::operator()(const Hit& entry, const Surface& surface, double index,
                                                    Random& random) const {
    End path;
    path.origin = entry.position;
    path.without = entry.id;
    path.direction = entered({surface.normal, surface.geometric_normal, surface.roughness},
                             -surface.to_viewer, index, random);
    for (int event = 0;; ++event) {
        path.from = ray_start * glm::length(path.origin);
        const Ray ray{path.origin, path.direction, path.from, std::numeric_limits<double>::infinity(),
                      path.without};
        const std::optional<Hit> hit = next(ray, entry.id);
        if (!hit) return path;
        path.length += hit->t;
        if (!materials_.blends(*hit)) return path;
        if (event == maxEvents) return {};
        const Surface at = materials_.surface(*hit, {hit->position, path.direction});
        const auto [direction, leaves] =
            branched({at.normal, at.geometric_normal, at.roughness}, path.direction, index, random);
        path.origin = hit->position;
        path.direction = direction;
        path.without = hit->id;
        if (!leaves) continue;
        path.from = ray_start * glm::length(path.origin);
        return path;
    }
}

}  // namespace diptych::reference
