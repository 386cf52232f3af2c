// SPDX-License-Identifier: MIT
#include "compare/metrics/order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace diptych::metrics {
namespace {

constexpr std::size_t bins = (0x7f800000u >> 16) + 1;  // includes infinity

// Parts that threads count. They depend on the number of values alone, so that the order of sums is fixed. A
// part costs a histogram, as long as 2^16 values take.
std::size_t partsOf(std::size_t values) {
    return std::clamp<std::size_t>(values >> 16, 1, 8);
}

struct Part {
    std::vector<std::uint32_t> count;
    std::vector<double> weight;
};

bool isThere(float v) {
    return v >= 0;
}
// -0 counts as 0.
std::uint32_t keyOf(float v) {
    return std::bit_cast<std::uint32_t>(v) & 0x7fffffffu;
}
float valueOf(std::size_t bin, std::size_t low) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bin << 16 | low));
}

void add(Part& part, std::span<const float> values) {
    for (const float v : values)
        if (isThere(v)) {
            ++part.count[keyOf(v) >> 16];
            part.weight[keyOf(v) >> 16] += double{v};
        }
}

}  // namespace

Order::Order(std::size_t count, Values values)
    : length_(count), values_(std::move(values)), count_(bins), weight_(bins) {
    const std::size_t parts = partsOf(length_);
    std::vector<Part> found(parts);
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t i) {
        found[i] = {std::vector<std::uint32_t>(bins), std::vector<double>(bins)};
        values_(length_ * i / parts, length_ * (i + 1) / parts,
                [&](std::span<const float> piece) { add(found[i], piece); });
    });
    for (const Part& part : found)
        for (std::size_t bin = 0; bin < bins; ++bin) {
            count_[bin] += part.count[bin];
            weight_[bin] += part.weight[bin];
        }
    for (std::size_t bin = 0; bin < bins; ++bin) {
        size_ += count_[bin];
        sum_ += weight_[bin];
    }
}

Order::Order(std::span<const float> values)
    : Order(values.size(), [values](std::size_t from, std::size_t to, const Use& use) {
          use(values.subspan(from, to - from));
      }) {}

std::vector<Order::Bin> Order::within(const std::vector<std::size_t>& wanted) const {
    std::vector<std::uint8_t> slot(bins);  // index in `wanted` + 1; 0: not wanted
    for (std::size_t i = 0; i < wanted.size(); ++i) slot[wanted[i]] = static_cast<std::uint8_t>(i + 1);
    const std::size_t parts = partsOf(length_);
    std::vector<std::vector<Bin>> found(parts);
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t i) {
        std::vector<Bin>& low = found[i];
        low.assign(wanted.size(), Bin(std::size_t{1} << 16));
        values_(length_ * i / parts, length_ * (i + 1) / parts, [&](std::span<const float> piece) {
            for (const float v : piece)
                if (const std::uint8_t at = isThere(v) ? slot[keyOf(v) >> 16] : 0; at > 0)
                    ++low[at - 1u][keyOf(v) & 0xffffu];
        });
    });
    for (std::size_t part = 1; part < parts; ++part)
        for (std::size_t i = 0; i < wanted.size(); ++i)
            std::ranges::transform(found[0][i], found[part][i], found[0][i].begin(), std::plus());
    return std::move(found[0]);
}

std::vector<float> Order::nearestRanks(std::span<const double> fractions) const {
    std::vector<float> values(fractions.size());
    if (size_ == 0) return values;
    std::vector<std::size_t> found, in;  // distinct bins; index in `found` for each fraction
    std::vector<std::uint64_t> left;     // ranks within the bins
    for (const double fraction : fractions) {
        auto rank = static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(size_)));
        rank = std::clamp<std::uint64_t>(rank, 1, size_);
        std::size_t bin = 0;
        for (; rank > count_[bin]; ++bin) rank -= count_[bin];
        const auto known = std::ranges::find(found, bin);
        in.push_back(static_cast<std::size_t>(known - found.begin()));
        if (known == found.end()) found.push_back(bin);
        left.push_back(rank);
    }
    const std::vector<Bin> low = within(found);
    for (std::size_t k = 0; k < fractions.size(); ++k) {
        std::size_t i = 0;
        for (; left[k] > low[in[k]][i]; ++i) left[k] -= low[in[k]][i];
        values[k] = valueOf(found[in[k]], i);
    }
    return values;
}

float Order::weightedQuantile(double fraction) const {
    if (!(sum_ > 0)) return 0;
    double left = fraction * sum_;
    std::size_t bin = 0;
    for (; bin < bins && !(count_[bin] && left <= weight_[bin]); ++bin) left -= weight_[bin];
    if (bin == bins) return nearestRank(1);  // rounding of the sums
    const Bin low = std::move(within({bin}).front());
    float value = 0;
    for (std::size_t i = 0; i < low.size(); ++i) {
        if (!low[i]) continue;
        value = valueOf(bin, i);
        left -= double{value} * low[i];
        if (left <= 0) break;
    }
    return value;
}

}  // namespace diptych::metrics
