// SPDX-License-Identifier: MIT
// Shapes for the built-in scenes, in object space, metres. Front faces are counter-clockwise seen from
// outside. Every vertex has a unit normal, a unit tangent along growing u and w = +1: w * cross(normal,
// tangent) points towards falling v, to the top of the image, as a glTF normal texture wants it.
#pragma once

#include "shared/scene/model/scene.h"

#include <functional>
#include <vector>

namespace diptych {

// A parallelogram, seen from the side where `right` points right and `up` up; u and v run from 0 to 1, v = 0
// on top. It has `columns` x `rows` cells of two triangles.
Primitive quad(const glm::dvec3& corner, const glm::dvec3& right, const glm::dvec3& up, int columns = 1,
               int rows = 1);

// Centred at the origin; u runs once around, v from pole to pole. 2 * segments * (rings - 1) triangles.
Primitive sphere(double radius, int segments = 48, int rings = 24);

// Centred at the origin; texture coordinates in metres on every face. Edges are bevelled by `bevel` metres
// with smooth normals.
Primitive box(const glm::dvec3& size, double bevel = 0.0);

// Rotates a profile of (radius, height), listed upwards along the outside, about +Y: u runs once around, v
// along the profile, 0 at its end. Corners of more than 40 degrees keep a sharp edge.
Primitive lathe(const std::vector<glm::dvec2>& profile, int segments = 48);

// A tube of `radius` around a closed curve with parameter [0, 1): u runs once along it, v once around.
Primitive tube(const std::function<glm::dvec3(double)>& curve, double radius, int segments, int sides);
Primitive torus(double ring, double radius, int segments = 64, int sides = 20);  // about +Y
Primitive torusKnot(int p, int q, double ring, double hole, double radius, int segments = 256,
                    int sides = 20);

// A gem similar to a brilliant cut: flat facets, the point down, height about 0.86 of the width.
Primitive gem(double width, int sides = 12);

// A wall from x = -width / 2 to width / 2, y = 0 to height, z = -depth to 0, with an opening of width
// `opening` (m) in its middle that ends in a half circle above y = `spring`. It has no back, bottom or outer
// sides; texture coordinates in metres.
Primitive archway(double width, double height, double depth, double opening, double spring,
                  int segments = 24);

void append(Primitive& whole, const Primitive& part, const glm::dmat4& wholeFromPart = glm::dmat4(1.0));
Primitive scaleTexcoords(Primitive shape, double u, double v);
Primitive paint(Primitive shape, const std::function<glm::vec4(const glm::vec3& position)>& color);

}  // namespace diptych
