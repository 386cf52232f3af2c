// SPDX-License-Identifier: MIT
// Light from polygons, ellipses and cylinders of constant radiance under a linearly transformed cosine
// (Heitz, Dupuy, Hill and Neubelt 2016). M^-1 maps a light's directions to directions under the plain
// cosine. There the integral is known, edge by edge: Lambert's contour (1760, "Photometria").
//
// Vectors are relative to the surface, in the frame of shared/contract/ltc.h (z = n), of any length whose
// square fits in float32. A form factor is the vector (1 / pi) integral of l dl over the light's part
// above the horizon. Its z, 0 to 1, is the light's fraction of a sky of equal radiance; times pi it is the
// irradiance for radiance 1.
#ifndef LTC_GLSL
#define LTC_GLSL

#include "shaders/lib/math/angles.glsl"
#include "shaders/lib/contract.glsl"

// M^-1; the identity is the plain cosine.
struct Ltc {
    float inverse_a, inverse_c, b;
};

vec3 toCosine(const Ltc m, const vec3 l) {
    return vec3((l.x - m.b * l.z) * m.inverse_a, l.y * m.inverse_c, l.z);
}

vec3 fromCosine(const Ltc m, const vec3 l) {
    return vec3(l.x / m.inverse_a + m.b * l.z, l.y / m.inverse_c, l.z);
}

vec3 unitOrZero(const vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-37)); }

// One edge of an outline, along the great circle between two directions, counter-clockwise about the
// direction to the light. The sum over a closed outline is its form factor. Zero if a direction is 0 or
// both are equal.
vec3 edgeFactor(const vec3 from, const vec3 to) {
    vec3 p = unitOrZero(from), q = unitOrZero(to);
    vec3 c = crossProduct(p, q);
    return c * (angleRatio(dot(p, q), lengthOf(c)) * 0.5 * INVERSE_PI);
}

// An outline above the horizon, built edge by edge. A convex one crosses the horizon twice or never; the
// horizon closes it between the crossings.
struct Outline {
    vec3 sum;
    vec3 leaves, returns;  // downward and upward crossing; 0 without one
};
Outline noOutline() { return Outline(vec3(0.0), vec3(0.0), vec3(0.0)); }
vec3 closed(const Outline o) { return o.sum + edgeFactor(o.leaves, o.returns); }

void addEdge(inout Outline o, const vec3 p, const vec3 q) {
    bool p_above = p.z > 0.0, q_above = q.z > 0.0;
    bool crosses = p_above != q_above;
    // p (-q.z) + q p.z, negated where the edge rises; a direction only, so that nothing is divided.
    vec3 crossing = (q * p.z - p * q.z) * (p_above ? 1.0 : -1.0);
    crossing.z = 0.0;
    vec3 edge = edgeFactor(p_above ? p : crossing, q_above ? q : crossing);
    if (p_above || q_above) o.sum += edge;
    if (crosses && p_above) o.leaves = crossing;
    if (crosses && q_above) o.returns = crossing;
}

// A parallelogram c +- x +- y whose cross(x, y) points away from the surface. One that looks very small is
// treated as a point, because its outline is a sum of large terms.
vec3 parallelogramFactor(const Ltc m, vec3 c, vec3 x, vec3 y) {
    c = toCosine(m, c), x = toCosine(m, x), y = toCosine(m, y);
    Outline o = noOutline();
    vec3 corners[4] = vec3[](c - x - y, c + x - y, c + x + y, c - x + y);
    addEdge(o, corners[0], corners[1]);
    addEdge(o, corners[1], corners[2]);
    addEdge(o, corners[2], corners[3]);
    addEdge(o, corners[3], corners[0]);
    float c2 = dot(c, c), reach = lengthOf(x) + lengthOf(y);
    vec3 afar = c * (4.0 * INVERSE_PI * abs(dot(c, crossProduct(x, y))) / (c2 * c2));
    return c.z > reach && c2 > 16384.0 * reach * reach ? afar : closed(o);
}

// The cone of directions c + a cos t + b sin t, for any ellipse whose plane misses the surface. In its own
// axes: (half_x cos t, half_y sin t, 1) along x, y, z. After Heitz and Hill 2017, "Real-Time Line- and
// Disk-Light Shading with Linearly Transformed Cosines"; their matrix is the inverse of one of the two
// here.
struct Cone {
    vec3 x, y, z;  // unit; right-handed
    float half_x, half_y;  // half_x >= half_y >= 0
};

// One step of Laguerre's method, up or down, to the largest root of x^3 - trace x^2 + minors x - det.
float nearerRoot(const float x, const float trace, const float minors, const float det) {
    float f = ((x - trace) * x + minors) * x - det;
    float slope = (3.0 * x - 2.0 * trace) * x + minors, bend = 6.0 * x - 2.0 * trace;
    float down = slope + sqrt(max(4.0 * slope * slope - 6.0 * f * bend, 0.0));
    return down > 0.0 ? x - 3.0 * f / down : x;
}

