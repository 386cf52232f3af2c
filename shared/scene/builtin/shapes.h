// SPDX-License-Identifier: MIT
// Shapes for the built-in scenes, in object space, m. Front faces are counter-clockwise seen from outside.
// Every vertex has a unit normal and a unit tangent towards growing u, with w = +1. So w * cross(normal,
// tangent) points towards falling v, the top of the image, as glTF normal textures require.
#pragma once

#include "shared/scene/model/scene.h"

#include <functional>
#include <vector>

namespace diptych {

// A parallelogram, seen from the side where `right` points right and `up` up. u and v run from 0 to 1, v =
// 0 on top. Has `columns` x `rows` cells of two triangles each.
Primitive quad(const glm::dvec3& corner, const glm::dvec3& right, const glm::dvec3& up, int columns = 1,
               int rows = 1);

// Centred at the origin. u runs once around, v from pole to pole. Has 2 * segments * (rings - 1)
// triangles.
Primitive sphere(double radius, int segments = 48, int rings = 24);

// Centred at the origin; texture coordinates are in metres on every face. Edges are bevelled by `bevel`
// metres, with smooth normals.
Primitive box(const glm::dvec3& size, double bevel = 0.0);

// Rotates a profile of (radius, height) about +Y. The profile runs upwards along the outside. u runs once
// around, v along the profile, 0 at its end. Corners of more than 40 degrees stay sharp.
Primitive lathe(const std::vector<glm::dvec2>& profile, int segments = 48);

// A tube of `radius` around a closed curve with parameter [0, 1). u runs once along the curve, v once
// around it.
Primitive tube(const std::function<glm::dvec3(double)>& curve, double radius, int segments, int sides);
Primitive torus(double ring, double radius, int segments = 64, int sides = 20);  // about +Y
Primitive torusKnot(int p, int q, double ring, double hole, double radius);

// A gem with an approximate brilliant cut: flat facets, tip at the bottom, height about 0.86 of the width.
Primitive gem(double width, int sides = 12);

// A wall from x = -width / 2 to width / 2, y = 0 to height, z = -depth to 0. The opening in its middle is
// `opening` m wide and ends in a half circle above y = `spring`. Back, bottom and outer sides are missing.
// Texture coordinates are in metres.
Primitive archway(double width, double height, double depth, double opening, double spring,
                  int segments = 24);

void append(Primitive& whole, const Primitive& part, const glm::dmat4& wholeFromPart = glm::dmat4(1.0));
Primitive scaleTexcoords(Primitive shape, double u, double v);
// Adds a second UV set: the first, rotated by 90 degrees. So use of the wrong set becomes visible.
Primitive withTurnedSet(Primitive shape);
Primitive paint(Primitive shape, const std::function<glm::vec4(const glm::vec3& position)>& color);

}  // namespace diptych
