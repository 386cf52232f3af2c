// SPDX-License-Identifier: MIT
// Whether a light is felt in a cell: never no where it is, seldom yes where it is not. View axes: x right, y down,
// z forward.
#ifndef LIGHT_CULL_GLSL
#define LIGHT_CULL_GLSL

#include "shaders/lib/light_grid.glsl"

// What is left of a ball behind a plane through the camera with the normal (a, 0, b) in two of the axes is within
// the smaller ball around its centre's foot on the plane. `outside`: how far the centre is beyond the plane.
void cutBall(float outside, vec2 normal, inout vec2 centre, inout float squared) {
    float d = max(outside, 0.0);
    centre -= normal * d;
    squared -= d * d;
}

// The two planes x = sides * z of a cell; what is outside of one is inside of the other.
void cutBySides(vec2 sides, inout vec2 centre, inout float squared) {
    vec2 lengths = inversesqrt(1.0 + sides * sides);
    float before = (sides.x * centre.y - centre.x) * lengths.x;
    float behind = (centre.x - sides.y * centre.y) * lengths.y;
    bool left = before > behind;
    vec2 normal = left ? vec2(-1.0, sides.x) * lengths.x : vec2(1.0, -sides.y) * lengths.y;
    cutBall(left ? before : behind, normal, centre, squared);
}

// A ball against a cell, one pair of planes after the other (Persson 2013, "Practical Clustered Shading", does so
// row by row): exact for a box, for a froxel it may only err towards yes.
bool ballReaches(vec3 centre, float radius, CellBounds cell) {
    if (cell.depth.x > cell.depth.y) return false;
    float squared = radius * radius;
    float foot = clamp(centre.z, cell.depth.x, cell.depth.y);
    squared -= (centre.z - foot) * (centre.z - foot);
    centre.z = foot;
    if (on(feature_orthographic)) {
        vec2 beyond = max(max(vec2(cell.x.x, cell.y.x) - centre.xy, centre.xy - vec2(cell.x.y, cell.y.y)), 0.0);
        return squared >= dot(beyond, beyond);
    }
    vec2 yz = centre.yz;
    cutBySides(cell.y, yz, squared);
    vec2 xz = vec2(centre.x, yz.y);
    cutBySides(cell.x, xz, squared);
    return squared >= 0.0;
}

// A cone against the sphere around a cell (Wronski 2017, "Cull that cone!"): the sphere is outside where it is
// farther from the cone's side than its radius.
bool coneReachesSphere(LightBound light, vec3 centre, float radius) {
    vec3 v = centre - light.apex;
    float along = dot(v, light.axis);
    float across = sqrt(max(dot(v, v) - along * along, 0.0));
    return light.cos_cone * across - along * light.sin_cone <= radius;
}

// The cone, of any length, has a point on the inner side of a plane through `point`, whose `normal` points
// outwards: the apex, or else a direction within the cone that leads there.
bool coneReachesPlane(LightBound light, vec3 point, vec3 normal) {
    float outside = dot(light.apex - point, normal);
    // The largest cosine between the normal's opposite and a direction of the cone.
    float c = -dot(light.axis, normal), s = sqrt(max(1.0 - c * c, 0.0));
    float inward = c >= light.cos_cone ? 1.0 : c * light.cos_cone + s * light.sin_cone;
    return outside <= 0.0 || inward > -1e-6;
}

bool coneReaches(LightBound light, CellBounds cell) {
    if (light.cos_cone <= -1.0) return true;
    // Around the light itself float32 tells no directions apart: what rounding moves is within the bounds' slack.
    float far = min(cell.depth.y, light.centre.z + light.radius), near = max(cell.depth.x, light.centre.z - light.radius);
    vec2 z = on(feature_orthographic) ? vec2(1.0) : vec2(near, far);
    vec3 low = vec3(min(cell.x.x * z.x, cell.x.x * z.y), min(cell.y.x * z.x, cell.y.x * z.y), near);
    vec3 high = vec3(max(cell.x.y * z.x, cell.x.y * z.y), max(cell.y.y * z.x, cell.y.y * z.y), far);
    vec3 centre = 0.5 * (low + high);
    float radius = length(high - centre);
    float slack = 4e-6 * (length(centre) + length(light.apex)) + 1e-5 * radius;
    if (!coneReachesSphere(light, centre, radius + slack)) return false;
    return coneReachesPlane(light, vec3(0.0, 0.0, near - slack), vec3(0.0, 0.0, -1.0)) &&
           coneReachesPlane(light, vec3(0.0, 0.0, far + slack), vec3(0.0, 0.0, 1.0));
}

bool reaches(LightBound light, CellBounds cell) {
    return ballReaches(light.centre, light.radius, cell) && (!on(feature_spot_lights) || coneReaches(light, cell));
}

#endif
