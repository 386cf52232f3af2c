// SPDX-License-Identifier: MIT
#include "compare/probe/tally.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::probe {
namespace {

// Rounding error of the double-precision definition: a few roundings.
constexpr double definition_rounding = 0x1p-46;

std::size_t binOf(double error) {
    if (error == 0) return 0;
    const double bin = std::max(std::ceil(std::log2(error)), -1.0) + 2;
    return static_cast<std::size_t>(std::min(bin, double{error_bins - 1}));
}

// Independent of the order in which rows are evaluated.
void keepWorse(Worst& worst, const Worst& other) {
    if (other.any &&
        (!worst.any || other.error > worst.error || (other.error == worst.error && other.row < worst.row)))
        worst = other;
}

}  // namespace

void Tally::value(std::size_t row, std::size_t output, float got, double expected, double allowed,
                  double step) {
    if (!(allowed < std::numeric_limits<double>::infinity())) {
        ++unpromised;
        return;
    }
    ++results;
    const double off = std::abs(double{got} - expected);
    const double limit = allowed + std::abs(expected) * definition_rounding;
    if (!std::isfinite(got)) ++nonfinite;
    if (!(off <= limit)) ++failures;
    const double max = std::numeric_limits<double>::max(), counted = std::isfinite(off) ? off : max;
    const Worst here{0, double{got}, expected, allowed, row, output, true};
    if (step > 0) {
        Worst in_units = here;
        in_units.error = counted / step;
        keepWorse(worst, in_units);
        ++histogram[binOf(in_units.error)];
        errors.push_back(static_cast<float>(std::min(in_units.error, 1e30)));
    }
    Worst fraction = here;
    fraction.error = counted == 0 ? 0 : limit > 0 ? counted / limit : max;
    keepWorse(tightest, fraction);
}

void Tally::back(std::size_t row, float before, float after) {
    ++backward;
    keepWorse(farthest_back,
              {std::abs(double{after} - double{before}), double{after}, double{before}, 0, row, 0, true});
}

void Tally::add(const Tally& other) {
    results += other.results;
    unpromised += other.unpromised;
    failures += other.failures;
    nonfinite += other.nonfinite;
    backward += other.backward;
    for (std::size_t i = 0; i < error_bins; ++i) histogram[i] += other.histogram[i];
    errors.insert(errors.end(), other.errors.begin(), other.errors.end());
    keepWorse(worst, other.worst);
    keepWorse(tightest, other.tightest);
    keepWorse(farthest_back, other.farthest_back);
}

}  // namespace diptych::probe
