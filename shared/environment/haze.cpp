// SPDX-License-Identifier: MIT
#include "shared/environment/haze.h"

#include "shared/contract/bindings.h"
#include "shared/contract/features.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>

namespace diptych {

namespace {

// Scattering over extinction of aerosols (Bruneton and Neyret 2008).
constexpr double mieAlbedo = 0.9;

glm::dvec3 doubles(const Rgb& c) {
    return {double{c.r}, double{c.g}, double{c.b}};
}
double sum(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}
// Extinction that determines the steps: the smallest component, which transmits farthest, but at least an
// eighth of the largest.
double seenFarthest(const glm::dvec3& extinction) {
    const double largest = std::max({extinction.x, extinction.y, extinction.z});
    return std::max(std::min({extinction.x, extinction.y, extinction.z}), largest / 8);
}
// 0 without extinction.
glm::dvec3 fractionOf(const glm::dvec3& scattered, const glm::dvec3& extinction) {
    glm::dvec3 fraction(0);
    for (int c = 0; c < 3; ++c)
        if (extinction[c] > 0) fraction[c] = scattered[c] / extinction[c];
    return fraction;
}

}  // namespace

HazeNumbers hazeNumbers(const Settings& settings, const Light* sun, const glm::dvec3& eye) {
    const double density = double{settings.haze_density}, g = double{settings.haze_g};
    const glm::dvec3 rayleigh = doubles(settings.haze_rayleigh) * density,
                     mie = doubles(settings.haze_mie) * density, mieExtinction = mie / mieAlbedo,
                     extinction = rayleigh + mieExtinction, ambient = doubles(settings.ambient);
    if (!settings.haze || !(sum(extinction) > 0)) return {};
    HazeNumbers numbers{.feature = gpu::HAZE_THERE};
    const double rayleighHeight = double{settings.haze_rayleigh_height},
                 mieHeight = double{settings.haze_mie_height};
    // Scale height with the same optical depth above height 0 as both media together.
    const double height = (sum(rayleigh) * rayleighHeight + sum(mieExtinction) * mieHeight) / sum(extinction);
    const double eyeHeight = eye.y - double{settings.haze_ground};
    const bool marched = settings.haze_march_steps > 0;
    if (marched) numbers.feature |= gpu::HAZE_MARCHED;

    glm::dvec3 rayleighSource(0), mieSource(0), toSun(0, 1, 0);
    double sunUp = 0;
    if (sun && sun->direction.y < 0) {
        numbers.feature |= gpu::HAZE_SUN;
        toSun = -sun->direction;
        sunUp = toSun.y;
        const glm::dvec3 irradiance = glm::dvec3(sun->color) * double{sun->intensity};
        rayleighSource = irradiance * (3 / (16 * std::numbers::pi));
        mieSource = irradiance * (3 / (8 * std::numbers::pi) * (1 - g * g) / (2 + g * g));
        if (!marched) {
            const glm::dvec3 above = extinction * (height * std::exp(-eyeHeight / height) / sunUp);
            const glm::dvec3 sunlight = glm::exp(-above);
            rayleighSource *= sunlight * fractionOf(rayleigh, extinction);
            mieSource *= sunlight * fractionOf(mie, extinction);
        }
    }
    if (ambient != glm::dvec3(0)) numbers.feature |= gpu::HAZE_AMBIENT;
    numbers.haze = {
        .extinction = glm::vec3(marched ? glm::dvec3(seenFarthest(extinction)) : extinction),
        .inverse_height = static_cast<float>(1 / height),
        .to_sun = glm::vec3(toSun),
        .camera_height = static_cast<float>(eyeHeight),
        .rayleigh = glm::vec3(rayleighSource),
        .phase_0 = static_cast<float>((1 - g) * (1 - g)),
        .mie = glm::vec3(mieSource),
        .phase_1 = static_cast<float>(g),
        .ambient = glm::vec3(marched ? ambient : ambient * fractionOf(rayleigh + mie, extinction)),
        .steps = static_cast<float>(settings.haze_march_steps)};
    if (marched)
        numbers.march = {.rayleigh = glm::vec3(rayleigh),
                         .rayleigh_inverse = static_cast<float>(1 / rayleighHeight),
                         .mie = glm::vec3(mie),
                         .mie_inverse = static_cast<float>(1 / mieHeight),
                         .mie_extinction = glm::vec3(mieExtinction),
                         .inverse_sun_up = static_cast<float>(sunUp > 0 ? 1 / sunUp : 0)};
    return numbers;
}

Haze::Haze(Device& device, Uploader& uploader, const Settings& settings, const Light* sun,
           const glm::dvec3& eye, DescriptorSets& frame) {
    const HazeNumbers numbers = hazeNumbers(settings, sun, eye);
    feature_ = numbers.feature;
    if (feature_ == 0) return;
    struct {
        gpu::Haze haze;
        gpu::HazeMarch march;
    } both{numbers.haze, numbers.march};
    using Texels = std::array<glm::vec4, gpu::HAZE_TEXELS + gpu::HAZE_MARCH_TEXELS>;
    const Texels texels = std::bit_cast<Texels>(both);
    const bool marched = (feature_ & gpu::HAZE_MARCHED) != 0;
    texels_ = makeBuffer<glm::vec4>(device, uploader, "haze",
                                    std::span(texels).first(marched ? texels.size() : gpu::HAZE_TEXELS),
                                    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    uploader.flush();
    texels_view_ = makeTexelView(device, "haze", texels_, VK_FORMAT_R32G32B32A32_SFLOAT);
    frame.texels(0, gpu::BINDING_HAZE, texels_view_);
}

}  // namespace diptych
