// SPDX-License-Identifier: MIT
// Whether a light can affect a cell of the light grid. Conservative: no false negatives, few false
// positives. View axes: x right, y down, z forward.
#ifndef LIGHT_OVERLAP_GLSL
#define LIGHT_OVERLAP_GLSL

#include "shaders/lib/lights/light_grid.glsl"

// The side of a cell (at side * z for depth z) that `centre` lies beyond along one axis; 0 if it lies
// between both.
float sideBeyond(const vec2 sides, const float centre, const float z) {
    return centre < sides.x * z ? sides.x : centre > sides.y * z ? sides.y : 0.0;
}
// Signed distance of `centre` beyond the nearer side at depth z, m; 0 between the sides.
float beyondSides(const vec2 sides, const float centre, const float z) {
    return min(centre - sides.x * z, 0.0) + max(centre - sides.y * z, 0.0);
}

// Lower bound of the squared distance from a point to a cell, m^2; nearly always exact. At depth z a cell
// is a rectangle, so the squared distance f(z) = (z - c.z)^2 + dx(z)^2 + dy(z)^2 is convex and piecewise
// quadratic. One Newton step from the centre's depth nearly always finds the minimum. Where it does not, f
// lies above the touching parabola of curvature 2, whose minimum is returned. `axes`: 1 to include x or y,
// 0 to ignore it.
float squaredDistance(const vec3 c, const CellBounds cell, const vec2 axes) {
    float z = clamp(c.z, cell.depth.x, cell.depth.y);
    if (on(feature_orthographic)) {
        vec2 beyond = vec2(beyondSides(cell.x, c.x, 1.0), beyondSides(cell.y, c.y, 1.0)) * axes;
        return (z - c.z) * (z - c.z) + dot(beyond, beyond);
    }
    vec2 first = vec2(sideBeyond(cell.x, c.x, z), sideBeyond(cell.y, c.y, z)) * axes;
    z = clamp((c.z + dot(first, c.xy)) / (1.0 + dot(first, first)), cell.depth.x, cell.depth.y);
    vec2 side = vec2(sideBeyond(cell.x, c.x, z), sideBeyond(cell.y, c.y, z)) * axes;
    vec2 beyond = vec2(beyondSides(cell.x, c.x, z), beyondSides(cell.y, c.y, z)) * axes;
    float slope = z - c.z - dot(side, beyond);  // half of f'(z)
    float step = clamp(z - slope, cell.depth.x, cell.depth.y) - z;
    return (z - c.z) * (z - c.z) + dot(beyond, beyond) + (2.0 * slope + step) * step;
}

// Squared distance to the cell's whole row; ignores x.
float squaredDistanceToRow(const vec3 c, const CellBounds cell) {
    return squaredDistance(c, cell, vec2(0.0, 1.0));
}

bool sphereOverlaps(const vec3 centre, const float radius, const CellBounds cell) {
    return cell.depth.x <= cell.depth.y && squaredDistance(centre, cell, vec2(1.0)) <= radius * radius;
}

// Cone against the bounding sphere of a cell (Wronski 2017, "Cull that cone!"). The sphere is outside if
// its distance to the cone's side exceeds its radius.
bool coneOverlapsSphere(const LightBound light, const vec3 centre, const float radius) {
    vec3 v = centre - light.apex;
    float along = dot(v, light.axis);
    float across = sqrt(max(dot(v, v) - along * along, 0.0));
    return light.cos_cone * across - along * light.sin_cone <= radius;
}

// Whether the infinite cone has a point on the inner side of a plane. `normal` points outwards. Such a
// point is the apex, or lies along a direction of the cone that leads inwards.
bool coneOverlapsHalfSpace(const LightBound light, const vec3 point, const vec3 normal) {
    float outside = dot(light.apex - point, normal);
    // The largest cosine between -normal and a direction of the cone.
    float c = -dot(light.axis, normal), s = sqrt(max(1.0 - c * c, 0.0));
    float inward = c >= light.cos_cone ? 1.0 : c * light.cos_cone + s * light.sin_cone;
    return outside <= 0.0 || inward > -1e-6;
}

bool coneOverlaps(const LightBound light, const CellBounds cell) {
    if (light.cos_cone <= -1.0) return true;
    // Close to the light float32 cannot resolve directions; the slack of the bounds covers this rounding.
    float far = min(cell.depth.y, light.centre.z + light.radius),
          near = max(cell.depth.x, light.centre.z - light.radius);
    vec2 z = on(feature_orthographic) ? vec2(1.0) : vec2(near, far);
    vec3 low = vec3(min(cell.x.x * z.x, cell.x.x * z.y), min(cell.y.x * z.x, cell.y.x * z.y), near);
    vec3 high = vec3(max(cell.x.y * z.x, cell.x.y * z.y), max(cell.y.y * z.x, cell.y.y * z.y), far);
    vec3 centre = 0.5 * (low + high);
    float radius = lengthOf(high - centre);
    float slack = 4e-6 * (lengthOf(centre) + lengthOf(light.apex)) + 1e-5 * radius;
    if (!coneOverlapsSphere(light, centre, radius + slack)) return false;
    return coneOverlapsHalfSpace(light, vec3(0.0, 0.0, near - slack), vec3(0.0, 0.0, -1.0)) &&
           coneOverlapsHalfSpace(light, vec3(0.0, 0.0, far + slack), vec3(0.0, 0.0, 1.0));
}

bool overlaps(const LightBound light, const CellBounds cell) {
    return sphereOverlaps(light.centre, light.radius, cell) &&
           (!on(feature_spot_lights) || coneOverlaps(light, cell));
}

#endif
