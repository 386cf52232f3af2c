// SPDX-License-Identifier: MIT
// Area lights reduced to the point nearest to a ray; cheap and approximate. Specular: the ray is the
// mirrored view, and the peak is lowered as if the light's size widened the lobe (Karis 2013, "Real
// Shading in Unreal Engine 4"). Diffuse: the ray is halfway between the normal and the light's centre
// (after Drobot 2014, "Physically Based Area Lights", GPU Pro 5).
#ifndef AREA_POINT_GLSL
#define AREA_POINT_GLSL

#include "shaders/lib/shading/brdf.glsl"

struct AreaPoint {
    vec3 diffuse_at, specular_at;  // relative to the surface, m
    float solid_angle;             // sr, seen from the surface; at most pi
    vec2 half_size;                // half extents of the light, m
};

// Where a ray meets the plane through c with normal n, relative to c. A ray that misses gives a far point
// in its direction, projected onto the plane.
vec3 onPlane(const vec3 ray, const vec3 c, const vec3 n) {
    float towards = dot(ray, n), away = dot(c, n);
    bool meets = towards * away > 0.0;
    vec3 far_point = ray * (meets ? away / towards : 1e3 * lengthOf(c));
    vec3 from_centre = far_point - c;
    return from_centre - n * dot(from_centre, n);
}
vec3 onRect(const vec3 ray, const vec3 c, const AreaLight s) {
    vec3 p = onPlane(ray, c, s.direction);
    return c + s.x * clamp(dot(p, s.x) / dot(s.x, s.x), -1.0, 1.0) +
           s.y * clamp(dot(p, s.y) / dot(s.y, s.y), -1.0, 1.0);
}
vec3 onDisc(const vec3 ray, const vec3 c, const AreaLight s) {
    vec3 p = onPlane(ray, c, s.direction);
    return c + p * min(s.radius * inversesqrt(max(dot(p, p), 1e-37)), 1.0);
}
// The nearest point of the axis, moved by at most the radius towards the ray.
vec3 onTube(const vec3 ray, const vec3 c, const AreaLight s) {
    float half_length = lengthOf(s.x), slope = dot(ray, s.direction), along = dot(c, s.direction);
    float t = (slope * dot(c, ray) - along) / max(1.0 - slope * slope, 1e-6);
    vec3 p = c + s.direction * clamp(t, -half_length, half_length);
    vec3 to_ray = ray * max(dot(p, ray), 0.0) - p;
    return p + to_ray * min(s.radius * inversesqrt(max(dot(to_ray, to_ray), 1e-37)), 1.0);
}

// Solid angle, sr; at most pi, the cosine-weighted solid angle of the hemisphere.
float solidAngleOf(const float area, const float distance2) { return area / (distance2 + area * INVERSE_PI); }

// Centre of the specular lobe; roughness turns it from the mirrored view to the normal. Lagarde and de
// Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 22.
vec3 specularRay(const Brdf b, const vec3 n, const vec3 v) {
    float smooth_part = max(1.0 - b.alpha, 0.0);
    return normalized(blend(n, reflection(-v, n), smooth_part * (sqrt(smooth_part) + b.alpha)));
}
vec3 diffuseRay(const vec3 n, const vec3 c) {
    vec3 ray = n + c * inversesqrt(max(dot(c, c), MIN_LIGHT_DISTANCE_SQUARED));
    return ray * inversesqrt(max(dot(ray, ray), 1e-12));
}

AreaPoint flatPoint(const vec3 diffuse_at, const vec3 specular_at, const float area, const vec2 half_size,
                    const vec3 normal) {
    float d2 = max(dot(diffuse_at, diffuse_at), MIN_LIGHT_DISTANCE_SQUARED);
    float seen = abs(dot(diffuse_at, normal)) * inversesqrt(d2);
    return AreaPoint(diffuse_at, specular_at, solidAngleOf(area, d2) * seen, half_size);
}
AreaPoint rectPoint(const vec3 c, const AreaLight s, const vec3 n, const vec3 mirrored) {
    vec2 half_size = vec2(lengthOf(s.x), lengthOf(s.y));
    // Semi-axes of an ellipse of the same area.
    return flatPoint(onRect(diffuseRay(n, c), c, s), onRect(mirrored, c, s), 4.0 * half_size.x * half_size.y,
                     half_size * (2.0 * inversesqrt(PI)), s.direction);
}
AreaPoint discPoint(const vec3 c, const AreaLight s, const vec3 n, const vec3 mirrored) {
    return flatPoint(onDisc(diffuseRay(n, c), c, s), onDisc(mirrored, c, s), PI * s.radius * s.radius,
                     vec2(s.radius), s.direction);
}
AreaPoint tubePoint(const vec3 c, const AreaLight s, const vec3 n, const vec3 mirrored) {
    AreaPoint p;
    p.diffuse_at = onTube(diffuseRay(n, c), c, s);
    p.specular_at = onTube(mirrored, c, s);
    float half_length = lengthOf(s.x), d2 = max(dot(p.diffuse_at, p.diffuse_at), MIN_LIGHT_DISTANCE_SQUARED);
    float cosine = dot(p.diffuse_at, s.direction) * inversesqrt(d2);
    float area = 4.0 * s.radius * half_length * sqrt(max(1.0 - cosine * cosine, 0.0)) +
                 PI * s.radius * s.radius * abs(cosine);
    // A thin line's solid angle uses the geometric mean of the squared distances to its middle and its
    // end.
    p.solid_angle = solidAngleOf(area, sqrt(d2 * (d2 + half_length * half_length)));
    p.half_size = vec2(s.radius, half_length + s.radius);
    return p;
}

Lobes reflectPoint(const Brdf b, const vec3 n, const vec3 v, const AreaPoint p, const vec3 radiance) {
    vec3 l = p.diffuse_at * inversesqrt(max(dot(p.diffuse_at, p.diffuse_at), MIN_LIGHT_DISTANCE_SQUARED));
    vec3 base = reachingBase(b, schlickWeight(0.5 * lengthOf(l + v)));
    float received = max(dot(n, l), 0.0) * p.solid_angle;

    float to_point = inversesqrt(max(dot(p.specular_at, p.specular_at), MIN_LIGHT_DISTANCE_SQUARED));
    l = p.specular_at * to_point;
    float n_dot_l = max(dot(n, l), 0.0);
    vec3 sum = l + v;
    float sum2 = dot(sum, sum);
    vec3 fresnel = b.f0 + (b.f90 - b.f0) * schlickWeight(0.5 * sqrt(sum2));
    // A light of tangent t in the centre of a round lobe covers t^2 / (t^2 + 4 alpha^2) of it. Lowering
    // the peak by that fraction makes a mirror show a large light at its own radiance. At grazing angles the
    // lobe is narrower by n.v.
    vec2 tangent = 0.5 * p.half_size * to_point;
    float width2 = b.alpha2 * b.n_dot_v;
    vec2 wider = sqrt(vec2(width2) + tangent * tangent);
    float lobe =
        specularLobe(b, n, sum, sum2, n_dot_l) * n_dot_l * (width2 / (wider.x * wider.y)) * p.solid_angle;

    Lobes reflected = Lobes(b.diffuse * (base * received) * radiance, fresnel * lobe * radiance);
    if (feature_multiscatter == MULTISCATTER_FDEZ) reflected.specular += b.between * received * radiance;
    return reflected;
}

#endif
