// SPDX-License-Identifier: MIT
#include "compare/reference/light/environment_costs.h"

#include "compare/reference/scattering/adaptive_sampling.h"
#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/lobe_sampler.h"
#include "shared/scene/model/axes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::reference {
namespace {

using std::numbers::pi;

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Directions that cover the sphere evenly: a Fibonacci spiral.
constexpr int spiral = 2000;
glm::dvec3 onSpiral(int i) {
    const double y = 1 - (2 * i + 1.0) / spiral, s = std::sqrt(1 - y * y),
                 azimuth = i * pi * (3 - std::sqrt(5.0));
    return {s * std::cos(azimuth), y, s * std::sin(azimuth)};
}

// The mean of n.l under GGX if the viewer and the mirror direction coincide with the normal, by the
// distribution of n.h: Walter et al. 2007, equation 35.
double meanCosine(double alpha) {
    constexpr int points = 512;
    double sum = 0;
    for (int i = 0; i < points; ++i) {
        const double u = (i + 0.5) / points, square = (1 - u) / (1 + (alpha * alpha - 1) * u);
        sum += std::max(2 * square - 1, 0.0);
    }
    return sum / points;
}

// A narrower lobe is bounded by one of this width and by a mirror.
constexpr double minFiltered = 1.0 / 64;
// Fractions of the peak: the error of interpolating irradiance linearly between nodes where a light sets,
// and the effect of an error of 1 % in the window.
constexpr double irradianceNodes = 0.02, windowKnown = 0.01;

// The normal whose mirror direction the split sum takes. An anisotropic lobe's is bent toward the plane of
// the viewer and the direction across the lobe (McAuley 2015, "Rendering the World of Far Cry 4"); the
// bend fades as the lobe becomes isotropic or rough.
glm::dvec3 bentNormal(const Surface& s, const Widths& widths) {
    if (widths.isotropic()) return s.normal;
    const glm::dvec3 aside = glm::cross(widths.y, s.to_viewer),
                     bent = unitOr(glm::cross(aside, widths.y), s.normal);
    const double kept = std::pow(1 - s.anisotropy * (1 - std::sqrt(widths.across)), 4);
    return unitOr(glm::mix(bent, s.normal, kept), s.normal);
}

}  // namespace

EnvironmentCosts& EnvironmentCosts::operator+=(const EnvironmentCosts& other) {
    for (std::size_t i = 0; i < diffuse.size(); ++i) {
        diffuse[i] += other.diffuse[i];
        split[i] += other.split[i];
    }
    wider += other.wider;
    sampled += other.sampled;
    lobe += other.lobe;
    return *this;
}

EnvironmentCosts operator*(const EnvironmentCosts& a, double b) {
    EnvironmentCosts result = a;
    for (std::size_t i = 0; i < a.diffuse.size(); ++i) {
        result.diffuse[i] *= b;
        result.split[i] *= b;
    }
    result.wider *= b;
    result.sampled *= b;
    result.lobe *= b;
    return result;
}

// Subdivides pixels so that small maps are resolved. A map with n rows of texels has cells of up to 2 / n
// * 3^(3/4) rad; interpolation between its nodes widens them.
EnvironmentApproximation::EnvironmentApproximation(const EnvironmentLight& light)
    : light_(light), cell_(1.5 * 2 * 2.28 / std::clamp(light.height(), 16, 1024)) {
    const int parts = std::max(1, 512 / light.height()), rows = parts * light.height(),
              columns = std::max(1, 1024 / light.width()) * light.width();
    for (int y = 0; y < rows; ++y) {
        const double solid = 2 * pi / columns * (std::cos(pi * y / rows) - std::cos(pi * (y + 1) / rows));
        for (int x = 0; x < columns; ++x) {
            const glm::dvec3 d =
                light.directionOf((x + 0.5) * light.width() / columns, (y + 0.5) * light.height() / rows);
            const glm::dvec3 here = light.radiance(d) * solid;
            flux_ += here;
            for (std::size_t i = 0; i < 3; ++i) {
                const glm::dvec3 moment = here * d[static_cast<int>(i)];
                vector_[i] += moment;
                for (std::size_t j = 0; j < 3; ++j) tensor_[i][j] += moment * d[static_cast<int>(j)];
            }
        }
    }
    const auto isNegative = [&](double window) {
        for (int i = 0; i < spiral; ++i) {
            const glm::dvec3 e = unclamped(onSpiral(i), window);
            if (std::min({e.x, e.y, e.z}) < 0) return true;
        }
        return false;
    };
    if (isNegative(0)) {
        double low = 0, high = 1e-4;
        while (isNegative(high) && high < 1e4) low = std::exchange(high, 2 * high);
        for (int step = 0; step < 20; ++step) {
            const double middle = (low + high) / 2;
            (isNegative(middle) ? low : high) = middle;
        }
        window_ = high;
    }
    for (int i = 0; i < spiral; ++i) peak_ = std::max(peak_, largest(unclamped(onSpiral(i), 0)));
}

