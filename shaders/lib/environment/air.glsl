// SPDX-License-Identifier: MIT
// Transmittance of air and light scattered along a ray. Density falls exponentially with height
// (shared/environment/README.md). Lengths in m; heights in m above the air's height 0.
#ifndef AIR_GLSL
#define AIR_GLSL

#include "shaders/lib/contract.glsl"
#include "shaders/lib/math/loop.glsl"

struct Hazed {
    vec3 transmittance;
    vec3 scattered;  // to the viewer, W/(sr m^2)
};

// e^x and e^x - 1 for x in [-87, 60]; relative error at most 2e-7. GLSL's exp() guarantees no relative
// accuracy near 0. The polynomial is that of Moshier's expf (Cephes).
void exponential(const vec3 x, out vec3 whole, out vec3 less_one) {
    vec3 n = floor(x * 1.44269504 + 0.5);
    vec3 r = (x - n * 0.693359375) + n * 2.12194440e-4;  // ln 2 in two parts
    vec3 p = 1.3981999507e-3 + r * 1.9875691500e-4;
    p = 8.3334519073e-3 + r * p;
    p = 4.1665795894e-2 + r * p;
    p = 1.6666665459e-1 + r * p;
    p = 5.0000001201e-1 + r * p;
    p = r + r * r * p;
    vec3 scale = uintBitsToFloat(uvec3(ivec3(n) + 127) << 23);
    whole = scale + scale * p;
    less_one = (scale - 1.0) + scale * p;
}

// Transmittance at an optical depth, and 1 - transmittance.
void attenuation(const vec3 depth, out vec3 through, out vec3 lost) {
    exponential(-min(depth, vec3(87.0)), through, lost);
    lost = -lost;
}

// Air along a segment, in m of air at height 0. The segment is `reach` metres long and rises by `rise`.
// Counting from the lower, densest end avoids overflow and makes both directions agree. The mean density
// over the rise is (1 - e^-x) / x of that at the lower end.
float airAlong(const float height, const float rise, const float reach, const float inverse_height) {
    float low = height + min(rise, 0.0), x = max(abs(rise) * inverse_height, 1e-30);
    vec3 whole, less_one;
    exponential(vec3(clamp(-low * inverse_height, -87.0, 60.0), -min(x, 87.0), 0.0), whole, less_one);
    return min(reach * (whole.x * (-less_one.y / x)), HAZE_OPAQUE_METRES);
}

// Air along an endless ray; `up` is the sine of its elevation. Finite only for rays that rise.
float airBeyond(const float height, const float up, const float inverse_height) {
    vec3 whole, less_one;
    exponential(vec3(clamp(-height * inverse_height, -87.0, 60.0), 0.0, 0.0), whole, less_one);
    return up > 0.0 ? min(whole.x / max(up * inverse_height, 1e-30), HAZE_OPAQUE_METRES) : HAZE_OPAQUE_METRES;
}

// Phase functions for sunlight: Rayleigh for molecules, Cornette and Shanks 1992 for aerosols. The squared
// distance of two unit vectors stays exact where their cosine is near 1.
void phases(const Haze h, const vec3 away, out vec3 rayleigh, out vec3 mie) {
    vec3 apart = away - h.to_sun;
    float d2 = dot(apart, apart), cosine = 1.0 - 0.5 * d2, k = h.phase_0 + h.phase_1 * d2;
    float both = 1.0 + cosine * cosine;
    rayleigh = h.rayleigh * both;
    mie = h.mie * (both / (k * sqrt(k)));
}

// Haze with one scale height: the source term is constant along the ray.
Hazed hazeOfAir(const Haze h, const float air, const vec3 away) {
    vec3 through, lost, source = vec3(0.0);
    attenuation(h.extinction * air, through, lost);
    if (on(feature_haze & HAZE_SUN)) {
        vec3 rayleigh, mie;
        phases(h, away, rayleigh, mie);
        source = rayleigh + mie;
    }
    if (on(feature_haze & HAZE_AMBIENT)) source += h.ambient;
    return Hazed(through, source * lost);
}

// -ln(1 - z) / z for z in [0, 1).
float logRatio(const float z) {
    float w = min(z, 0.9999999);
    return w < 0.01 ? 1.0 + w * (0.5 + w * (0.33333333 + w * 0.25)) : -log(1.0 - w) / w;
}

// A ray through air with one scale height, used to place the steps of the ray march.
struct AirRay {
    float height, up;  // at its origin, m; sine of its elevation
    float reach, air;  // length, m; air along it, m at height 0
    float low;         // density at its lower end, relative to height 0
    bool climbs;
};

