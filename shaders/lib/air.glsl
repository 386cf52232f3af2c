// SPDX-License-Identifier: MIT
// What air lets through and scatters along a ray, its density falling exponentially with height (the model:
// shared/environment/README.md). Lengths and heights in m; a height is over height 0 of the air.
#ifndef AIR_GLSL
#define AIR_GLSL

#include "shaders/lib/contract.glsl"
#include "shaders/lib/loop.glsl"

struct Hazed {
    vec3 transmittance;
    vec3 scattered;  // to the viewer, W/(sr m^2)
};

// e^x and e^x - 1 of x in [-87, 60], both within 2e-7 of themselves: exp() promises nothing near 0. The
// polynomial is that of Moshier's expf (Cephes).
void exponential(vec3 x, out vec3 whole, out vec3 less_one) {
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

// What the air before something of optical depth `depth` lets through, and 1 less that.
void attenuation(vec3 depth, out vec3 through, out vec3 lost) {
    exponential(-min(depth, vec3(87.0)), through, lost);
    lost = -lost;
}

// The air of `reach` metres that rise by `rise`, in metres of air at height 0. Counted from the lower end,
// where it is densest: no term can overflow, and both directions give the same. The mean over the rise is
// (1 - e^-x) / x.
float airAlong(float height, float rise, float reach, float inverse_height) {
    float low = height + min(rise, 0.0), x = max(abs(rise) * inverse_height, 1e-30);
    vec3 whole, less_one;
    exponential(vec3(clamp(-low * inverse_height, -87.0, 60.0), -min(x, 87.0), 0.0), whole, less_one);
    return min(reach * (whole.x * (-less_one.y / x)), HAZE_OPAQUE_METRES);
}

// Of an endless ray; `up`: the sine of its elevation. Finite upwards alone.
float airBeyond(float height, float up, float inverse_height) {
    vec3 whole, less_one;
    exponential(vec3(clamp(-height * inverse_height, -87.0, 60.0), 0.0, 0.0), whole, less_one);
    return up > 0.0 ? min(whole.x / max(up * inverse_height, 1e-30), HAZE_OPAQUE_METRES) : HAZE_OPAQUE_METRES;
}

// Of the sun's light that a ray meets: by molecules, and by aerosols (Cornette and Shanks 1992). The squared
// distance of two unit vectors is exact where their cosine is near 1.
void phases(Haze h, vec3 away, out vec3 rayleigh, out vec3 mie) {
    vec3 apart = away - h.to_sun;
    float d2 = dot(apart, apart), cosine = 1.0 - 0.5 * d2, k = h.phase_0 + h.phase_1 * d2;
    float both = 1.0 + cosine * cosine;
    rayleigh = h.rayleigh * both;
    mie = h.mie * (both / (k * sqrt(k)));
}

// One height, and a source that is the same all along the ray.
Hazed hazeOfAir(Haze h, float air, vec3 away) {
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

// -ln(1 - z) / z of z in [0, 1).
float logRatio(float z) {
    float w = min(z, 0.9999999);
    return w < 0.01 ? 1.0 + w * (0.5 + w * (0.33333333 + w * 0.25)) : -log(1.0 - w) / w;
}

// A ray through air of one height, as a march places its steps.
struct AirRay {
    float height, up;  // where it begins; sine of its elevation
    float reach, air;  // its length and its air
    float low;         // density at its lower end, over that at height 0
    bool climbs;
};

// A ray that goes down ends where HAZE_ENDLESS_DEPTH is reached, a level one where it is endless too.
AirRay airRay(Haze h, float height, vec3 away, float reach, bool endless) {
    AirRay ray = AirRay(height, away.y, reach, HAZE_OPAQUE_METRES, 0.0, away.y > 0.0);
    float here = exp(clamp(-height * h.inverse_height, -87.0, 60.0));
    float most = HAZE_ENDLESS_DEPTH / h.extinction.x;
    if (!endless)
        ray.air = airAlong(height, away.y * reach, reach, h.inverse_height);
    else if (ray.climbs)
        ray.air = airBeyond(height, away.y, h.inverse_height);
    if (ray.climbs) {
        ray.low = here;
    } else if (ray.air <= most) {
        ray.low = exp(clamp(-(height + away.y * reach) * h.inverse_height, -87.0, 60.0));
    } else {
        ray.air = most;
        float more = most * (-away.y * h.inverse_height);
        ray.low = min(here + more, 1e26);
        float z = more / ray.low, fall = height + log(ray.low) / h.inverse_height;
        ray.reach = z > 0.5 ? fall / -away.y : most / ray.low * logRatio(z);
    }
    return ray;
}

// How far along the ray a share of the steps ends, evenly over the square root of what the mean air lets
// through of what it takes away in all (`lost`): far away, where little comes through, the air is thinner
// than its mean, or lets more of some colours through.
float placeOf(AirRay ray, Haze h, float share, float lost) {
    float z = share * (2.0 - share) * lost, air = min(z * logRatio(z) / h.extinction.x, ray.air);
    float from_low = (ray.climbs ? air : ray.air - air) / ray.low;
    float along = from_low * logRatio(from_low * abs(ray.up) * h.inverse_height);
    return ray.climbs ? along : max(ray.reach - along, 0.0);
}

// The source at a height: what air there scatters to the viewer over what it takes away.
vec3 sourceAt(Haze h, HazeMarch m, float height, vec3 rayleigh_phase, vec3 mie_phase) {
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

// Two heights. Each step adds the source in its middle times what it takes away of the transmittance, as
// Hillaire 2020 does: exact, with however few steps, where the source is constant.
Hazed marchedHaze(Haze h, HazeMarch m, float height, vec3 away, float reach, bool endless) {
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
        float middle = placeOf(ray, h, (i + 0.5) / h.steps, mean_lost.x);
        float end = placeOf(ray, h, (i + 1.0) / h.steps, mean_lost.x);
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
