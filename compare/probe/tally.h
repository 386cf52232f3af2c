// SPDX-License-Identifier: MIT
// Counts and errors of a probe's results.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych::probe {

// Bins of errors by powers of two of a ULP: bin 0 is exact, bin 1 at most 1/2, bin 2 at most 1, bin i at
// most 2^(i - 2); the last bin has all larger errors.
inline constexpr std::size_t error_bins = 32;

struct Worst {
    double error = 0;  // in the probe's unit, or as a fraction of the allowed error
    double got = 0, expected = 0, allowed = 0;
    std::size_t row = 0;
    std::size_t output = 0;
    bool any = false;
};

class Tally {
public:
    // Adds the result of a row. `step`: the unit of the error; 0: the error is evaluated but not counted.
    void value(std::size_t row, std::size_t output, float got, double expected, double allowed, double step);
    // Adds a step of a monotone function against its direction.
    void back(std::size_t row, float before, float after);
    void add(const Tally& other);

    std::size_t first_row = 0;     // of the evaluated line
    std::uint64_t results = 0;     // evaluated
    std::uint64_t unpromised = 0;  // not evaluated, because Vulkan guarantees nothing
    std::uint64_t failures = 0;    // above the allowed error
    std::uint64_t nonfinite = 0;   // NaN or infinity
    std::uint64_t backward = 0;    // steps against the direction of a monotone function
    std::array<std::uint64_t, error_bins> histogram{};
    std::vector<float> errors;  // all counted ones, in the unit
    Worst worst;                // largest error in the unit
    Worst tightest;             // largest fraction of the allowed error
    Worst farthest_back;
};

}  // namespace diptych::probe