// The clamped cosine over pi up to order 2, with cosine c: (1 + 2 c + 5/8 (3 c^2 - 1)) / (4 pi).
glm::dvec3 EnvironmentApproximation::unclamped(const glm::dvec3& n, double window) const {
    glm::dvec3 first(0), second(0);
    for (std::size_t i = 0; i < 3; ++i) {
        first += vector_[i] * n[static_cast<int>(i)];
        for (std::size_t j = 0; j < 3; ++j)
            second += tensor_[i][j] * (n[static_cast<int>(i)] * n[static_cast<int>(j)]);
    }
    return (flux_ + first * (2 / (1 + 4 * window)) + (second * 3.0 - flux_) * (5.0 / 8 / (1 + 36 * window))) /
           (4 * pi);
}

glm::dvec3 EnvironmentApproximation::irradiance(const glm::dvec3& normal, double window) const {
    return glm::max(unclamped(normal, window), glm::dvec3(0));
}

// Both means use the same samples: by blocks of the map, and by the lobe.
EnvironmentApproximation::Means EnvironmentApproximation::meansOf(const glm::dvec3& normal,
                                                                  const glm::dvec3& mirrored, double alpha,
                                                                  std::uint64_t seed) const {
    const LobeSampler lobe(mirrored, mirrored, alpha);
    const EnvironmentLight::Sampler bright(light_, [&](const glm::dvec3& middle, double reach) {
        return std::max(glm::dot(normal, middle) + reach, 0.0) / pi +
               std::max(glm::dot(mirrored, middle) + reach, 0.0) * (0.02 + lobe.density(middle));
    });
    const double cosine = meanCosine(alpha), wider_alpha = std::min(std::sqrt(2.0) * alpha, 1.0),
                 wider_cosine = meanCosine(wider_alpha);
    const LobeSampler wider(mirrored, mirrored, wider_alpha);
    glm::dvec3 wider_sum(0);
    std::uint64_t samples = 0;
    const auto value = [&](const glm::dvec3& l) -> Reflected {
        const double n_dot_l = std::max(glm::dot(normal, l), 0.0),
                     along = std::max(glm::dot(mirrored, l), 0.0);
        if (!(n_dot_l + along > 0)) return {};
        const double in_lobe = lobe.density(l), density = in_lobe + bright.density(l);
        const glm::dvec3 radiance = light_.radiance(l) / density;
        wider_sum += radiance * (wider.density(l) * along / wider_cosine);
        return {radiance * (n_dot_l / pi), radiance * (in_lobe * along / cosine)};
    };
    std::array<std::array<glm::dvec2, 2>, 8> shifts;
    Random random(seed);
    for (auto& round : shifts)
        for (glm::dvec2& shift : round) {
            const double u = random();
            shift = {u, random()};
        }
    const Estimated means = sampleUntilConfident(
        [&](std::size_t round, std::uint64_t index) {
            ++samples;
            Reflected sum = value(lobe(evenly(index, shifts[round][0])));
            if (bright.all() > 0) sum += value(bright(evenly(index, shifts[round][1])));
            return sum;
        },
        2, 8, 0, 0);
    return {means.value.diffuse, means.value.specular, wider_sum / static_cast<double>(samples),
            surerThan95 * means.uncertainty};
}

// The range of radiance within `reach` of a direction, with about one point per pixel.
double EnvironmentApproximation::range(const glm::dvec3& direction, double reach) const {
    const glm::dvec3 x = perpendicularTo(direction), y = glm::cross(direction, x);
    const int steps = std::clamp(static_cast<int>(std::ceil(reach * light_.height() / pi)), 2, 12);
    glm::dvec3 min = light_.radiance(direction), max = min;
    for (int j = -steps; j <= steps; ++j)
        for (int i = -steps; i <= steps; ++i) {
            if (i * i + j * j > steps * steps) continue;
            const glm::dvec3 here = light_.radiance(
                glm::normalize(direction + (x * double(i) + y * double(j)) * (reach / steps)));
            min = glm::min(min, here);
            max = glm::max(max, here);
        }
    return largest(max - min);
}

EnvironmentApproximation::Taken EnvironmentApproximation::takenAs(IblDiffuse kind, const glm::dvec3& normal,
                                                                  const Means& means) const {
    switch (kind) {
        case IblDiffuse::map:
            return {means.irradiance, means.uncertainty + irradianceNodes * peak_};
        case IblDiffuse::sh_windowed:
            return {irradiance(normal, window_), windowKnown * peak_};
        case IblDiffuse::sh:
            break;
    }
    return {irradiance(normal, 0), 0};
}

