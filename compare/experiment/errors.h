// SPDX-License-Identifier: MIT
// Judges an image by its errors against the reference.
#pragma once

#include "compare/experiment/measures.h"
#include "compare/metrics/channel.h"
#include "compare/metrics/flip.h"
#include "shared/frame/frame.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace diptych::experiment {

// The value; infinity if it is not finite.
double knownOrInfinite(double value);

// The ceil(fraction N)-th smallest value; 0 without values.
double nearestRank(std::vector<double> values, double fraction);

// Errors of a Frame of the reference's size. `pixels`: relative error of each covered pixel.
struct FrameErrors {
    Errors errors{};
    std::vector<double> pixels;
    Image flip;  // all pixels
    double flip_sum = 0;
    std::uint64_t flip_pixels = 0;
};

// Errors of lit from one camera. Caches data of the reference. Not thread-safe.
class ErrorsAgainst {
public:
    explicit ErrorsAgainst(const Frame& reference);
    ErrorsAgainst(const ErrorsAgainst&) = delete;
    ErrorsAgainst& operator=(const ErrorsAgainst&) = delete;

    FrameErrors operator()(const Image& lit) const;
    // Inputs of one metric of errorMetrics for ErrorsOfCameras: flip_sum and flip_pixels, or `pixels`.
    FrameErrors forMetric(std::size_t metric, const Image& lit) const;
    // Frees FLIP's data of the reference, about 256 MiB at most. It is recomputed on demand.
    void release() const { flip_.reset(); }

private:
    std::vector<double> pixelsOf(const Image& lit) const;
    // Replaces uncovered pixels by NaN, so that FLIP's filters ignore them.
    Image covered(const Image& lit) const;
    const HdrFlipAgainst& flip() const;

    const Coverage coverage_;
    const Image reference_;  // all pixels
    const Image covered_;
    const PixelError relative_;
    mutable std::optional<HdrFlipAgainst> flip_;
};

// RMSE and 99th percentile (nearest rank) of relative errors.
struct RelativeErrors {
    double rmse = 0, p99 = 0;
};
RelativeErrors relativeErrors(std::vector<double> errors);

// Errors over several cameras; all pixels have equal weight.
class ErrorsOfCameras {
public:
    void add(const FrameErrors& camera);
    Errors errors() const;

private:
    std::vector<double> pixels_;
    double flip_sum_ = 0, flip_pixels_ = 0;
};

}  // namespace diptych::experiment
