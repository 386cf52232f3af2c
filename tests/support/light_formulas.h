// SPDX-License-Identifier: MIT
// Closed forms of the light that arrives from each kind of light. They share nothing with the reference or
// the shaders.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace diptych {

// KHR_lights_punctual (Khronos 2019), attenuation by the range; distances in m.
inline double punctualWindow(double distance, double range) {
    return std::clamp(1 - std::pow(distance / range, 4), 0.0, 1.0);
}

// KHR_lights_punctual (Khronos 2019), a spot's cone between its two angles, rad. The lower limit keeps a cone
// with a hard edge finite.
inline double coneScale(double inner, double outer) {
    return 1 / std::max(0.001, std::cos(inner) - std::cos(outer));
}
// The factor before it is squared.
inline double coneFactor(double inner, double outer, double cosine) {
    return std::clamp((cosine - std::cos(outer)) * coneScale(inner, outer), 0.0, 1.0);
}

// Lambert's formula for the irradiance of a polygon of radiance 1 seen from the origin, clipped to the
// horizon. Half the sum over its edges of the subtended angle times the cosine of the edge plane's normal
// (Lambert 1760, "Photometria"; Baum, Rushmeier and Winget 1989). Valid for the outline of any convex
// body, planar or not.
inline double lambertIrradiance(const std::vector<glm::dvec3>& outline, const glm::dvec3& n) {
    std::vector<glm::dvec3> above;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec3 p = outline[i], q = outline[(i + 1) % outline.size()];
        const double hp = glm::dot(p, n), hq = glm::dot(q, n);
        if (hp >= 0) above.push_back(p);
        if ((hp < 0) != (hq < 0)) above.push_back((p * hq - q * hp) / (hq - hp));
    }
    double sum = 0;
    for (std::size_t i = 0; i < above.size(); ++i) {
        const glm::dvec3 p = above[i], q = above[(i + 1) % above.size()], across = glm::cross(p, q);
        const double size = glm::length(across);
        if (size > 0) sum += std::atan2(size, glm::dot(p, q)) * glm::dot(across, n) / size;
    }
    return std::abs(sum) / 2;
}

inline glm::dvec3 anyAcross(const glm::dvec3& direction) {
    const glm::dvec3 other = std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    return glm::normalize(glm::cross(other, direction));
}

// An arc as a polygon. Its relative area error is (angle / corners)^2 / 6, below 2e-8.
inline void addArc(std::vector<glm::dvec3>& outline, const glm::dvec3& centre, const glm::dvec3& x,
                   const glm::dvec3& y, double from, double to) {
    constexpr int corners = 20000;
    for (int i = 0; i <= corners; ++i) {
        const double t = from + (to - from) * i / corners;
        outline.push_back(centre + x * std::cos(t) + y * std::sin(t));
    }
}

// Outline of an area light or of a sun's disc seen from the origin. A tube's outline has two lines along its
// side and, at each end, half a rim: the far half if the end's face is visible, otherwise the near half.
// From beyond an end, within the tube's radius, it is that end's rim.
inline std::vector<glm::dvec3> outlineOf(const Light& light) {
    constexpr double whole = 2 * std::numbers::pi;
    const glm::dvec3 c = light.position;
    const double radius = double{light.radius};
    std::vector<glm::dvec3> outline;
    if (light.kind == LightKind::rect) {
        const glm::dvec3 x = light.axis * (double{light.width} / 2);
        const glm::dvec3 y = glm::cross(light.direction, light.axis) * (double{light.height} / 2);
        return {c - x - y, c + x - y, c + x + y, c - x + y};
    }
    if (light.kind == LightKind::disc || light.kind == LightKind::directional) {
        const bool sun = light.kind == LightKind::directional;
        const double size = sun ? std::tan(double{light.angle} / 2) : radius;
        const glm::dvec3 x = anyAcross(light.direction) * size;
        addArc(outline, sun ? -light.direction : c, x, glm::cross(light.direction, x), 0, whole);
        return outline;
    }
    const glm::dvec3 axis = light.axis, half = axis * (double{light.length} / 2);
    const double along = -glm::dot(c, axis);
    const glm::dvec3 out = -c - axis * along;
    const double distance = glm::length(out);
    const glm::dvec3 x = (distance > 0 ? out / distance : anyAcross(axis)) * radius, y = glm::cross(axis, x);
    const bool above = along > double{light.length} / 2, below = -along > double{light.length} / 2;
    if (distance <= radius) {
        if (above || below) addArc(outline, above ? c + half : c - half, x, y, 0, whole);
        return outline;
    }
    const double angle = std::acos(radius / distance);
    addArc(outline, c + half, x, y, above ? whole - angle : -angle, angle);
    addArc(outline, c - half, x, y, angle, below ? whole - angle : -angle);
    return outline;
}

// Area of an area light as seen from afar along the unit vector l, m^2.
inline double apparentArea(const Light& light, const glm::dvec3& l) {
    const double r = double{light.radius}, cosine = std::abs(glm::dot(l, light.direction));
    if (light.kind == LightKind::rect) return double{light.width} * double{light.height} * cosine;
    if (light.kind == LightKind::disc) return std::numbers::pi * r * r * cosine;
    const double along = std::abs(glm::dot(l, light.axis));
    return 2 * r * double{light.length} * std::sqrt(1 - along * along) + std::numbers::pi * r * r * along;
}

// Irradiance of a light of any kind at the origin on a surface with the unit normal n.
inline double irradianceFrom(const Light& light, const glm::dvec3& n) {
    const double distance = glm::length(light.position);
    const double strength = double{light.intensity} * punctualWindow(distance, double{light.range});
    if (light.kind == LightKind::directional) {
        // A disc wholly above the horizon has the irradiance of its centre.
        const double up = -glm::dot(light.direction, n), edge = double{light.angle} / 2;
        if (std::asin(std::clamp(up, -1.0, 1.0)) >= edge) return strength * up;
        if (edge == 0) return 0;
        return strength * lambertIrradiance(outlineOf(light), n) /
               (std::numbers::pi * std::pow(std::sin(edge), 2));
    }
    if (isArea(light.kind)) {
        const bool back = glm::dot(light.position, light.direction) >= 0;
        if (!isClosed(light.kind) && !light.two_sided && back) return 0;
        return strength * lambertIrradiance(outlineOf(light), n);
    }
    if (distance == 0) return 0;
    const glm::dvec3 l = light.position / distance;
    const double cone =
        light.kind == LightKind::point
            ? 1
            : coneFactor(double{light.inner_cone}, double{light.outer_cone}, -glm::dot(l, light.direction));
    return strength * cone * cone * std::max(glm::dot(l, n), 0.0) / (distance * distance);
}

}  // namespace diptych