// Rays that descend end at optical depth HAZE_ENDLESS_DEPTH; so do endless level rays.
AirRay airRay(const Haze h, const float height, const vec3 away, const float reach, const bool endless) {
    AirRay ray = AirRay(height, away.y, reach, HAZE_OPAQUE_METRES, 0.0, away.y > 0.0);
    float here = exp(clamp(-height * h.inverse_height, -87.0, 60.0));
    float largest = HAZE_ENDLESS_DEPTH / h.extinction.x;
    if (!endless)
        ray.air = airAlong(height, away.y * reach, reach, h.inverse_height);
    else if (ray.climbs)
        ray.air = airBeyond(height, away.y, h.inverse_height);
    if (ray.climbs) {
        ray.low = here;
    } else if (ray.air <= largest) {
        ray.low = exp(clamp(-(height + away.y * reach) * h.inverse_height, -87.0, 60.0));
    } else {
        ray.air = largest;
        float more = largest * (-away.y * h.inverse_height);
        ray.low = min(here + more, 1e26);
        float z = more / ray.low, fall = height + log(ray.low) / h.inverse_height;
        ray.reach = z > 0.5 ? fall / -away.y : largest / ray.low * logRatio(z);
    }
    return ray;
}

// Distance along the ray at which a `fraction` of the steps ends. Steps are uniform in the square root of the
// mean air's remaining attenuation; `lost` is the whole ray's. This puts more steps far away, where the
// air is thinner than its mean or transmits some colours better.
float distanceAt(const AirRay ray, const Haze h, const float fraction, const float lost) {
    float z = fraction * (2.0 - fraction) * lost, air = min(z * logRatio(z) / h.extinction.x, ray.air);
    float from_low = (ray.climbs ? air : ray.air - air) / ray.low;
    float along = from_low * logRatio(from_low * abs(ray.up) * h.inverse_height);
    return ray.climbs ? along : max(ray.reach - along, 0.0);
}

// Source term at a height: light scattered to the viewer divided by extinction.
vec3 sourceAt(const Haze h, const HazeMarch m, const float height, const vec3 rayleigh_phase,
              const vec3 mie_phase) {
    float r = exp(clamp(-height * m.rayleigh_inverse, -87.0, 60.0));
    float a = exp(clamp(-height * m.mie_inverse, -87.0, 60.0));
    vec3 molecules = m.rayleigh * r, aerosols = m.mie * a, extinction = molecules + m.mie_extinction * a;
    vec3 scattered = vec3(0.0);
    if (on(feature_haze & HAZE_SUN)) {
        vec3 above = molecules / m.rayleigh_inverse + (m.mie_extinction * a) / m.mie_inverse;
        vec3 sun = exp(-min(above * m.inverse_sun_up, vec3(87.0)));
        scattered = sun * (molecules * rayleigh_phase + aerosols * mie_phase);
    }
    if (on(feature_haze & HAZE_AMBIENT)) scattered += h.ambient * (molecules + aerosols);
    return scattered / max(extinction, vec3(1e-30));
}

// Haze with two scale heights. Each step adds the source term at its middle times the transmittance lost
// over the step (Hillaire 2020). A constant source gives the exact result for any number of steps.
Hazed marchedHaze(const Haze h, const HazeMarch m, const float height, const vec3 away, const float reach,
                  const bool endless) {
    vec3 rayleigh_phase = vec3(0.0), mie_phase = vec3(0.0);
    if (on(feature_haze & HAZE_SUN)) phases(h, away, rayleigh_phase, mie_phase);
    AirRay ray = airRay(h, height, away, reach, endless);
    vec3 mean_through, mean_lost;
    attenuation(vec3(h.extinction.x * ray.air, 0.0, 0.0), mean_through, mean_lost);
    Hazed hazed = Hazed(vec3(1.0), vec3(0.0));
    vec3 before = vec3(0.0);
    uvec2 range = uvec2(0u, uint(h.steps));
    EACH(range) {
        float i = float(range.x);
        float middle = distanceAt(ray, h, (i + 0.5) / h.steps, mean_lost.x);
        float end = distanceAt(ray, h, (i + 1.0) / h.steps, mean_lost.x);
        vec3 source = sourceAt(h, m, height + away.y * middle, rayleigh_phase, mie_phase);
        bool last = range.x + 1u == range.y;
        end = last ? reach : end;
        float molecules = airAlong(height, away.y * end, end, m.rayleigh_inverse);
        float aerosols = airAlong(height, away.y * end, end, m.mie_inverse);
        if (last && endless) {
            molecules = airBeyond(height, away.y, m.rayleigh_inverse);
            aerosols = airBeyond(height, away.y, m.mie_inverse);
        }
        vec3 through, lost;
        attenuation(m.rayleigh * molecules + m.mie_extinction * aerosols, through, lost);
        hazed.scattered += source * (lost - before);
        hazed.transmittance = through;
        before = lost;
        NEXT(range);
    }
    return hazed;
}

#endif
