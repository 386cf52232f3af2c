// SPDX-License-Identifier: MIT
#include "compare/metrics/order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace diptych::metrics {
namespace {

constexpr std::size_t bins = (0x7f800000u >> 16) + 1;  // up to infinity
constexpr std::size_t parts = 8;                       // fixed, so that sums are added in one order

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

Part countPart(std::span<const float> values) {
    Part part{std::vector<std::uint32_t>(bins), std::vector<double>(bins)};
    for (const float v : values)
        if (isThere(v)) {
            ++part.count[keyOf(v) >> 16];
            part.weight[keyOf(v) >> 16] += double{v};
        }
    return part;
}

// The i-th of `parts` stretches of the values.
std::span<const float> stretch(std::span<const float> values, std::size_t i) {
    const std::size_t from = values.size() * i / parts, to = values.size() * (i + 1) / parts;
    return values.subspan(from, to - from);
}

}  // namespace

Order::Order(std::span<const float> values) : values_(values), count_(bins), weight_(bins) {
    std::vector<Part> found(parts);
    tbb::parallel_for(std::size_t{0}, parts,
                      [&](std::size_t i) { found[i] = countPart(stretch(values, i)); });
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

std::vector<std::uint32_t> Order::within(std::size_t bin) const {
    std::vector<std::uint32_t> low(std::size_t{1} << 16);
    for (const float v : values_)
        if (keyOf(v) >> 16 == bin && isThere(v)) ++low[keyOf(v) & 0xffffu];
    return low;
}

float Order::nearestRank(double share) const {
    if (size_ == 0) return 0;
    auto left = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(size_)));
    left = std::clamp<std::uint64_t>(left, 1, size_);
    std::size_t bin = 0;
    for (; left > count_[bin]; ++bin) left -= count_[bin];
    const std::vector<std::uint32_t> low = within(bin);
    std::size_t i = 0;
    for (; left > low[i]; ++i) left -= low[i];
    return valueOf(bin, i);
}

float Order::weightedQuantile(double share) const {
    if (!(sum_ > 0)) return 0;
    double left = share * sum_;
    std::size_t bin = 0;
    for (; bin < bins && !(count_[bin] && left <= weight_[bin]); ++bin) left -= weight_[bin];
    if (bin == bins) return nearestRank(1);  // the sums' rounding
    const std::vector<std::uint32_t> low = within(bin);
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
