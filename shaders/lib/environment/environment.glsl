// SPDX-License-Identifier: MIT
// Environment lighting. The base reflects the environment's irradiance. The specular lobe reads the map
// prefiltered along the mirrored direction (shared/environment/prefilter.h; Karis 2013, "Real Shading in
// Unreal Engine 4"), or samples it.
#ifndef ENVIRONMENT_GLSL
#define ENVIRONMENT_GLSL

#include "shaders/lib/shading/ambient.glsl"
#include "shaders/lib/surface/octahedral.glsl"
#include "shaders/lib/environment/sky.glsl"

layout(set = SET_FRAME, binding = BINDING_ENVIRONMENT_MAPS) uniform sampler2D environment_maps;

// Coordinates of a direction in an octahedral map, in [-1, 1]^2; +Y is in the centre.
vec2 octahedralPosition(const vec3 d) {
    vec2 p = d.xz * (1.0 / (abs(d.x) + abs(d.y) + abs(d.z)));
    if (d.y < 0.0) p = octahedralWrap(p);
    return p;
}

vec3 mapTexel(const ivec2 p) { return texelFetch(environment_maps, p, 0).rgb; }

// `map`: corner of the map's nodes, and nodes per side. Interpolates linearly over the two triangles of a
// cell, split along the diagonal where the map folds (shared/environment/octahedral_map.h).
vec3 mapRadiance(const vec3 map, const vec2 position) {
    vec2 at = (position * 0.5 + 0.5) * (map.z - 1.0);
    vec2 corner = clamp(floor(at), vec2(0.0), vec2(map.z - 2.0)), f = at - corner;
    ivec2 c = ivec2(map.xy + corner);
    bool rising = position.x * position.y >= 0.0;  // the fold runs from the cell's right to its bottom
    f.y = rising ? f.y : 1.0 - f.y;          // else mirror the cell
    int first = rising ? 0 : 1;
    float beyond = f.x + f.y - 1.0;
    bool far = beyond >= 0.0;
    vec3 off = mapTexel(c + (far ? ivec2(1, 1 - first) : ivec2(0, first)));
    vec3 right = mapTexel(c + ivec2(1, first)), down = mapTexel(c + ivec2(0, 1 - first));
    return off * abs(beyond) + right * (far ? 1.0 - f.y : f.x) + down * (far ? 1.0 - f.x : f.y);
}

// Interpolates between two levels; clamps at the first and the last.
vec3 levelRadiance(float level, const vec2 position) {
    float levels = environmentRotation().w;
    level = clamp(level, 0.0, levels - 1.0);
    float lower = min(floor(level), levels - 2.0);
    int first = int(ENVIRONMENT_TEXEL_LEVELS) + int(lower);
    vec3 fine = mapRadiance(texelFetch(environment_texels, first).xyz, position);
    vec3 coarse = mapRadiance(texelFetch(environment_texels, first + 1).xyz, position);
    return blend(fine, coarse, level - lower);
}

// Level for a GGX width; level 0 has the smallest width that is shaded.
float specularLevel(const float alpha) {
    float first = log2(ENVIRONMENT_FIRST_ALPHA), smallest = 2.0 * log2(MIN_PERCEPTUAL_ROUGHNESS);
    float octaves = log2(alpha);
    return octaves < first ? (octaves - smallest) / (first - smallest)
                           : 1.0 + float(ENVIRONMENT_LEVELS_AN_OCTAVE) * (octaves - first);
}

vec4 harmonic(const int i) { return texelFetch(environment_texels, int(ENVIRONMENT_TEXEL_HARMONICS) + i); }

// Irradiance over pi, W/(sr m^2); `n` in world axes. Harmonics ring around hard light, so negative values
// are clamped to 0.
vec3 environmentIrradiance(const vec3 n) {
    if (on(feature_environment & ENVIRONMENT_DIFFUSE_MAP))
        return mapRadiance(texelFetch(environment_texels, int(ENVIRONMENT_TEXEL_DIFFUSE)).xyz,
                           octahedralPosition(environmentFromWorld(n)));
    vec4 one = harmonic(0), y = harmonic(1), z = harmonic(2), x = harmonic(3);
    vec4 xy = harmonic(4), yz = harmonic(5);
    vec3 e = one.rgb + y.rgb * n.y + z.rgb * n.z + x.rgb * n.x;
    e += xy.rgb * (n.x * n.y) + yz.rgb * (n.y * n.z) + harmonic(6).rgb * (3.0 * n.z * n.z - 1.0);
    e += vec3(one.w, y.w, z.w) * (n.x * n.z) + vec3(x.w, xy.w, yz.w) * (n.x * n.x - n.y * n.y);
    return max(e, vec3(0.0));
}

// GGX's Lambda (Heitz 2014, equation 72).
float smithLambda(const float alpha2, const float cosine) {
    float c2 = cosine * cosine;
    return 0.5 * (sqrt(1.0 + alpha2 * max(1.0 - c2, 0.0) / c2) - 1.0);
}
// `w`: unit vector; its components along the lobe, across it and along the normal.
float smithLambda(const Brdf b, const vec3 w) {
    vec2 wide = w.xy * b.alphas;
    float stretched = 0.5 * (sqrt(1.0 + dot(wide, wide) / (w.z * w.z)) - 1.0);
    return b.anisotropic ? stretched : smithLambda(b.alpha2, w.z);
}

