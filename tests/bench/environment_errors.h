// SPDX-License-Identifier: MIT
// Error of each step from an environment to reflected radiance, in double: integrals over all directions
// of the image, with the reference's BRDF, compared with the maps and the table as
// shaders/lib/environment/environment.glsl reads them.
#pragma once

#include "compare/reference/light/environment.h"
#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"
#include "shared/contract/albedo.h"
#include "shared/contract/constants.h"
#include "shared/contract/environment.h"
#include "shared/environment/directional_albedo.h"
#include "shared/environment/environment_maps.h"
#include "tests/support/cubic.h"

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace diptych::environment_errors {

// ---- procedural environments -----------------------------------------------------------------------

template <class Radiance>
Environment paintedBy(int height, const Radiance& radiance) {
    Environment sky{"sky", Image(2 * height, height, 3)};
    const LatLong image(sky);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 2 * height; ++x) {
            const glm::dvec3 color = radiance(image.direction(x, y));
            for (int c = 0; c < 3; ++c) sky.radiance.at(x, y, c) = static_cast<float>(color[c]);
        }
    return sky;
}

// Blue above, bright at the horizon and around a hazy sun, dim below; W/(sr m^2).
inline glm::dvec3 smoothRadiance(const glm::dvec3& d) {
    const double above = 1 / (1 + std::exp(-12 * d.y)), low = std::exp(-4 * std::abs(d.y));
    const double glow = std::exp(6 * (glm::dot(d, glm::normalize(glm::dvec3(0.5, 0.6, -0.4))) - 1));
    return glm::dvec3(0.25, 0.45, 0.9) * above + glm::dvec3(0.25, 0.2, 0.15) * (1 - above) +
           glm::dvec3(0.8) * low + glm::dvec3(3, 2.6, 2) * glow;
}
inline Environment smoothSky(int height) {
    return paintedBy(height, smoothRadiance);
}
// The same with a light of 5 degrees diameter, whose edge is one pixel wide.
inline Environment lampSky(int height) {
    const glm::dvec3 lamp = glm::normalize(glm::dvec3(-0.6, 0.5, 0.3));
    const double radius = 2.5 * std::numbers::pi / 180, edge = std::numbers::pi / height;
    return paintedBy(height, [&](const glm::dvec3& d) {
        const double angle = std::acos(std::clamp(glm::dot(d, lamp), -1.0, 1.0));
        return smoothRadiance(d) + glm::dvec3(400 * std::clamp(0.5 + (radius - angle) / edge, 0.0, 1.0));
    });
}

// ---- integrals over all directions -----------------------------------------------------------------

class AllDirections {
public:
    explicit AllDirections(const Environment& environment)
        : light_(environment, 1), width_(light_.width()), height_(light_.height()) {
        constexpr std::array<double, 3> fraction{0.125, 0.75, 0.125};
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                glm::dvec3 mean(0);  // of the bilinear interpolation over the pixel
                for (std::size_t j = 0; j < 3; ++j)
                    for (std::size_t i = 0; i < 3; ++i)
                        mean += light_.radiance(light_.directionOf(x - 0.5 + static_cast<double>(i),
                                                                   y - 0.5 + static_cast<double>(j))) *
                                (fraction[i] * fraction[j]);
                pixels_.push_back({light_.directionOf(x + 0.5, y + 0.5), mean});
            }
    }

    // Integral of radiance times `kernel`. The kernel changes over scale / widest * max(widest, half the
    // distance from `middle`), in distances of unit vectors; pixels are subdivided accordingly.
    struct Place {
        glm::dvec3 middle;
        double scale, widest;
    };
    template <class Kernel>
    glm::dvec3 integral(const Place& at, const Kernel& kernel) const {
        glm::dvec3 sum(0);
        const double step = std::numbers::pi / height_;
        for (int y = 0; y < height_; ++y) {
            const double solid = solidOf(y, y + 1, width_, height_);
            for (int x = 0; x < width_; ++x) {
                const Pixel& pixel = pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                             static_cast<std::size_t>(x)];
                const double away = glm::length(pixel.direction - at.middle);
                const double over = at.scale / at.widest * std::max(at.widest, 0.5 * (away - 2 * step));
                const int parts = std::clamp(static_cast<int>(std::ceil(3 * step / over)), 1, 12);
                if (parts == 1)
                    sum += pixel.radiance * (kernel(pixel.direction) * solid);
                else
                    sum += divided(x, y, parts, kernel);
            }
        }
        return sum;
    }

    const reference::EnvironmentLight& light() const { return light_; }

