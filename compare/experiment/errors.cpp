// SPDX-License-Identifier: MIT
#include "compare/experiment/errors.h"

#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace diptych::experiment {
namespace {

HdrFlipOptions flipOver(const Coverage& coverage) {
    HdrFlipOptions options;
    options.covered = coverage.covered;
    return options;
}

}  // namespace

double knownOrInfinite(double value) {
    return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
}

double nearestRank(std::vector<double> values, double fraction) {
    if (values.empty()) return 0;
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(fraction * static_cast<double>(values.size())));
    const auto nth = values.begin() + std::max<std::ptrdiff_t>(rank, 1) - 1;
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

RelativeErrors relativeErrors(std::vector<double> errors) {
    if (errors.empty()) return {};
    double squares = 0;
    for (const double e : errors) squares += e * e;
    const auto count = static_cast<double>(errors.size());
    return {knownOrInfinite(std::sqrt(squares / count)),
            knownOrInfinite(nearestRank(std::move(errors), 0.99))};
}

ErrorsAgainst::ErrorsAgainst(const Frame& reference)
    : coverage_(coverage(reference, reference)),  // the same pixels for all rows
      reference_(reference.channels.at(Channel::lit)),
      covered_(covered(reference_)),
      relative_(debugMode(Channel::lit).error_kind, debugMode(Channel::lit).kind, reference_, coverage_) {}

const HdrFlipAgainst& ErrorsAgainst::flip() const {
    if (!flip_) flip_.emplace(covered_, flipOver(coverage_));
    return *flip_;
}

Image ErrorsAgainst::covered(const Image& lit) const {
    Image image = lit;
    for (std::size_t i = 0; i < image.pixels(); ++i)
        if (!coverage_.covered[i])
            std::fill_n(image.pixel(i), image.components, std::numeric_limits<float>::quiet_NaN());
    return image;
}

std::vector<double> ErrorsAgainst::pixelsOf(const Image& lit) const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < reference_.pixels(); ++i)
        if (coverage_.covered[i]) errors.push_back(relative_(lit.pixel(i), reference_.pixel(i)));
    return errors;
}

FrameErrors ErrorsAgainst::operator()(const Image& lit) const {
    FrameErrors result;
    result.pixels = pixelsOf(lit);
    HdrFlipResult seen = flip()(covered(lit));
    result.flip = std::move(seen.error);
    result.flip_pixels = seen.pixels;
    result.flip_sum = seen.mean * static_cast<double>(seen.pixels);
    const RelativeErrors relative = relativeErrors(result.pixels);
    result.errors = {knownOrInfinite(seen.mean), relative.rmse, relative.p99};
    return result;
}

FrameErrors ErrorsAgainst::forMetric(std::size_t metric, const Image& lit) const {
    FrameErrors result;
    constexpr std::size_t flipMetric = 0;  // other metrics use the pixels' relative errors
    if (metric != flipMetric) {
        result.pixels = pixelsOf(lit);
        return result;
    }
    const HdrFlipAgainst::Mean seen = flip().mean(covered(lit));
    result.flip_pixels = seen.pixels;
    result.flip_sum = seen.mean * static_cast<double>(seen.pixels);
    return result;
}

void ErrorsOfCameras::add(const FrameErrors& camera) {
    pixels_.insert(pixels_.end(), camera.pixels.begin(), camera.pixels.end());
    flip_sum_ += camera.flip_sum;
    flip_pixels_ += static_cast<double>(camera.flip_pixels);
}

Errors ErrorsOfCameras::errors() const {
    const RelativeErrors relative = relativeErrors(pixels_);
    return {flip_pixels_ > 0 ? knownOrInfinite(flip_sum_ / flip_pixels_) : 0, relative.rmse, relative.p99};
}

}  // namespace diptych::experiment