// Environment light that the lobe reflects to `v`, by sampling visible normals (Heitz 2018, "Sampling the
// GGX Distribution of Visible Normals"). Each sample reads the level whose texels match its solid angle.
// Hammersley points, the same at every pixel, avoid noise.
vec3 sampledSpecular(const Brdf b, const vec3 n, const vec3 v) {
    vec3 x, y;
    axesAcross(n, x, y);
    vec2 alphas = vec2(b.alpha);
    if (b.anisotropic) x = b.along, y = b.across, alphas = b.alphas;
    float mu = min(b.n_dot_v, 1.0);
    vec3 seen = vec3(dot(v, x), dot(v, y), mu);
    vec3 up = normalized(vec3(alphas * seen.xy, seen.z));
    float across2 = dot(up.xy, up.xy);
    vec3 t1 = across2 > 1e-12 ? vec3(-up.y, up.x, 0.0) / sqrt(across2) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = crossProduct(up, t1);
    vec4 first = texelFetch(environment_texels, int(ENVIRONMENT_TEXEL_LEVELS));
    float lambda_v = smithLambda(b, seen), count = first.w;
    float bias = texelFetch(environment_texels, int(ENVIRONMENT_TEXEL_DIFFUSE)).w;
    vec3 sum = vec3(0.0);
    for (float i = 0.0; i < count; i += 1.0) {
        float u = (i + 0.5) / count;
        float turn = (float(bitfieldReverse(uint(i))) / 4294967296.0 + 0.5 / count) * 2.0 * PI;
        float radius = sqrt(u), p1 = radius * cos(turn), p2 = radius * sin(turn), s = 0.5 * (1.0 + up.z);
        p2 = (1.0 - s) * sqrt(max(1.0 - p1 * p1, 0.0)) + s * p2;
        vec3 h = t1 * p1 + t2 * p2 + up * sqrt(max(1.0 - p1 * p1 - p2 * p2, 0.0));
        h = normalized(vec3(alphas * h.xy, max(h.z, 1e-6)));
        float v_dot_h = max(dot(seen, h), 0.0);
        vec3 l = h * (2.0 * v_dot_h) - seen;
        float k = h.z * h.z * b.alpha2 + dot(h.xy, h.xy);
        if (b.anisotropic)
            k = h.z * h.z * b.alpha2 + h.x * h.x * (alphas.y / alphas.x) + h.y * h.y * (alphas.x / alphas.y);
        float density = b.alpha2 * INVERSE_PI / (k * k * 4.0 * mu * (1.0 + lambda_v));
        vec3 d = environmentFromWorld(x * l.x + y * l.y + n * l.z);
        float l1 = abs(d.x) + abs(d.y) + abs(d.z);
        float level = 0.5 * log2(first.z * first.z / (4.0 * count * density * l1 * l1 * l1)) + bias;
        float masking = (1.0 + lambda_v) / (1.0 + lambda_v + smithLambda(b, vec3(l.xy, max(l.z, 1e-6))));
        vec3 fresnel = layeredAt(b, v_dot_h).lobe;
        vec3 radiance = levelRadiance(level, octahedralPosition(d)) * fresnel * masking;
        sum += l.z > 0.0 ? radiance : vec3(0.0);
    }
    return sum / count;
}

// Normal about which a stretched lobe is mirrored: bent from the surface's to the plane of the view and the
// direction across (McAuley 2015, "Rendering the World of Far Cry 4"), less for rough lobes.
vec3 bentNormal(const Brdf b, const vec3 n, const vec3 v, const float strength) {
    vec3 bent = v - b.across * b.viewed.y;
    float length2 = dot(bent, bent), weight = 1.0 - strength * (1.0 - sqrt(b.alphas.y));
    weight *= weight;
    vec3 between = blend(bent * inversesqrt(max(length2, 1e-12)), n, weight * weight);
    return length2 > 1e-12 ? normalized(between) : n;
}

// Environment light that the lobe reflects to the viewer, times `factor`. `strength`: of its anisotropy.
vec3 lobeEnvironment(const Reflector r, const float strength, const float factor) {
    vec3 from_lobe, mirror = r.n;
    if (hasLayer(LAYER_ANISOTROPY) && r.brdf.anisotropic) mirror = bentNormal(r.brdf, r.n, r.v, strength);
    vec3 mirrored = environmentFromWorld(reflection(-r.v, mirror));
    if (on(feature_environment & ENVIRONMENT_SAMPLED))
        from_lobe = sampledSpecular(r.brdf, r.n, r.v) * factor;
    else
        from_lobe =
            r.lobe_fraction * levelRadiance(specularLevel(r.brdf.alpha), octahedralPosition(mirrored)) *
            factor;
    return from_lobe;
}

#endif
