// SPDX-License-Identifier: MIT
// What is counted of a probe's results.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych::probe {

// Errors by powers of two of a ULP: bin 0 has what is exact, bin 1 what is at most 1/2 off, bin 2 at most 1,
// bin i at most 2^(i - 2), the last one all else.
inline constexpr std::size_t error_bins = 32;

struct Worst {
    double error = 0;  // in the probe's unit, or as a share of what is allowed
    double got = 0, expected = 0, allowed = 0;
    std::size_t row = 0;
    std::size_t output = 0;
    bool any = false;
};

class Tally {
public:
    // A result in a row. `step`: what the error is counted in; 0: it is not counted, only judged.
    void value(std::size_t row, std::size_t output, float got, double expected, double allowed, double step);
    // A step of a monotone function; `back`: against its direction, by so much.
    void back(std::size_t row, float before, float after);
    void add(const Tally& other);

    std::size_t first_row = 0;     // of the line that is judged
    std::uint64_t results = 0;     // that were judged
    std::uint64_t unpromised = 0;  // where Vulkan promises nothing, which are not judged
    std::uint64_t failures = 0;    // beyond what is allowed
    std::uint64_t nonfinite = 0;   // no numbers where there should be one
    std::uint64_t backward = 0;    // steps against the direction of a monotone function
    std::array<std::uint64_t, error_bins> histogram{};
    std::vector<float> errors;  // all that were counted, in the unit
    Worst worst;                // by its error in the unit
    Worst tightest;             // by its share of what is allowed
    Worst farthest_back;
};

}  // namespace diptych::probe
