// SPDX-License-Identifier: MIT
#include "compare/explain/by_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace diptych {

namespace {

constexpr int blockSide = 8;
constexpr std::size_t mostLightsOfBlock = 3;
constexpr double leastAccount = 0.05, toldApart = 0.02;

using Color = std::array<double, 3>;

double dot(const Color& a, const Color& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Color colorAt(const Image& image, std::size_t pixel) {
    const float* const p = image.pixel(pixel);
    return {double{p[0]}, double{p[1]}, double{p[2]}};
}

// One block: what is left of the change, and how much each light has of it.
class LightBlock {
public:
    LightBlock(const Image& change, std::span<const Image> terms, LightChange how, int x, int y)
        : terms_(terms), how_(how) {
        for (int v = y; v < std::min(y + blockSide, change.height); ++v)
            for (int u = x; u < std::min(x + blockSide, change.width); ++u) {
                pixels_.push_back(static_cast<std::size_t>(v) * static_cast<std::size_t>(change.width) +
                                  static_cast<std::size_t>(u));
                left_.push_back(colorAt(change, pixels_.back()));
            }
    }

    void divide(std::vector<std::vector<float>>& shares) {
        double all = 0;
        for (const Color& c : left_) all += dot(c, c);
        for (std::size_t taken = 0; all > 0 && taken < mostLightsOfBlock; ++taken) {
            std::vector<double> accounts(terms_.size());
            for (std::size_t light = 0; light < terms_.size(); ++light) accounts[light] = account(light);
            const auto best = std::ranges::max_element(accounts);
            if (best == accounts.end() || !(*best >= leastAccount * all)) break;
            std::vector<std::size_t> alike;
            for (std::size_t light = 0; light < accounts.size(); ++light)
                if (accounts[light] >= (1 - toldApart) * *best) alike.push_back(light);
            take(static_cast<std::size_t>(best - accounts.begin()), alike, shares);
        }
        for (const std::size_t pixel : pixels_) {
            double sum = 0;
            for (const std::vector<float>& light : shares) sum += double{light[pixel]};
            if (sum > 0)
                for (std::vector<float>& light : shares)
                    light[pixel] = static_cast<float>(double{light[pixel]} / sum);
        }
    }

private:
    // What of the change is the light's, as multiples of its term: one of the block, or one a pixel.
    std::vector<double> factors(std::size_t light) const {
        double along = 0, size = 0;
        std::vector<double> of(pixels_.size());
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const Color term = colorAt(terms_[light], pixels_[i]);
            const double a = dot(left_[i], term), s = dot(term, term);
            along += a, size += s;
            if (how_ == LightChange::seen && s > 0) of[i] = std::clamp(a / s, -1.0, 1.0);
        }
        if (how_ == LightChange::factor) std::ranges::fill(of, size > 0 ? along / size : 0.0);
        if (how_ == LightChange::whole)
            // Where it is there on both sides nothing has changed.
            for (std::size_t i = 0; i < pixels_.size(); ++i)
                if (along != 0 && reduction(light, i, std::copysign(1.0, along)) > 0)
                    of[i] = std::copysign(1.0, along);
        return of;
    }

    // By how much the squared change at a pixel is less without this multiple of the light's term.
    double reduction(std::size_t light, std::size_t i, double factor) const {
        const Color term = colorAt(terms_[light], pixels_[i]);
        return 2 * factor * dot(left_[i], term) - factor * factor * dot(term, term);
    }

    double account(std::size_t light) const {
        const std::vector<double> of = factors(light);
        double sum = 0;
        for (std::size_t i = 0; i < of.size(); ++i) sum += reduction(light, i, of[i]);
        return sum;
    }

    void take(std::size_t best, const std::vector<std::size_t>& alike,
              std::vector<std::vector<float>>& shares) {
        const std::vector<double> of = factors(best);
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const Color term = colorAt(terms_[best], pixels_[i]);
            const double accounted = std::abs(of[i]) * std::sqrt(dot(term, term));
            double sum = 0;
            std::vector<double> sizes;
            for (const std::size_t light : alike) {
                const Color own = colorAt(terms_[light], pixels_[i]);
                sizes.push_back(std::sqrt(dot(own, own)));
                sum += sizes.back();
            }
            for (std::size_t k = 0; sum > 0 && k < alike.size(); ++k)
                shares[alike[k]][pixels_[i]] += static_cast<float>(accounted * sizes[k] / sum);
            for (std::size_t c = 0; c < 3; ++c) left_[i].at(c) -= of[i] * term.at(c);
        }
    }

    std::span<const Image> terms_;
    LightChange how_;
    std::vector<std::size_t> pixels_;
    std::vector<Color> left_;
};

}  // namespace

std::vector<std::vector<float>> lightsOfChange(const Image& change, std::span<const Image> terms,
                                               LightChange how) {
    std::vector<std::vector<float>> shares(terms.size(), std::vector<float>(change.pixels()));
    const int columns = (change.width + blockSide - 1) / blockSide,
              rows = (change.height + blockSide - 1) / blockSide;
    tbb::parallel_for(0, columns * rows, [&](int block) {
        LightBlock(change, terms, how, block % columns * blockSide, block / columns * blockSide)
            .divide(shares);
    });
    return shares;
}

}  // namespace diptych