private:
    struct Pixel {
        glm::dvec3 direction, radiance;
    };
    static double solidOf(double top, double bottom, int columns, int rows) {
        using std::numbers::pi;
        return 2 * pi / columns * (std::cos(pi * top / rows) - std::cos(pi * bottom / rows));
    }
    template <class Kernel>
    glm::dvec3 divided(int x, int y, int parts, const Kernel& kernel) const {
        glm::dvec3 sum(0);
        for (int j = 0; j < parts; ++j) {
            const double top = y + static_cast<double>(j) / parts, bottom = y + (j + 1.0) / parts;
            const double solid = solidOf(top, bottom, width_ * parts, height_);
            for (int i = 0; i < parts; ++i) {
                const glm::dvec3 d = light_.directionOf(x + (i + 0.5) / parts, (top + bottom) / 2);
                const double weight = kernel(d);
                if (weight != 0) sum += light_.radiance(d) * (weight * solid);
            }
        }
        return sum;
    }

    reference::EnvironmentLight light_;
    int width_, height_;
    std::vector<Pixel> pixels_;
};

// ---- values that the shaders read ------------------------------------------------------------------

// As levelRadiance() and specularLevel() of shaders/lib/environment/environment.glsl.
inline glm::dvec3 filteredRadiance(const EnvironmentMaps& maps, double alpha, const glm::dvec3& direction) {
    const double first = std::log2(double{gpu::ENVIRONMENT_FIRST_ALPHA}),
                 min = 2 * std::log2(double{gpu::MIN_PERCEPTUAL_ROUGHNESS}), octaves = std::log2(alpha);
    const double level = octaves < first ? (octaves - min) / (first - min)
                                         : 1 + double{gpu::ENVIRONMENT_LEVELS_AN_OCTAVE} * (octaves - first);
    const double lower = std::min(std::floor(level), static_cast<double>(maps.levels.size() - 2));
    const auto index = static_cast<std::size_t>(lower);
    const glm::vec2 position = octahedralPosition(glm::vec3(direction));
    const glm::dvec3 fine(maps.levels[index].interpolated(position)),
        coarse(maps.levels[index + 1].interpolated(position));
    return fine + (coarse - fine) * (level - lower);
}

// As specularAlbedo() of shaders/lib/shading/ambient.glsl, where F = 1.
inline double tabledAlbedo(double alpha, double n_dot_v) {
    constexpr int width = gpu::ALBEDO_TABLE_WIDTH, height = gpu::ALBEDO_TABLE_HEIGHT;
    const std::vector<glm::vec2>& table = directionalAlbedoTable();
    const double k = 2 * alpha, blend = double{gpu::ALBEDO_BLEND},
                 min = std::sqrt(double{gpu::MIN_PERCEPTUAL_ROUGHNESS});
    const double along =
        blend * std::sqrt(n_dot_v * (1 + k) / (n_dot_v + k)) + (1 - blend) * std::sqrt(n_dot_v);
    const double down = (std::sqrt(std::sqrt(alpha)) - min) / (1 - min);
    return cubicAt(down * (height - 1), height, [&](int y) {
        return cubicAt(along * (width - 1), width, [&](int x) {
            const glm::vec2 t = table[static_cast<std::size_t>(y * width + x)];
            return double{t.x} + double{t.y};
        });
    });
}

// ---- errors ------------------------------------------------------------------------------------------

// RMS over surfaces, relative to the mean reflected radiance. Each step is compared with the step before,
// everything else exact; `all` compares all steps with the integral. `worst_filtered`: largest relative
// error of a prefiltered value.
struct SpecularErrors {
    double split = 0, prefilter = 0, table = 0, all = 0, mean = 0, worst_filtered = 0;
    double steps() const { return prefilter + table; }
};

// Midpoints of n.v intervals, each with the same number of a sphere's visible points.
inline const std::vector<double> sphereAngles{0.935, 0.791, 0.612, 0.354};

