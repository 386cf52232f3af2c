// SPDX-License-Identifier: MIT
// Rectangles, discs and tubes of constant radiance (shared/contract/area_light.h). feature_area_lights
// selects linearly transformed cosines or one representative point (area_point.glsl). Area lights cast no
// shadows.
#ifndef AREA_GLSL
#define AREA_GLSL

#include "shaders/lib/lights/area_point.glsl"
#include "shaders/lib/shading/brdf.glsl"
#include "shaders/lib/lights/punctual_lights.glsl"
#include "shaders/lib/lights/ltc_tube.glsl"
#include "shaders/lib/shading/sheen.glsl"

bool areaPoints() { return (feature_area_lights & AREA_POINTS) != 0; }

// Values shared by all area lights of a pixel.
struct AreaView {
    Brdf brdf;
    vec3 n, v;          // unit, world axes
    mat3 surface;       // from world axes to the frame of shared/contract/ltc.h
    Ltc ltc;            // of the specular lobe
    float tilt;         // of its cosine
    vec3 sky;           // specular reflection of uniform radiance 1
    bool woven;         // whether there is a sheen above the material
    Sheen sheen;
};

// Radiance towards the viewer, W/(sr m^2).
struct AreaLobes {
    Lobes lobes;
    vec3 sheen;
};

// One entry of the table (shared/contract/ltc.h, shared/light/ltc.h).
struct LtcCell {
    vec4 even, layer;  // in_plane, across, unsheared, tilt
    float magnitude, fresnel;
};

// A light as seen from the surface point.
struct AreaIncident {
    vec3 centre;    // relative to the surface, world axes, m
    vec3 radiance;  // W/(sr m^2); exactly 0 beyond its range and from behind
    float side;     // 1: emits along `direction`; -1: against it
};

// F0's fraction of the lobe's reflection.
float evenFraction(const LtcCell cell, const float f0, const float f90) {
    float even = f0 * cell.magnitude, all = even + max(f90 - f0, 0.0) * cell.fresnel;
    return even / max(all, 1e-30);
}