// The paths take the sheen's albedo times irradiance / pi, whether they sample the other lobes or not.
EnvironmentCosts EnvironmentApproximation::sheenCosts(const Surface& sheen, const glm::dvec3& exact,
                                                      std::uint64_t seed) const {
    const Means means = meansOf(sheen.normal, sheen.normal, 1, seed);
    const glm::dvec3 albedo = specularAlbedo(sheen);
    EnvironmentCosts costs;
    for (std::size_t i = 0; i < costs.split.size(); ++i) {
        const Taken here = takenAs(static_cast<IblDiffuse>(i), sheen.normal, means);
        costs.split[i] = largest(albedo * here.irradiance - exact) + largest(albedo) * here.open;
    }
    costs.sampled = *std::ranges::max_element(costs.split);
    return costs;
}

namespace {

// Albedos that the paths take: under a film, its Fresnel term at the cosine where Schlick's weight is the
// mean over the lobe, or over light that meets the base.
struct TakenAlbedos {
    glm::dvec3 base, lobe;
};
TakenAlbedos albedosOf(const Surface& surface, const Surface& isotropic, const Compensation& compensation) {
    Compensation of_base = compensation, of_lobe = compensation;
    of_lobe.between = glm::dvec3(0);
    if (surface.iridescence > 0) {
        Surface black = withoutFilm(isotropic);
        black.metallic = 1;
        black.albedo = glm::dvec3(0);
        Surface white = black;
        white.albedo = glm::dvec3(1);
        const double weight = specularAlbedo(black).r / specularAlbedo(white).r;
        of_lobe.film_cosine = 1 - std::pow(weight, 0.2);
        Surface matt = white;
        matt.metallic = matt.transmission = 0;
        matt.dielectric_f0 = glm::dvec3(0);
        matt.dielectric_f90 = 1;
        of_base.film_cosine = 1 - std::pow(std::max(1 - diffuseAlbedo(matt).r, 0.0), 0.2);
    }
    return {diffuseAlbedo(surface, of_base), specularAlbedo(isotropic, of_lobe)};
}

}  // namespace

EnvironmentCosts EnvironmentApproximation::costs(const Surface& surface, const Compensation& compensation,
                                                 const Reflected& exact, std::uint64_t seed) const {
    if (hasSheen(surface)) return sheenCosts(surface, exact.specular, seed);
    const Widths widths = widthsOf(surface);
    const glm::dvec3 n = surface.normal, middle = bentNormal(surface, widths),
                     mirrored = glm::normalize(middle * (2 * glm::dot(middle, surface.to_viewer)) -
                                               surface.to_viewer);
    const double alpha = widths.mean();
    const Means means = meansOf(n, mirrored, alpha, seed);
    const auto [base, lobe] =
        albedosOf(surface, isotropic(surface, widthTowards(widths, surface.to_viewer)), compensation);
    const glm::dvec3 between = compensation.between;
    // For lobes much wider than a cell, the change across a cell falls by the square of their ratio.
    const double coarse =
        range(mirrored, cell_) * std::min(1.0, cell_ * cell_ / (4 * widths.across * widths.across));
    double filtered = coarse;
    if (alpha < minFiltered) {
        const Means first = meansOf(n, mirrored, minFiltered, streamOf(seed, 1));
        filtered += largest(first.mirrored - means.mirrored) + first.uncertainty +
                    largest(light_.radiance(mirrored) - means.mirrored);
    }
    EnvironmentCosts costs;
    costs.lobe = largest(exact.specular);
    double apart = 0;
    for (std::size_t i = 0; i < costs.diffuse.size(); ++i) {
        const auto [taken, open] = takenAs(static_cast<IblDiffuse>(i), n, means);
        costs.diffuse[i] = largest(base * taken - exact.diffuse) + largest(base) * open;
        costs.split[i] = largest(lobe * means.mirrored + between * taken - exact.specular) +
                         largest(lobe) * (means.uncertainty + filtered) + largest(between) * open;
        apart = std::max(apart, largest(taken - means.irradiance) + open);
    }
    if (surface.diffuse_transmission > 0) {
        const Surface back = behind(surface);
        const Means about = meansOf(back.normal, back.normal, 1, streamOf(seed, 2));
        const glm::dvec3 albedo = albedosOf(back, isotropic(back), compensation).base;
        for (std::size_t i = 0; i < costs.diffuse.size(); ++i) {
            const auto [taken, open] = takenAs(static_cast<IblDiffuse>(i), back.normal, about);
            costs.diffuse[i] += largest(albedo * taken - exact.transmitted) + largest(albedo) * open;
        }
    }
    costs.wider = largest(lobe) * largest(means.wider - means.mirrored);
    costs.sampled = largest(lobe) * coarse;
    if (largest(between) > 0) costs.sampled += largest(between) * (apart + means.uncertainty);
    return costs;
}

}  // namespace diptych::reference
