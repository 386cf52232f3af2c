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
constexpr double leastAccount = 0.05, equalAccounts = 0.02;
constexpr double mostLeft = 0.1;

using Color = std::array<double, 3>;

double dot(const Color& a, const Color& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Color colorAt(const Image& image, std::size_t pixel) {
    const float* const p = image.pixel(pixel);
    return {double{p[0]}, double{p[1]}, double{p[2]}};
}

// One block: the remaining change, and each light's part of it.
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
        const std::vector<Color> change = left_;
        const double all = squares();
        std::vector<std::vector<double>> sizes = taken(all);
        if (how_ == LightChange::factor && squares() > mostLeft * all) {
            left_ = change;
            each_color_ = true;
            sizes = taken(all);
        }
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            double sum = 0;
            for (const std::vector<double>& light : sizes) sum += light[i];
            for (std::size_t light = 0; sum > 0 && light < sizes.size(); ++light)
                shares[light][pixels_[i]] = static_cast<float>(sizes[light][i] / sum);
        }
    }

private:
    // The sum of squares of the remaining change.
    double squares() const {
        double sum = 0;
        for (const Color& c : left_) sum += dot(c, c);
        return sum;
    }

    // Subtracts lights as long as each accounts for enough. Returns each light's magnitude at each pixel.
    std::vector<std::vector<double>> taken(double all) {
        std::vector<std::vector<double>> sizes(terms_.size(), std::vector<double>(pixels_.size()));
        for (std::size_t count = 0; all > 0 && count < mostLightsOfBlock; ++count) {
            std::vector<double> accounts(terms_.size());
            for (std::size_t light = 0; light < terms_.size(); ++light) accounts[light] = account(light);
            const auto best = std::ranges::max_element(accounts);
            if (best == accounts.end() || !(*best >= leastAccount * all)) break;
            std::vector<std::size_t> alike;
            for (std::size_t light = 0; light < accounts.size(); ++light)
                if (accounts[light] >= (1 - equalAccounts) * *best) alike.push_back(light);
            take(static_cast<std::size_t>(best - accounts.begin()), alike, sizes);
        }
        return sizes;
    }

    // A light's part of the change as multiples of its term: one factor for the block (grey, or per
    // colour), or one per pixel.
    std::vector<Color> factors(std::size_t light) const {
        Color along{}, size{};
        std::vector<Color> of(pixels_.size());
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const Color term = colorAt(terms_[light], pixels_[i]);
            for (std::size_t c = 0; c < 3; ++c) {
                along.at(c) += left_[i].at(c) * term.at(c);
                size.at(c) += term.at(c) * term.at(c);
            }
            const double s = dot(term, term);
            if (how_ == LightChange::seen && s > 0)
                of[i].fill(std::clamp(dot(left_[i], term) / s, -1.0, 1.0));
        }
        if (how_ == LightChange::factor) {
            if (!each_color_)
                along.fill(along[0] + along[1] + along[2]), size.fill(size[0] + size[1] + size[2]);
            Color factor{};
            for (std::size_t c = 0; c < 3; ++c)
                factor.at(c) = size.at(c) > 0 ? along.at(c) / size.at(c) : 0.0;
            std::ranges::fill(of, factor);
        }
        const double sign = std::copysign(1.0, along[0] + along[1] + along[2]);
        if (how_ == LightChange::whole)
            // A light present on both sides changes nothing.
            for (std::size_t i = 0; i < pixels_.size(); ++i)
                if (reduction(light, i, {sign, sign, sign}) > 0) of[i].fill(sign);
        return of;
    }

    // A light's part of a pixel's change.
    Color part(std::size_t light, std::size_t i, const Color& factor) const {
        Color of = colorAt(terms_[light], pixels_[i]);
        for (std::size_t c = 0; c < 3; ++c) of.at(c) *= factor.at(c);
        return of;
    }

    // The decrease of the squared change at a pixel by subtracting that part.
    double reduction(std::size_t light, std::size_t i, const Color& factor) const {
        const Color of = part(light, i, factor);
        return 2 * dot(left_[i], of) - dot(of, of);
    }

    double account(std::size_t light) const {
        const std::vector<Color> of = factors(light);
        double sum = 0;
        for (std::size_t i = 0; i < of.size(); ++i) sum += reduction(light, i, of[i]);
        return sum;
    }

    void take(std::size_t best, const std::vector<std::size_t>& alike,
              std::vector<std::vector<double>>& taken_sizes) {
        const std::vector<Color> of = factors(best);
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const Color taken = part(best, i, of[i]);
            const double accounted = std::sqrt(dot(taken, taken));
            double sum = 0;
            std::vector<double> sizes;
            for (const std::size_t light : alike) {
                const Color own = colorAt(terms_[light], pixels_[i]);
                sizes.push_back(std::sqrt(dot(own, own)));
                sum += sizes.back();
            }
            for (std::size_t k = 0; sum > 0 && k < alike.size(); ++k)
                taken_sizes[alike[k]][i] += accounted * sizes[k] / sum;
            for (std::size_t c = 0; c < 3; ++c) left_[i].at(c) -= taken.at(c);
        }
    }

    std::span<const Image> terms_;
    LightChange how_;
    bool each_color_ = false;  // one factor per colour
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
