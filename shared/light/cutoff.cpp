// SPDX-License-Identifier: MIT
#include "shared/light/cutoff.h"

#include "shared/contract/constants.h"
#include "shared/scene/lights/shadow_casters.h"
#include "shared/scene/motion/posed.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace diptych {

namespace {

double luminousIntensity(const Light& light) {
    return intensityFromAfar(light, strengthOf(light));
}

bool endless(const Light& light) {
    return light.kind != LightKind::directional && !std::isfinite(light.range);
}

struct SurfacePoint {
    glm::dvec3 position, normal;
    double area;  // m^2 that the point represents
};

struct WorldTriangle {
    glm::dvec3 a, b, c;
};

// `count` points distributed by area along the triangles in order; within a triangle by the R2 sequence
// (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences").
std::vector<SurfacePoint> surfacePoints(const Scene& scene, const Pose& pose, std::size_t count) {
    std::vector<WorldTriangle> triangles;
    std::vector<double> areas;  // running sum
    double area = 0;
    for (const Instance& instance : pose.instances) {
        const Primitive& primitive = primitiveOf(scene, instance);
        const std::vector<glm::dvec3> posed =
            instance.deformed() ? posedPositions(scene, pose, instance) : std::vector<glm::dvec3>();
        const auto world = [&](std::size_t i) {
            if (!posed.empty()) return posed[primitive.indices[i]];
            return glm::dvec3(instance.world_from_object *
                              glm::dvec4(primitive.positions[primitive.indices[i]], 1.0));
        };
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const WorldTriangle t{world(i), world(i + 1), world(i + 2)};
            const double own = 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
            if (!(own > 0) || !std::isfinite(own)) continue;
            triangles.push_back(t);
            areas.push_back(area += own);
        }
    }
    std::vector<SurfacePoint> points;
    if (triangles.empty()) return points;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * area;
        const auto found =
            std::min(static_cast<std::size_t>(std::ranges::lower_bound(areas, at) - areas.begin()),
                     triangles.size() - 1);
        const WorldTriangle& t = triangles[found];
        double whole, u = std::modf(0.7548776662466927 * static_cast<double>(i + 1), &whole),
                      v = std::modf(0.5698402909980532 * static_cast<double>(i + 1), &whole);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        points.push_back({t.a + (t.b - t.a) * u + (t.c - t.a) * v,
                          glm::normalize(glm::cross(t.b - t.a, t.c - t.a)),
                          area / static_cast<double>(count)});
    }
    return points;
}

// Fraction of a light's largest intensity in a direction, 0 to 1.
double shape(const Light& light, const glm::dvec3& direction, const LightFalloff& falloff) {
    const double c = glm::dot(direction, light.direction);
    if (light.kind == LightKind::spot) {
        const double outer = std::cos(double{light.outer_cone});
        const double inner = std::cos(double{light.inner_cone});
        return falloff.cone((c - outer) / std::max(inner - outer, 0.001));
    }
    if (isArea(light.kind) && !isClosed(light.kind)) return light.two_sided ? std::abs(c) : std::max(c, 0.0);
    return 1;
}

}  // namespace

double cutoffRange(const Light& light, double cutoff) {
    return std::sqrt(luminousIntensity(light) / (std::numbers::pi * cutoff));
}

std::vector<Light> withCutoff(std::vector<Light> lights, double cutoff) {
    if (cutoff > 0)
        for (Light& light : lights)
            if (endless(light)) light.range = static_cast<float>(cutoffRange(light, cutoff));
    return lights;
}

double energyCut(const Scene& scene, const Pose& pose, std::span<const Light> lights, double cutoff,
                 const LightFalloff& falloff) {
    if (!(cutoff > 0) || std::ranges::none_of(lights, endless)) return 0;
    double all = 0, kept = 0;
    for (const SurfacePoint& point : surfacePoints(scene, pose, 4096))
        for (const Light& light : lights) {
            if (!endless(light)) continue;
            const glm::dvec3 to = light.position - point.position;
            const double d2 = std::max(glm::dot(to, to), double{gpu::MIN_LIGHT_DISTANCE_SQUARED});
            const glm::dvec3 direction = to / std::sqrt(d2);
            const double flux = luminousIntensity(light) * shape(light, -direction, falloff) *
                                std::abs(glm::dot(point.normal, direction)) / d2 * point.area;
            const double range = cutoffRange(light, cutoff);
            all += flux;
            kept += flux * falloff.window(d2 / (range * range));
        }
    return all > 0 ? 1 - kept / all : 0;
}

}  // namespace diptych
