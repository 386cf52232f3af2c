// SPDX-License-Identifier: MIT
// Lights with extent: the part of each that a surface sees, as patches with two parameters.
#pragma once

#include "compare/reference/surface.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <vector>

namespace diptych::reference {

// A piece of a light above the horizon of the surface that it lights; positions are relative to that surface.
class Patch {
public:
    // One point of it and what dA it stands for, m^2 per unit of u v.
    struct Point {
        glm::dvec3 place, normal;  // the normal is unit
        double area;
    };
    Point at(double u, double v) const;

    static Patch triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                          const glm::dvec3& normal);
    static Patch parallelogram(const glm::dvec3& corner, const glm::dvec3& x, const glm::dvec3& y,
                               const glm::dvec3& normal);
    // A disc, or what lies beyond a chord of it: from `from` to 1 radius along `x` from the centre.
    static Patch disc(const glm::dvec3& centre, const glm::dvec3& x, const glm::dvec3& y,
                      const glm::dvec3& normal, double radius, double from);
    // A cylinder's side between two angles around `axis`, where n.p > 0.
    static Patch cylinder(const glm::dvec3& centre, const glm::dvec3& axis, const glm::dvec3& x,
                          const glm::dvec3& y, double radius, double length, double from, double to,
                          const glm::dvec3& n);

private:
    enum class Shape { triangle, parallelogram, disc, cylinder };
    Shape shape_ = Shape::triangle;
    glm::dvec3 origin_{0}, x_{0}, y_{0}, normal_{0}, n_{0};
    double a_ = 0, b_ = 0, radius_ = 0, length_ = 0;
};

// A rectangle, disc or tube, or the disc that a directional light with an angle is: seen from everywhere at
// the same place, a metre away.
struct Emitter {
    LightKind shape = LightKind::rect;  // rect, disc or tube
    bool far = false;                   // a sun: `centre` is relative to whatever it lights
    bool two_sided = false;
    glm::dvec3 centre{0}, direction{0, 0, -1}, axis{1, 0, 0};
    double width = 0, height = 0, radius = 0, length = 0, range = 0;  // m
    glm::dvec3 radiance{0};  // W/(sr m^2), before the window of its range
};

// `origin` becomes the origin. A sun's illuminance on what faces it is E = pi L sin^2(angle / 2).
Emitter emitterOf(const Light& light, const glm::dvec3& origin);

// What of it shines on a surface with the normal `n` at the origin; `centre` is the emitter's, from there.
// Empty where nothing does.
std::vector<Patch> visiblePatches(const Emitter& emitter, const glm::dvec3& centre, const glm::dvec3& n);

}  // namespace diptych::reference
