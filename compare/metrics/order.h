// SPDX-License-Identifier: MIT
// Exact order statistics without sorting.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace diptych::metrics {

// Order statistics of floats that are 0 or above, infinity included; a NaN or a negative value is left out.
// The bits of such floats have the order of their values, so that two histograms of 2^15 and 2^16 bins find
// any rank. Each query reads the values again, which must outlive this object. Results do not depend on the
// number of threads.
class Order {
public:
    explicit Order(std::span<const float> values);

    std::uint64_t size() const { return size_; }
    double sum() const { return sum_; }
    double mean() const { return size_ ? sum_ / static_cast<double>(size_) : 0; }

    // The ceil(share N)-th smallest value (nearest rank), share in [0, 1]; share 0 is the smallest. 0 if
    // there are no values.
    float nearestRank(double share) const;
    // A quantile in which each value is weighted by itself: the least value such that it and those below it
    // are at least `share` of the sum. 0 if the sum is 0; the sum must be finite.
    float weightedQuantile(double share) const;

private:
    std::vector<std::uint32_t> within(std::size_t bin) const;  // by the low 16 bits

    std::span<const float> values_;
    std::vector<std::uint64_t> count_;  // by the high bits
    std::vector<double> weight_;
    std::uint64_t size_ = 0;
    double sum_ = 0;
};

}  // namespace diptych::metrics
