// SPDX-License-Identifier: MIT
// One listed point light at one pixel, optimized for the CPU. Follows shaders/lib/shading/brdf.glsl and
// punctual_lights.glsl function by function. Shades 8 pixels per vector; broadcasts lights from memory and
// keeps sums in registers. A test compares its image with the shaders'.
#include "tests/bench/kernel_avx2.h"

#if defined(__AVX2__) && defined(__FMA__)

#include "shared/contract/constants.h"

#include <immintrin.h>

namespace diptych::kernels {
namespace {

using Float = float __attribute__((vector_size(32)));

Float splat(float value) {
    return _mm256_set1_ps(value);
}
Float root(Float v) {
    return _mm256_sqrt_ps(v);
}
Float larger(Float a, Float b) {
    return _mm256_max_ps(a, b);
}
Float clamped(Float v) {
    return _mm256_min_ps(_mm256_max_ps(v, splat(0)), splat(1));
}
// a where x > y, else b.
Float whereGreater(Float x, Float y, Float a, Float b) {
    return _mm256_blendv_ps(b, a, _mm256_cmp_ps(x, y, _CMP_GT_OQ));
}

struct Vec3 {
    Float x, y, z;
};
Float dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 scaled(const Vec3& v, Float s) {
    return {v.x * s, v.y * s, v.z * s};
}
Vec3 normalized(const Vec3& v) {
    return scaled(v, 1.0f / root(dot(v, v)));
}

struct Brdf {
    Vec3 diffuse, f0;
    float f90, base_f0, base_f90;
    Float alpha, alpha2, n_dot_v, smith_v;
};

Float ggxDenominator(Float alpha2, const Vec3& n, const Vec3& s) {
    const Vec3 n_cross_s = cross(n, s);
    const Float n_dot_s = dot(n, s);
    return dot(n_cross_s, n_cross_s) + n_dot_s * n_dot_s * alpha2;
}

Float specularLobe(const Brdf& b, const Vec3& n, const Vec3& s, Float s2, Float n_dot_l) {
    const Float q = ggxDenominator(b.alpha2, n, s);
    const Float lambda =
        n_dot_l * b.smith_v + b.n_dot_v * root(n_dot_l * n_dot_l * (1.0f - b.alpha2) + b.alpha2);
    const Float a = b.alpha * s2;
    const Float lobe = a * a * (0.5f * gpu::INVERSE_PI) / larger(q * q * lambda, splat(1e-37f));
    return whereGreater(dot(n, s), splat(0), whereGreater(s2, splat(1e-12f), lobe, splat(0)), splat(0));
}

Float schlickWeight(Float v_dot_h) {
    const Float x = clamped(1.0f - v_dot_h), x2 = x * x;
    return x2 * x2 * x;
}

// kernelSurface() and makeBrdf() at pixel centres.
struct Pixels {
    Vec3 position, normal, view;
    Brdf brdf;
};

void addLight(const Pixels& p, const Vec3& l, const Vec3& irradiance, Vec3& diffuse, Vec3& specular) {
    const Brdf& b = p.brdf;
    const Vec3 &n = p.normal, &v = p.view;
    const Float n_dot_l = clamped(dot(n, l));
    const Vec3 s{l.x + v.x, l.y + v.y, l.z + v.z};
    const Float s2 = dot(s, s);
    const Float weight = schlickWeight(0.5f * root(s2));
    const Float base = 1.0f - (b.base_f0 + (b.base_f90 - b.base_f0) * weight);
    const Float lobe = specularLobe(b, n, s, s2, n_dot_l);
    const Vec3 received = scaled(irradiance, n_dot_l);
    diffuse.x += b.diffuse.x * base * received.x;
    diffuse.y += b.diffuse.y * base * received.y;
    diffuse.z += b.diffuse.z * base * received.z;
    specular.x += (b.f0.x + (b.f90 - b.f0.x) * weight) * lobe * received.x;
    specular.y += (b.f0.y + (b.f90 - b.f0.y) * weight) * lobe * received.y;
    specular.z += (b.f0.z + (b.f90 - b.f0.z) * weight) * lobe * received.z;
}

Pixels pixelsAt(Float x, Float y) {
    const Float u = x * (1.0f / 1024.0f), v = y * (1.0f / 1024.0f);
    const Float roughness = larger(0.3f + 0.5f * u, splat(gpu::MIN_PERCEPTUAL_ROUGHNESS));
    constexpr float metallic = 0.25f, dielectric = 0.04f, albedo[3] = {0.5f, 0.6f, 0.7f};
    const auto base = [&](int i) { return splat((1 - metallic) * albedo[i] * gpu::INVERSE_PI); };
    const auto f0 = [&](int i) { return splat(dielectric * (1 - metallic) + albedo[i] * metallic); };
    Pixels p;
    p.position = {8.0f * (u - 0.3f), 8.0f * (v - 0.2f), -6.0f - u * v};
    p.normal = normalized({0.4f * (u - 0.3f), 0.6f * (v - 0.2f), splat(1)});
    p.view = normalized({-p.position.x, -p.position.y, -p.position.z});
    p.brdf = {{base(0), base(1), base(2)},
              {f0(0), f0(1), f0(2)},
              1,
              dielectric,
              1,
              roughness * roughness,
              splat(0),
              larger(dot(p.normal, p.view), splat(gpu::MIN_N_DOT_V)),
              splat(0)};
    p.brdf.alpha2 = p.brdf.alpha * p.brdf.alpha;
    p.brdf.smith_v = root(p.brdf.n_dot_v * p.brdf.n_dot_v * (1.0f - p.brdf.alpha2) + p.brdf.alpha2);
    return p;
}

}  // namespace

void shadeTileAvx2(const KernelTile& tile) {
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 16; column += 8) {
            const Float lanes = {0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f};
            const Pixels p = pixelsAt(static_cast<float>(tile.x + column) + lanes,
                                      splat(static_cast<float>(tile.y + row) + 0.5f));
            Vec3 diffuse{}, specular{};
            for (int i = 0; i < tile.count; ++i) {
                const float* light = tile.lights + std::size_t{tile.indices[i]} * 8;
                const Vec3 to_light{light[0] - p.position.x, light[1] - p.position.y,
                                    light[2] - p.position.z};
                const Float d2 = larger(dot(to_light, to_light), splat(gpu::MIN_LIGHT_DISTANCE_SQUARED));
                const Float x = d2 * light[3];
                const Float window = whereGreater(splat(1), x, 1.0f - x * x, splat(0));
                const Float inverse = 1.0f / root(d2), strength = window * (inverse * inverse);
                addLight(p, scaled(to_light, inverse),
                         {light[4] * strength, light[5] * strength, light[6] * strength}, diffuse, specular);
            }
            const Float lit[3] = {diffuse.x + specular.x, diffuse.y + specular.y, diffuse.z + specular.z};
            float* to =
                tile.row + static_cast<std::size_t>(row) * tile.stride + static_cast<std::size_t>(column) * 3;
            for (int lane = 0; lane < 8; ++lane)
                for (int channel = 0; channel < 3; ++channel) to[lane * 3 + channel] = lit[channel][lane];
        }
}

}  // namespace diptych::kernels

#else

namespace diptych::kernels {

void shadeTileAvx2(const KernelTile&) {}

}  // namespace diptych::kernels

#endif
