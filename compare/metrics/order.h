// SPDX-License-Identifier: MIT
// Exact order statistics without sorting.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace diptych::metrics {

// Of floats that are 0 or above, infinity too; a NaN or a negative value counts as not there. Their bits are
// in their order, so that two counts of 2^15 and 2^16 bins find any rank; the values are read again for each
// question and must outlive this. The same whatever the number of threads.
class Order {
public:
    explicit Order(std::span<const float> values);

    std::uint64_t size() const { return size_; }
    double sum() const { return sum_; }
    double mean() const { return size_ ? sum_ / static_cast<double>(size_) : 0; }

    // The ceil(share N)-th smallest (nearest rank), share in [0, 1]; 0 where there is none. 0: the smallest.
    float nearestRank(double share) const;
    // Each value weighs as much as it is: the least value such that it and those below it are at least
    // `share` of the sum. 0 where the sum is; the sum must be finite.
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