AreaView areaViewOf(const Brdf brdf, const vec3 n, const vec3 v, const LtcCell cell) {
    AreaView a;
    a.brdf = brdf;
    a.woven = false;
    a.n = n;
    a.v = v;
    vec3 across = v - n * dot(n, v);
    float sine = lengthOf(across);
    vec3 other = abs(n.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 x = sine > 1e-6 ? across / -sine : normalized(crossProduct(n, other));
    a.surface = transpose(mat3(x, crossProduct(n, x), n));
    float sin2 = max(1.0 - brdf.n_dot_v * brdf.n_dot_v, 0.0);
    float m2 = brdf.n_dot_v * brdf.n_dot_v + brdf.alpha * brdf.alpha * sin2;
    float smallest = evenFraction(cell, LTC_LAYER_F0, 1.0);
    float even = evenFraction(cell, dot(brdf.f0, vec3(1.0 / 3.0)), dot(brdf.f90, vec3(1.0 / 3.0)));
    float towards_even = clamp((even - smallest) / max(1.0 - smallest, 1e-6), 0.0, 1.0);
    vec4 lobe = cell.layer + (cell.even - cell.layer) * towards_even;
    a.ltc.inverse_a = m2 / (lobe.x * 2.0 * brdf.alpha);
    a.ltc.inverse_c = 1.0 / (lobe.y * 2.0 * brdf.alpha);
    a.ltc.b = (1.0 - lobe.z) * sqrt(sin2 / m2);
    a.tilt = lobe.w;
    a.sky = brdf.f0 * cell.magnitude + (brdf.f90 - brdf.f0) * cell.fresnel;
    return a;
}

layout(set = SET_FRAME, binding = BINDING_LTC_TABLE) uniform sampler2D ltc_table;

// Looks up the table's entry.
AreaView areaView(const Reflector r) {
    LtcCell cell = LtcCell(vec4(1.0), vec4(1.0), 1.0, 0.0);
    if (!areaPoints()) {
        float roughness = sqrt(r.brdf.alpha);
        vec2 at = vec2((roughness - MIN_PERCEPTUAL_ROUGHNESS) / (1.0 - MIN_PERCEPTUAL_ROUGHNESS),
                       1.0 - sqrt(min(r.brdf.n_dot_v, 1.0)));
        vec2 texel = 1.0 / vec2(LTC_CELLS, LTC_BLOCKS * LTC_CELLS);
        at = (at * float(LTC_CELLS - 1) + 0.5) * texel;
        vec2 block = vec2(0.0, 1.0 / float(LTC_BLOCKS));
        cell.even = textureLod(ltc_table, at, 0.0);
        cell.layer = textureLod(ltc_table, at + block, 0.0);
        vec2 albedo = textureLod(ltc_table, at + 2.0 * block, 0.0).xy;
        cell.magnitude = albedo.x, cell.fresnel = albedo.y;
    }
    return areaViewOf(r.brdf, r.n, r.v, cell);
}

AreaIncident fromAreaLight(const Light light, const AreaLight shape, const vec3 position,
                           const bool flat_light) {
    AreaIncident i;
    i.centre = light.position - position;
    float d2 = max(dot(i.centre, i.centre), MIN_LIGHT_DISTANCE_SQUARED);
    float window = rangeWindow(light, d2);
    float front = -dot(i.centre, shape.direction);
    i.side = front < 0.0 ? -1.0 : 1.0;
    bool shines = !flat_light || front > 0.0 || (front < 0.0 && shape.two_sided != 0.0);
    i.radiance = shines ? light.intensity * window : vec3(0.0);
    return i;
}

// Largest reflection of a small light, as a multiple of `sky`. The fit is poor where the light's mean
// direction is far from the centre of the lobe.
const float LTC_MAX_GAIN = 4.0;

// The sheen as if all light came from its mean direction `l` (unit). `received`: irradiance over the
// radiance of the light, with the cosine.
vec3 areaSheen(const AreaView a, const vec3 l, const float received, const vec3 radiance) {
    if (!hasLayer(LAYER_SHEEN)) return vec3(0.0);
    float n_dot_l = clamp(dot(a.n, l), 0.0, 1.0);
    float perpendicular = received / max(n_dot_l, 1e-4);
    vec3 reflected = sheenReflected(a.sheen, a.n, a.v, l, radiance * perpendicular);
    return a.woven ? reflected : vec3(0.0);
}

// The reflection of a light that shines here; else nothing, whatever its arithmetic gave.
AreaLobes areaLobes(const vec3 from_base, const vec3 from_lobe, const vec3 from_sheen, const vec3 radiance) {
    bool lit = any(greaterThan(radiance, vec3(0.0)));
    AreaLobes nothing = AreaLobes(Lobes(vec3(0.0), vec3(0.0)), vec3(0.0));
    if (lit) nothing = AreaLobes(Lobes(from_base, from_lobe), from_sheen);
    return nothing;
}

// `plain`, `lobe`: the light's form factors (ltc.glsl) under the cosine and under the specular lobe. A
// small light reflects exactly the BRDF at its mean direction: the BRDF replaces the fitted density there.
// A light that fills the lobe reflects the table's albedo. The fourth root of the covered fraction blends the
// two; it fits the lights of tests/probe/area_error_test.cpp best.
AreaLobes fromFactors(const AreaView a, const vec3 plain, const vec3 lobe, const vec3 radiance) {
    mat3 world = transpose(a.surface);
    float weight = schlickWeight(0.5 * lengthOf(unitOrZero(world * plain) + a.v));
    vec3 base = reachingBase(a.brdf, weight);
    float fraction = clamp(lobe.z + a.tilt * lobe.x, 0.0, 1.0);
    vec3 u = unitOrZero(lobe), l = fromCosine(a.ltc, u);
    // Per steradian: a direction's solid angle shrinks by the cube of the length of its image.
    float density = (u.z + a.tilt * u.x) * INVERSE_PI * a.ltc.inverse_a * a.ltc.inverse_c;
    float stretch = lengthOf(l);
    density *= stretch * stretch * stretch;
    l = unitOrZero(l);
    float n_dot_l = max(l.z, 0.0);
    vec3 s = world * l + a.v;
    float s2 = dot(s, s);
    vec3 there = (a.brdf.f0 + (a.brdf.f90 - a.brdf.f0) * schlickWeight(0.5 * sqrt(s2))) *
                 (specularLobe(a.brdf, a.n, s, s2, n_dot_l) * n_dot_l / max(density, 1e-20));
    there = min(there, LTC_MAX_GAIN * a.sky);
    vec3 reflected = min(blend(there, a.sky, sqrt(sqrt(fraction))) * fraction, a.sky);
    vec3 from_base = a.brdf.diffuse * (base * PI * max(plain.z, 0.0)) * radiance;
    vec3 from_lobe = reflected * radiance;
    if (feature_multiscatter == MULTISCATTER_FDEZ)
        from_lobe += a.brdf.between * (PI * max(plain.z, 0.0)) * radiance;
    vec3 from_sheen = areaSheen(a, unitOrZero(world * plain), PI * max(plain.z, 0.0), radiance);
    return areaLobes(from_base, from_lobe, from_sheen, radiance);
}

AreaLobes fromPoint(const AreaView a, const AreaPoint p, const vec3 radiance) {
    Lobes reflected = reflectPoint(a.brdf, a.n, a.v, p, radiance);
    vec3 l = unitOrZero(p.diffuse_at);
    vec3 from_sheen = areaSheen(a, l, max(dot(a.n, l), 0.0) * p.solid_angle, radiance);
    return areaLobes(reflected.diffuse, reflected.specular, from_sheen, radiance);
}

// Scale of lengths: one over the distance of the light's farthest point. Squares then stay within float32
// near a huge light and far from a tiny one.
float unitOf(const AreaIncident i, const AreaLight shape) {
    return 1.0 / (lengthOf(i.centre) + shape.extent);
}

// Sets `plain` and `lobe` to `factor`, an expression of `under`: the cosine, then the lobe's. In a loop, so
// that a module holds its long code once.
#define BOTH_FACTORS(plain, lobe, factor)      \
    vec3 plain, lobe = vec3(0.0);              \
    {                                          \
        Ltc under = Ltc(1.0, 1.0, 0.0);        \
        uint turn = 0u;                        \
        do {                                   \
            plain = lobe;                      \
            lobe = factor;                     \
            under = a.ltc;                     \
        } while (++turn < 2u);                 \
    }

AreaLobes rectLobes(const AreaView a, const Light light, const AreaLight shape, const vec3 position) {
    AreaIncident i = fromAreaLight(light, shape, position, true);
    if (areaPoints())
        return fromPoint(a, rectPoint(i.centre, shape, a.n, specularRay(a.brdf, a.n, a.v)), i.radiance);
    float unit = unitOf(i, shape);
    vec3 c = a.surface * (i.centre * unit), x = a.surface * (shape.x * unit),
         y = a.surface * (shape.y * (-i.side * unit));
    BOTH_FACTORS(plain, lobe, parallelogramFactor(under, c, x, y))
    return fromFactors(a, plain, lobe, i.radiance);
}

AreaLobes discLobes(const AreaView a, const Light light, const AreaLight shape, const vec3 position) {
    AreaIncident i = fromAreaLight(light, shape, position, true);
    if (areaPoints())
        return fromPoint(a, discPoint(i.centre, shape, a.n, specularRay(a.brdf, a.n, a.v)), i.radiance);
    float unit = unitOf(i, shape);
    vec3 c = a.surface * (i.centre * unit), x = a.surface * (shape.x * unit),
         y = a.surface * (shape.y * unit);
    BOTH_FACTORS(plain, lobe, ellipseFactor(under, c, x, y))
    return fromFactors(a, plain, lobe, i.radiance);
}

AreaLobes tubeLobes(const AreaView a, const Light light, const AreaLight shape, const vec3 position) {
    AreaIncident i = fromAreaLight(light, shape, position, false);
    float along = dot(i.centre, shape.direction);
    bool within = lengthOf(i.centre - shape.direction * along) <= shape.radius &&
                  abs(along) <= lengthOf(shape.x);
    if (within) i.radiance = vec3(0.0);  // a tube emits outwards only
    if (areaPoints())
        return fromPoint(a, tubePoint(i.centre, shape, a.n, specularRay(a.brdf, a.n, a.v)), i.radiance);
    float unit = unitOf(i, shape);
    Tube t = tubeOf(a.surface * (i.centre * unit), a.surface * shape.direction, lengthOf(shape.x) * unit,
                    shape.radius * unit);
    BOTH_FACTORS(plain, lobe, tubeFactor(under, t))
    return fromFactors(a, plain, lobe, i.radiance);
}

#endif