// Eigenvector of the only positive eigenvalue of p p^T - q q^T - r r^T; unit, or 0.
vec3 positiveAxis(vec3 p, vec3 q, vec3 r) {
    float size = 1.0 / max(dot(p, p) + dot(q, q) + dot(r, r), 1e-36);
    float scale = sqrt(size);
    p *= scale, q *= scale, r *= scale;
    vec3 pq = crossProduct(p, q), rp = crossProduct(r, p), qr = crossProduct(q, r);
    // The largest root of the characteristic polynomial, its only positive one. The trigonometric solution
    // (Smith 1961, "Eigenvalues of a Symmetric 3 x 3 Matrix") has half the digits where two roots are
    // close. Each step of Laguerre's method triples the digits if all roots are real.
    float trace = dot(p, p) - dot(q, q) - dot(r, r);
    float minors = dot(qr, qr) - dot(pq, pq) - dot(rp, rp);
    float det = dot(p, qr);
    det *= det;
    float mean = trace * (1.0 / 3.0), spread2 = max(mean * mean - minors * (1.0 / 3.0), 1e-30),
          wide = sqrt(spread2);
    float cosine = clamp((mean * (mean * mean - 0.5 * minors) + 0.5 * det) / (spread2 * wide), -1.0, 1.0);
    float root = mean + 2.0 * wide * cos(angleOf(cosine, sqrt(1.0 - cosine * cosine)) * (1.0 / 3.0));
    root = nearerRoot(root, trace, minors, det);
    root = nearerRoot(root, trace, minors, det);
    root = max(root, 0.0);
    // adj(S - root 1) = adj S + root S + root (root - trace) 1 is a multiple of z z^T; z is its longest
    // column.
    mat3 s = outerProduct(p, p) - outerProduct(q, q) - outerProduct(r, r);
    mat3 adjoint = outerProduct(qr, qr) - outerProduct(pq, pq) - outerProduct(rp, rp) + root * s;
    float d = root * (root - trace);
    adjoint[0].x += d, adjoint[1].y += d, adjoint[2].z += d;
    vec3 z = adjoint[0];
    float longest = adjoint[0].x;
    if (adjoint[1].y > longest) z = adjoint[1], longest = adjoint[1].y;
    if (adjoint[2].z > longest) z = adjoint[2];
    return unitOrZero(z);
}

// The cone's other axes: c c^T - a a^T - b b^T, restricted to the plane perpendicular to z. Frame: Duff et
// al. 2017, "Building an Orthonormal Basis, Revisited". `volume`: of the three vectors.
Cone coneAround(const vec3 z, const vec3 c, const vec3 a, const vec3 b, const float volume) {
    float sign_z = z.z >= 0.0 ? 1.0 : -1.0;
    float k = -1.0 / (sign_z + z.z), kxy = z.x * z.y * k;
    vec3 u = vec3(1.0 + sign_z * z.x * z.x * k, sign_z * kxy, -sign_z * z.x);
    vec3 v = vec3(kxy, sign_z + z.y * z.y * k, -z.y);
    vec3 cu = vec3(dot(c, u), dot(c, v), dot(c, z)), au = vec3(dot(a, u), dot(a, v), dot(a, z)),
         bu = vec3(dot(b, u), dot(b, v), dot(b, z));
    float uu = au.x * au.x + bu.x * bu.x - cu.x * cu.x, vv = au.y * au.y + bu.y * bu.y - cu.y * cu.y,
          uv = au.x * au.y + bu.x * bu.y - cu.x * cu.y, zz = cu.z * cu.z - au.z * au.z - bu.z * bu.z;
    float middle = 0.5 * (uu + vv), apart = 0.5 * (uu - vv), spread = sqrt(apart * apart + uv * uv);
    // Half the angle whose tangent is uv / apart.
    float large = sqrt(0.5 + 0.5 * min(abs(apart) / max(spread, 1e-37), 1.0));
    float small = 0.5 * uv / max(spread * large, 1e-37);
    // Any axes fit a round cone; with this little spread they would be rounding error.
    if (spread <= 1e-9 * (abs(uu) + abs(vv))) large = 1.0, small = 0.0, apart = 0.0;
    vec2 turn = apart >= 0.0 ? vec2(large, small) : vec2(abs(small), uv >= 0.0 ? large : -large);
    Cone cone;
    cone.x = u * turn.x + v * turn.y;
    cone.y = crossProduct(z, cone.x);
    cone.z = z;
    zz = max(zz, 1e-30);
    cone.half_x = sqrt(max(middle + spread, 1e-30) / zz);
    cone.half_y = min(volume / (zz * sqrt(zz) * cone.half_x), cone.half_x);
    return cone;
}

