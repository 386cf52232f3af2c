// SPDX-License-Identifier: MIT
#include "compare/reference/light/area.h"

#include "shared/scene/model/axes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace diptych::reference {
namespace {

using std::numbers::pi;

// Clips to the half-space n.p > 0 (Sutherland and Hodgman 1974, "Reentrant Polygon Clipping").
std::vector<glm::dvec3> aboveHorizon(const std::array<glm::dvec3, 4>& corners, const glm::dvec3& n) {
    std::vector<glm::dvec3> polygon;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 &p = corners[i], &q = corners[(i + 1) % 4];
        const double a = glm::dot(n, p), b = glm::dot(n, q);
        if (a > 0) polygon.push_back(p);
        if ((a > 0) != (b > 0)) polygon.push_back(p + (q - p) * (a / (a - b)));
    }
    return polygon;
}

// The normal of the flat light's side that faces the origin and emits; zero if there is none.
glm::dvec3 shiningSide(const Emitter& light, const glm::dvec3& centre) {
    const double side = -glm::dot(light.direction, centre);
    if (side > 0) return light.direction;
    return light.two_sided && side < 0 ? -light.direction : glm::dvec3(0);
}

void addRect(std::vector<Patch>& patches, const Emitter& light, const glm::dvec3& centre,
             const glm::dvec3& n) {
    const glm::dvec3 normal = shiningSide(light, centre);
    if (normal == glm::dvec3(0)) return;
    const glm::dvec3 x = light.axis * light.width;
    const glm::dvec3 y = glm::cross(light.direction, light.axis) * light.height;
    const glm::dvec3 corner = centre - (x + y) * 0.5;
    const std::array corners{corner, corner + x, corner + x + y, corner + y};
    const std::vector<glm::dvec3> polygon = aboveHorizon(corners, n);
    if (polygon.size() == 4 && std::equal(polygon.begin(), polygon.end(), corners.begin()))
        return patches.push_back(Patch::parallelogram(corner, x, y, normal));
    for (std::size_t i = 2; i < polygon.size(); ++i)
        patches.push_back(Patch::triangle(polygon[0], polygon[i - 1], polygon[i], normal));
}

void addDisc(std::vector<Patch>& patches, const glm::dvec3& centre, const glm::dvec3& normal, double radius,
             const glm::dvec3& n) {
    // x is the direction in the disc that rises fastest over the horizon: n.(centre + s radius x) = height
    // + s rise.
    const glm::dvec3 along = n - glm::dot(n, normal) * normal;
    const glm::dvec3 x = unitOr(along, perpendicularTo(normal));
    const double height = glm::dot(n, centre), rise = glm::dot(n, x) * radius;
    const double from = rise > 0 ? std::max(-height / rise, -1.0) : height > 0 ? -1.0 : 1.0;
    if (from < 1) patches.push_back(Patch::disc(centre, x, glm::cross(normal, x), normal, radius, from));
}

void addTube(std::vector<Patch>& patches, const Emitter& light, const glm::dvec3& centre,
             const glm::dvec3& n) {
    const glm::dvec3 axis = light.axis;
    const double radius = light.radius, length = light.length;
    const double along = -glm::dot(centre, axis);  // origin's position along the axis, from the centre
    for (const double end : {-1.0, 1.0})
        if (end * along > length / 2)
            addDisc(patches, centre + axis * (end * length / 2), axis * end, radius, n);
    const glm::dvec3 towards = -centre - axis * along;  // from the axis to the origin
    const double distance = glm::length(towards);
    if (!(distance > radius)) return;
    // The origin sees the side within acos(radius / distance) of the direction towards it.
    const glm::dvec3 x = towards / distance;
    const double half = std::acos(radius / distance);
    patches.push_back(Patch::tube(light, centre, x, half, n));
}

}  // namespace

Patch Patch::triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                      const glm::dvec3& normal) {
    Patch patch;
    patch.shape_ = Shape::triangle;
    patch.origin_ = a;
    patch.x_ = b - a;
    patch.y_ = c - b;
    patch.normal_ = normal;
    patch.a_ = glm::length(glm::cross(patch.x_, patch.y_));
    return patch;
}