// White metals of this roughness and n.v. Their mirror directions are `count` uniform directions.
inline SpecularErrors specularErrors(const AllDirections& sky, const EnvironmentMaps& maps, double roughness,
                                     const std::vector<double>& n_dot_v, std::size_t count,
                                     std::vector<SpecularErrors>* by_angle = nullptr) {
    using glm::dvec3;
    const double alpha = roughness * roughness, alpha2 = alpha * alpha;
    struct Terms {
        dvec3 exact, split, filtered, ours, table;
    };
    std::vector<std::vector<Terms>> terms(count, std::vector<Terms>(n_dot_v.size()));
    std::vector<double> worst(count, 0);
    std::vector<double> albedo, tabled;
    for (const double mu : n_dot_v) {
        reference::Surface s;
        s.albedo = dvec3(1);
        s.metallic = 1;
        s.roughness = roughness;
        s.to_viewer = {std::sqrt(1 - mu * mu), 0, mu};
        albedo.push_back(reference::specularAlbedo(s).x);
        tabled.push_back(tabledAlbedo(alpha, mu));
    }
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const double y = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count),
                     turn = 2.399963229728653 * static_cast<double>(i), across = std::sqrt(1 - y * y);
        const dvec3 r(across * std::cos(turn), y, across * std::sin(turn));
        // Integral of GGX times n.l for viewer = normal = r: n.h^2 = (1 + n.l) / 2.
        double weights = 0;
        constexpr int points = 20000;  // of n.h's distribution
        for (int k = 0; k < points; ++k) {
            const double u = (k + 0.5) / points, square = (1 - u) / (1 + (alpha2 - 1) * u);
            weights += std::max(2 * square - 1, 0.0) / points;
        }
        const dvec3 filtered = sky.integral({r, alpha, alpha}, [&](const dvec3& l) {
            const double c = glm::dot(r, l), k = (1 + c) / 2 * (alpha2 - 1) + 1;
            return c > 0 ? c * alpha2 / (4 * std::numbers::pi * k * k) : 0.0;
        }) / weights;
        const dvec3 read = filteredRadiance(maps, alpha, r);
        for (int c = 0; c < 3; ++c)
            if (filtered[c] > 0) worst[i] = std::max(worst[i], std::abs(read[c] / filtered[c] - 1));
        const dvec3 aside =
                        glm::normalize(glm::cross(std::abs(r.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), r)),
                    other = glm::cross(r, aside);
        for (std::size_t j = 0; j < n_dot_v.size(); ++j) {
            const double mu = n_dot_v[j], azimuth = 2.4 * static_cast<double>(i + 7 * j);
            reference::Surface s;
            s.albedo = dvec3(1);
            s.metallic = 1;
            s.roughness = roughness;
            s.normal =
                r * mu + (aside * std::cos(azimuth) + other * std::sin(azimuth)) * std::sqrt(1 - mu * mu);
            s.to_viewer = s.normal * (2 * mu) - r;
            const reference::Brdf brdf(s);
            const dvec3 exact = sky.integral({r, alpha * std::max(mu, 0.1), alpha},
                                             [&](const dvec3& l) { return brdf.lobe(l).x; });
            terms[i][j] = {exact, filtered * albedo[j], read * albedo[j], read * tabled[j],
                           filtered * tabled[j]};
        }
    });
    const auto reduced = [&](std::size_t from, std::size_t to) {
        SpecularErrors e;
        double n = 0;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = from; j < to; ++j) {
                const Terms& t = terms[i][j];
                const auto square = [](const dvec3& v) { return glm::dot(v, v) / 3; };
                e.split += square(t.split - t.exact);
                e.prefilter += square(t.filtered - t.split);
                e.table += square(t.table - t.split);
                e.all += square(t.ours - t.exact);
                e.mean += (t.exact.x + t.exact.y + t.exact.z) / 3;
                ++n;
            }
        e.mean /= n;
        for (double* sum : {&e.split, &e.prefilter, &e.table, &e.all}) *sum = std::sqrt(*sum / n) / e.mean;
        e.worst_filtered = *std::ranges::max_element(worst);
        return e;
    };
    if (by_angle) {
        by_angle->clear();
        for (std::size_t j = 0; j < n_dot_v.size(); ++j) by_angle->push_back(reduced(j, j + 1));
    }
    return reduced(0, n_dot_v.size());
}

// Irradiance: RMS relative to its mean, and the largest differences relative to its peak.
struct IrradianceErrors {
    struct Error {
        double rms = 0, worst = 0;
    };
    Error harmonics, windowed, map;
};

inline IrradianceErrors irradianceErrors(const AllDirections& sky, const EnvironmentMaps& maps,
                                         std::size_t count) {
    using glm::dvec3;
    const double window = minWindow(maps.harmonics);
    const auto raw = irradiancePolynomial(maps.harmonics),
               damped = irradiancePolynomial(maps.harmonics, window);
    std::vector<std::array<dvec3, 4>> values(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const double y = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count),
                     turn = 2.399963229728653 * static_cast<double>(i), across = std::sqrt(1 - y * y);
        const dvec3 n(across * std::cos(turn), y, across * std::sin(turn));
        values[i] = {
            sky.integral({n, 1, 1},
                         [&](const dvec3& l) { return std::max(glm::dot(n, l), 0.0) / std::numbers::pi; }),
            glm::max(evaluate(raw, n), dvec3(0)), glm::max(evaluate(damped, n), dvec3(0)),
            dvec3(maps.diffuse.interpolated(octahedralPosition(glm::vec3(n))))};
    });
    double mean = 0, peak = 0;
    for (const auto& v : values)
        for (int c = 0; c < 3; ++c) {
            mean += v[0][c] / (3 * static_cast<double>(count));
            peak = std::max(peak, v[0][c]);
        }
    std::array<IrradianceErrors::Error, 3> errors;
    for (std::size_t k = 0; k < 3; ++k) {
        double squares = 0;
        for (const auto& v : values)
            for (int c = 0; c < 3; ++c) {
                const double off = v[k + 1][c] - v[0][c];
                squares += off * off;
                errors[k].worst = std::max(errors[k].worst, std::abs(off) / peak);
            }
        errors[k].rms = std::sqrt(squares / (3 * static_cast<double>(count))) / mean;
    }
    return {errors[0], errors[1], errors[2]};
}

}  // namespace diptych::environment_errors