Cone coneOf(const vec3 c, const vec3 a, const vec3 b) {
    vec3 bc = crossProduct(b, c), ca = crossProduct(c, a), ab = crossProduct(a, b);
    float volume = abs(dot(c, ab));
    // z is the axis of c c^T - a a^T - b b^T, and of its adjoint, the same for the cross products. The
    // eigenvalue is large in the first for narrow cones, in the second for wide ones.
    float c2 = dot(c, c);
    bool narrow = volume < c2 * sqrt(c2);
    vec3 z = positiveAxis(narrow ? c : ab, narrow ? a : bc, narrow ? b : ca);
    if (dot(z, c) < 0.0) z = -z;
    return coneAround(z, c, a, b, volume);
}

// atanh(x) / x.
float atanhRatio(const float x) {
    float x2 = x * x;
    float series = 1.0 + x2 * (1.0 / 3.0 + x2 * (0.2 + x2 * (1.0 / 7.0 + x2 * (1.0 / 9.0))));
    return abs(x) < 0.25 ? series : 0.5 * log((1.0 + x) / max(1.0 - x, 1e-7)) / x;
}

// Part of an outline along the cone from one t to a later one, both as (cos, sin), in the cone's axes.
// `beyond`: more than half of the cone. In closed form: with r = (half_x cos t, half_y sin t, 1), the
// integral of cross(r, dr) / r.r, whose denominator is 1 + half_y^2 + (half_x^2 - half_y^2) cos^2 t.
vec3 arcFactor(const Cone cone, const vec2 from, const vec2 to, const bool beyond) {
    float x2 = cone.half_x * cone.half_x, y2 = cone.half_y * cone.half_y;
    float gx = 1.0 + x2, gy = 1.0 + y2, between = max(x2 - y2, 0.0);
    // Integral of dt: the angle between the two ends seen along z, stretched.
    vec2 stretch = sqrt(vec2(gy, gx));
    vec2 p = normalized(from * stretch.yx), q = normalized(to * stretch.yx);
    float angle = angleOf(dot(p, q), abs(p.x * q.y - p.y * q.x));
    angle = beyond ? 2.0 * PI - angle : angle;
    // Integral of cos t dt: the difference of two atanh(k sin t).
    float k = sqrt(between / gx);
    float dx = (to.y - from.y) / max(1.0 - k * k * from.y * to.y, 1e-7);
    // Integral of sin t dt: the difference of two atan(j cos t), as the angle of one vector.
    float j = sqrt(between / gy);
    vec2 w = vec2(1.0 + j * j * from.x * to.x, j * (to.x - from.x));
    float w_length = max(lengthOf(w), 1e-37);
    float dy = (to.x - from.x) * angleRatio(w.x / w_length, abs(w.y) / w_length) / w_length;
    return vec3(-cone.half_y / gx * dx * atanhRatio(min(abs(k * dx), 1.0)), cone.half_x / gy * dy,
                cone.half_x * cone.half_y / (stretch.x * stretch.y) * angle) *
           (0.5 * INVERSE_PI);
}

vec3 onCone(const Cone cone, const vec2 t) {
    return cone.x * (cone.half_x * t.x) + cone.y * (cone.half_y * t.y) + cone.z;
}
vec3 fromCone(const Cone cone, const vec3 v) { return cone.x * v.x + cone.y * v.y + cone.z * v.z; }
vec2 turned(const vec2 v, const vec2 by) { return vec2(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x); }

// The part of a cone above the horizon: t within `half_angle` of `middle`, both as (cos, sin).
struct Horizon {
    vec2 middle;
    vec2 half_angle;  // from (1, 0), none of it, to (-1, 0), all of it
};
Horizon horizonOf(const Cone cone) {
    vec2 rise = vec2(cone.x.z * cone.half_x, cone.y.z * cone.half_y);
    float steep = lengthOf(rise);
    float cosine = steep > 0.0 ? clamp(-cone.z.z / steep, -1.0, 1.0) : cone.z.z > 0.0 ? -1.0 : 1.0;
    return Horizon(steep > 0.0 ? rise / steep : vec2(1.0, 0.0),
                   vec2(cosine, sqrt(max(1.0 - cosine * cosine, 0.0))));
}

// Form factor of the filled ellipse c + a cos t + b sin t.
vec3 ellipseFactor(const Ltc m, const vec3 c, const vec3 a, const vec3 b) {
    Cone cone = coneOf(toCosine(m, c), toCosine(m, a), toCosine(m, b));
    Horizon h = horizonOf(cone);
    vec2 from = turned(h.middle, vec2(h.half_angle.x, -h.half_angle.y)), to = turned(h.middle, h.half_angle);
    vec3 cut = fromCone(cone, arcFactor(cone, from, to, h.half_angle.x < 0.0)) +
               edgeFactor(onCone(cone, to), onCone(cone, from));
    // The factor of a complete ellipse points along the cone's axis.
    float x2 = cone.half_x * cone.half_x, y2 = cone.half_y * cone.half_y;
    vec3 whole = cone.z * (cone.half_x * cone.half_y / sqrt((1.0 + x2) * (1.0 + y2)));
    return h.half_angle.x <= -1.0 ? whole : h.half_angle.x >= 1.0 ? vec3(0.0) : cut;
}

#endif
