// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/lights/light_overlap.glsl"
#include "tests/probe/shaders/probe.glsl"

// bound (12), a cell's sides x, y and depths (6) -> whether the bounding sphere reaches the cell, whether
// the cone does, whether the sphere reaches the cell's row
void main() {
    if (PROBE_ROW >= probe_rows) return;
    LightBound bound;
    bound.centre = IN3(18, 0);
    bound.radius = IN(18, 3);
    bound.apex = IN3(18, 4);
    bound.cos_cone = IN(18, 7);
    bound.axis = IN3(18, 8);
    bound.sin_cone = IN(18, 11);
    CellBounds cell =
        CellBounds(vec2(IN(18, 12), IN(18, 13)), vec2(IN(18, 14), IN(18, 15)), vec2(IN(18, 16), IN(18, 17)));
    OUT(3, 0) = sphereOverlaps(bound.centre, bound.radius, cell) ? 1.0 : 0.0;
    OUT(3, 1) = coneOverlaps(bound, cell) ? 1.0 : 0.0;
    OUT(3, 2) = squaredDistanceToRow(bound.centre, cell) <= bound.radius * bound.radius ? 1.0 : 0.0;
}
