// SPDX-License-Identifier: MIT
// Area lights and suns with an angular size: the visible part of each, as patches with two parameters.
#pragma once

#include "compare/reference/scattering/surface.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <vector>

namespace diptych::reference {

// A rectangle, disc or tube; or the disc of a directional light with an angular size, always one metre
// away.
struct Emitter {
    LightKind shape = LightKind::rect;  // rect, disc or tube
    bool far = false;                   // a directional light: `centre` is relative to the lit surface
    bool two_sided = false;
    glm::dvec3 centre{0}, direction{0, 0, -1}, axis{1, 0, 0};
    double width = 0, height = 0, radius = 0, length = 0, range = 0;  // m
    glm::dvec3 radiance{0};  // W/(sr m^2), before the factor rangeWindow()
};

// The part of a light's surface above the horizon of the lit surface. Positions are relative to the lit
// surface.
class Patch {
public:
    // A point of the patch, with its area element dA / (du dv), m^2.
    struct Point {
        glm::dvec3 position, normal;  // the normal is unit
        double area;
    };
    Point at(double u, double v) const;

    static Patch triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                          const glm::dvec3& normal);
    static Patch parallelogram(const glm::dvec3& corner, const glm::dvec3& x, const glm::dvec3& y,
                               const glm::dvec3& normal);
    // The part of a disc beyond a chord: from `from` to 1, in radii along `x` from the centre; -1 is the
    // whole disc.
    static Patch disc(const glm::dvec3& centre, const glm::dvec3& x, const glm::dvec3& y,
                      const glm::dvec3& normal, double radius, double from);
    // The part of a tube's side within the angle `half` around its axis from `x`, where n.p > 0.
    static Patch tube(const Emitter& light, const glm::dvec3& centre, const glm::dvec3& x, double half,
                      const glm::dvec3& n);

private:
    enum class Shape { triangle, parallelogram, disc, tube };
    Shape shape_ = Shape::triangle;
    glm::dvec3 origin_{0}, x_{0}, y_{0}, normal_{0}, n_{0};
    double a_ = 0, b_ = 0, radius_ = 0, length_ = 0;
};

// Positions become relative to `origin`. A sun's radiance L follows from its illuminance E on a surface
// that faces it: E = pi L sin^2(angle / 2).
Emitter emitterOf(const Light& light, const glm::dvec3& origin);

// The patches of the emitter that light a surface at the origin with normal `n`; may be empty. `centre`:
// the emitter's, relative to the surface.
std::vector<Patch> visiblePatches(const Emitter& emitter, const glm::dvec3& centre, const glm::dvec3& n);

}  // namespace diptych::reference