Patch Patch::parallelogram(const glm::dvec3& corner, const glm::dvec3& x, const glm::dvec3& y,
                           const glm::dvec3& normal) {
    Patch patch = triangle(corner, corner + x, corner + x + y, normal);
    patch.shape_ = Shape::parallelogram;
    return patch;
}

Patch Patch::disc(const glm::dvec3& centre, const glm::dvec3& x, const glm::dvec3& y,
                  const glm::dvec3& normal, double radius, double from) {
    Patch patch;
    patch.shape_ = Shape::disc;
    patch.origin_ = centre;
    patch.x_ = x;
    patch.y_ = y;
    patch.normal_ = normal;
    patch.radius_ = radius;
    patch.a_ = std::asin(std::clamp(from, -1.0, 1.0));
    patch.b_ = pi / 2;
    return patch;
}

Patch Patch::tube(const Emitter& light, const glm::dvec3& centre, const glm::dvec3& x, double half,
                  const glm::dvec3& n) {
    Patch patch = disc(centre, x, glm::cross(light.axis, x), light.axis, light.radius, 0);
    patch.shape_ = Shape::tube;
    patch.length_ = light.length;
    patch.a_ = -half;
    patch.b_ = half;
    patch.n_ = n;
    return patch;
}

Patch::Point Patch::at(double u, double v) const {
    switch (shape_) {
        case Shape::triangle:  // Duffy 1982: the edge u = 0 collapses to the first corner
            return {origin_ + u * (x_ + v * y_), normal_, a_ * u};
        case Shape::parallelogram:
            return {origin_ + u * x_ + v * y_, normal_, a_};
        case Shape::disc: {
            // Chords at s = sin t with half length cos t: the parametrisation is smooth up to the rim.
            const double t = a_ + (b_ - a_) * u, cosine = std::cos(t);
            return {origin_ + (x_ * std::sin(t) + y_ * (cosine * (2 * v - 1))) * radius_, normal_,
                    (b_ - a_) * 2 * radius_ * radius_ * cosine * cosine};
        }
        case Shape::tube:
            break;
    }
    // Along the axis from one end to the other, clipped by the horizon.
    const double t = a_ + (b_ - a_) * u;
    const glm::dvec3 out = x_ * std::cos(t) + y_ * std::sin(t);
    double low = -length_ / 2, high = length_ / 2;
    const double height = glm::dot(n_, origin_ + out * radius_), rise = glm::dot(n_, normal_);
    if (rise > 0) low = std::max(low, -height / rise);
    if (rise < 0) high = std::min(high, -height / rise);
    if (!(high > low) || (rise == 0 && height <= 0)) return {origin_, out, 0};
    return {origin_ + out * radius_ + normal_ * (low + (high - low) * v), out,
            radius_ * (b_ - a_) * (high - low)};
}

Emitter emitterOf(const Light& light, const glm::dvec3& origin) {
    Emitter emitter{.shape = light.kind,
                    .two_sided = light.two_sided,
                    .centre = light.position - origin,
                    .direction = light.direction,
                    .axis = light.axis,
                    .width = light.width,
                    .height = light.height,
                    .radius = light.radius,
                    .length = light.length,
                    .range = light.range,
                    .radiance = glm::dvec3(light.color) * double{light.intensity}};
    if (light.kind != LightKind::directional) return emitter;
    const double half = std::min(double{light.angle}, 3.14) / 2;  // at pi the disc would be infinite
    emitter.shape = LightKind::disc;
    emitter.far = true;
    emitter.centre = -light.direction;
    emitter.radius = std::tan(half);
    emitter.range = std::numeric_limits<double>::infinity();
    emitter.radiance /= pi * std::pow(std::sin(half), 2);
    return emitter;
}

std::vector<Patch> visiblePatches(const Emitter& emitter, const glm::dvec3& centre, const glm::dvec3& n) {
    std::vector<Patch> patches;
    if (emitter.shape == LightKind::rect)
        addRect(patches, emitter, centre, n);
    else if (emitter.shape == LightKind::tube)
        addTube(patches, emitter, centre, n);
    else if (const glm::dvec3 side = shiningSide(emitter, centre); side != glm::dvec3(0))
        addDisc(patches, centre, side, emitter.radius, n);
    return patches;
}

}  // namespace diptych::reference
