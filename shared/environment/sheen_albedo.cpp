// SPDX-License-Identifier: MIT
#include "shared/environment/sheen_albedo.h"

#include "shared/contract/albedo.h"
#include "shared/contract/constants.h"
#include "shared/environment/gauss_legendre.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace diptych {
namespace {

// Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF".
class Charlie {
public:
    explicit Charlie(double roughness) : alpha_(roughness * roughness) {}

    double lambda(double cosine) const {
        return std::exp(cosine < 0.5 ? fit(cosine) : 2 * fit(0.5) - fit(1 - cosine));
    }
    // D for the light at the azimuth `phi` from the viewer.
    double distribution(double n_dot_v, double n_dot_l, double phi) const {
        const double sines = std::sqrt((1 - n_dot_v * n_dot_v) * std::max(1 - n_dot_l * n_dot_l, 0.0)),
                     square = 2 + 2 * (sines * std::cos(phi) + n_dot_v * n_dot_l), up = n_dot_v + n_dot_l;
        if (!(up * up < square)) return 0;
        return (2 + 1 / alpha_) * std::exp(std::log1p(-up * up / square) / (2 * alpha_)) /
               (2 * std::numbers::pi);
    }

private:
    double fit(double x) const {
        const auto mixed = [t = (1 - alpha_) * (1 - alpha_)](double rough, double smooth) {
            return rough + (smooth - rough) * t;
        };
        return mixed(21.5473, 25.3245) /
                   (1 + mixed(3.82987, 3.32435) * std::pow(x, mixed(0.19823, 0.16801))) +
               mixed(-1.97760, -1.27393) * x + mixed(-4.32054, -4.85967);
    }

    double alpha_;
};

const GaussLegendre gauss;

// Both halves of [0, 1], as the square of a coordinate: dense at 0.
template <class F>
double denseAtZero(const F& f) {
    double sum = 0;
    for (const double half : {0.0, 0.5})
        for (std::size_t i = 0; i < GaussLegendre::points; ++i) {
            const double x = half + gauss.at[i] / 2;
            sum += f(x * x) * x * gauss.weight[i];
        }
    return sum;
}

// E(n.v) (1 + Lambda(n.v)) 4 n.v.
double stored(double n_dot_v, double roughness) {
    const Charlie charlie(roughness);
    const double above = 1 + charlie.lambda(n_dot_v);
    return 2 * above * denseAtZero([&](double n_dot_l) {
               const double masking = 1 / (above + charlie.lambda(n_dot_l));
               return masking * std::numbers::pi * denseAtZero([&](double opposite) {
                          return charlie.distribution(n_dot_v, n_dot_l, std::numbers::pi * (1 - opposite));
                      });
           });
}

double alongRow(double n_dot_v, double k) {
    return (std::sqrt(n_dot_v * (1 + k) / (n_dot_v + k)) + std::sqrt(n_dot_v)) / 2;
}

// n.v at a coordinate of a row, by bisection.
double viewAt(double x, double k) {
    double low = double{gpu::MIN_N_DOT_V}, high = 1;
    for (int step = 0; step < 60; ++step) {
        const double middle = std::sqrt(low * high);
        (alongRow(middle, k) < x ? low : high) = middle;
    }
    return high;
}

}  // namespace

double sheenAlbedo(double n_dot_v, double roughness) {
    return stored(n_dot_v, roughness) / ((1 + Charlie(roughness).lambda(n_dot_v)) * 4 * n_dot_v);
}

const std::vector<glm::vec4>& sheenAlbedoRows() {
    static const std::vector<glm::vec4> table = [] {
        constexpr std::size_t size = gpu::SHEEN_TABLE_SIZE;
        const double min = std::sqrt(std::sqrt(double{gpu::MIN_PERCEPTUAL_ROUGHNESS}));
        std::vector<float> samples(size * size);
        tbb::parallel_for(std::size_t{0}, size, [&](std::size_t row) {
            const double y = min + (1 - min) * static_cast<double>(row) / (size - 1),
                         roughness = y * y * y * y, k = double{gpu::SHEEN_TABLE_WIDENS} * roughness;
            for (std::size_t i = 0; i < size; ++i)
                samples[row * size + i] =
                    static_cast<float>(stored(viewAt(static_cast<double>(i) / (size - 1), k), roughness));
        });
        std::vector<glm::vec4> rows;
        const auto at = [&](std::size_t i) { return samples[std::min(i, samples.size() - 1)]; };
        for (std::size_t i = 0; i < samples.size(); ++i)
            rows.emplace_back(at(i), at(i + 1), at(i + 2), at(i + 3));
        return rows;
    }();
    return table;
}

}  // namespace diptych
