// SPDX-License-Identifier: MIT
#include "shared/environment/directional_albedo.h"

#include "shared/contract/albedo.h"
#include "shared/contract/constants.h"
#include "shared/environment/gauss_legendre.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych {
namespace {

constexpr std::size_t points = GaussLegendre::points;
const GaussLegendre rule;

double schlickWeight(double v_dot_h) {
    const double x = std::clamp(1 - v_dot_h, 0.0, 1.0);
    return x * x * x * x * x;
}

// Smith's Lambda for GGX (Heitz 2014, equation 72).
double lambda(double alpha, double cosine) {
    return (std::sqrt(1 + alpha * alpha * (1 - cosine * cosine) / (cosine * cosine)) - 1) / 2;
}

// The lobe over half vectors (Walter et al. 2007: dl = 4 v.h dh), by T = tan(angle to the normal): D cos
// dh = density(T) dT dphi / (2 pi).
class Lobe {
public:
    Lobe(double n_dot_v, double alpha)
        : mu_(n_dot_v),
          sine_(std::sqrt(1 - n_dot_v * n_dot_v)),
          alpha_(alpha),
          lambda_v_(lambda(alpha, n_dot_v)) {}

    double density(double t) const {
        const double a2 = alpha_ * alpha_, sum = a2 + t * t;
        return 2 * a2 * t / (sum * sum);
    }

    // Ring of half vectors at T, for azimuths with the light above the horizon: n.l = 2 v.h n.h - n.v.
    glm::dvec2 ring(double t) const {
        const double cosine = 1 / std::sqrt(1 + t * t), sine = t * cosine;
        const double edge = (mu_ / (2 * cosine) - mu_ * cosine) / std::max(sine_ * sine, 1e-300);
        const double reach = std::acos(std::clamp(edge, -1.0, 1.0));
        glm::dvec2 sum(0);
        for (std::size_t i = 0; i < points; ++i) {
            const double v_dot_h = mu_ * cosine + sine_ * sine * std::cos(reach * rule.at[i]);
            const double n_dot_l = std::min(2 * v_dot_h * cosine - mu_, 1.0);
            if (!(n_dot_l > 0)) continue;
            const double masking = 1 / (1 + lambda_v_ + lambda(alpha_, n_dot_l));
            const double w = schlickWeight(v_dot_h);
            sum += glm::dvec2(1 - w, w) * (masking * v_dot_h / (mu_ * cosine) * rule.weight[i]);
        }
        return sum * (reach / std::numbers::pi);
    }

private:
    double mu_, sine_, alpha_, lambda_v_;
};

double alongRow(double n_dot_v, double alpha) {
    const double k = 2 * alpha, blend = double{gpu::ALBEDO_BLEND};
    return blend * std::sqrt(n_dot_v * (1 + k) / (n_dot_v + k)) + (1 - blend) * std::sqrt(n_dot_v);
}

// n.v at a coordinate of a row, by bisection; at the edge slightly above the horizon.
double viewAt(double x, double alpha) {
    double low = 1e-7, high = 1;
    for (int step = 0; step < 60; ++step) {
        const double middle = std::sqrt(low * high);
        (alongRow(middle, alpha) < x ? low : high) = middle;
    }
    return high;
}

}  // namespace

// Integrates over three pieces of T. The first ends where part of a ring falls below the horizon, the
// second at the lobe's width. The third, in 1 / T, ends where the last of a ring does. Each is smooth,
// with a substitution that stretches its steep end.
glm::dvec2 specularAlbedo(double n_dot_v, double alpha) {
    const Lobe lobe(n_dot_v, alpha);
    const double view = std::acos(std::min(n_dot_v, 1.0)), quarter = std::numbers::pi / 2;
    const double first = std::tan((quarter - view) / 2), last = std::tan((quarter + view) / 2);
    const double width = std::clamp(alpha, first, last), all = std::asinh(first / alpha);
    glm::dvec2 sum(0);
    const auto add = [&](double t, double step) { sum += lobe.ring(t) * (lobe.density(t) * step); };
    for (std::size_t i = 0; i < points; ++i) {
        const double x = rule.at[i], weight = rule.weight[i];
        add(alpha * std::sinh(all * x), alpha * std::cosh(all * x) * all * weight);
        const double cube = x * x * x, slope = 3 * x * x * weight;
        if (width > first) add(first + (width - first) * cube, (width - first) * slope);
        if (width < last) {
            const double cotangent = 1 / last + (1 / width - 1 / last) * cube;
            add(1 / cotangent, (1 / width - 1 / last) * slope / (cotangent * cotangent));
        }
    }
    return sum;
}

const std::vector<glm::vec2>& directionalAlbedoTable() {
    static const std::vector<glm::vec2> table = [] {
        constexpr std::size_t width = gpu::ALBEDO_TABLE_WIDTH, height = gpu::ALBEDO_TABLE_HEIGHT;
        const double min = std::sqrt(double{gpu::MIN_PERCEPTUAL_ROUGHNESS});
        std::vector<glm::vec2> made(width * height);
        tbb::parallel_for(std::size_t{0}, height, [&](std::size_t row) {
            const double y = min + (1 - min) * static_cast<double>(row) / (height - 1), alpha = y * y * y * y;
            for (std::size_t i = 0; i < width; ++i)
                made[row * width + i] =
                    specularAlbedo(viewAt(static_cast<double>(i) / (width - 1), alpha), alpha);
        });
        return made;
    }();
    return table;
}

std::vector<glm::vec4> directionalAlbedoPairs() {
    const std::vector<glm::vec2>& table = directionalAlbedoTable();
    std::vector<glm::vec4> pairs;
    for (std::size_t i = 0; i < table.size(); ++i)
        pairs.emplace_back(table[i], table[std::min(i + 1, table.size() - 1)]);
    return pairs;
}

}  // namespace diptych
