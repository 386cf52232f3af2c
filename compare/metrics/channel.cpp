// SPDX-License-Identifier: MIT
#include "compare/metrics/channel.h"

#include "compare/metrics/pixel.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

namespace diptych {

using namespace metrics;

namespace {

// Luminance of a colour (Rec.709), magnitude of anything else.
double magnitude(const float* p, int components, ChannelKind kind) {
    if (kind == ChannelKind::color && components == 3)
        return std::abs(0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
    double squares = 0;
    for (int c = 0; c < components; ++c) squares += double{p[c]} * p[c];
    return std::sqrt(squares);
}

double meanMagnitude(const Image& image, ChannelKind kind, const Coverage& coverage) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
        if (coverage.covered[i] && finite(image.pixel(i), image.components)) {
            sum += magnitude(image.pixel(i), image.components, kind);
            ++count;
        }
    return count ? sum / static_cast<double>(count) : 0;
}

double nearestRank(std::vector<double>& errors, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(errors.size())));
    const auto nth = errors.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(errors.begin(), nth, errors.end());
    return *nth;
}

void checkAlike(const Image& a, const Image& b, std::size_t covered) {
    if (a.width != b.width || a.height != b.height || a.components != b.components || a.pixels() != covered)
        throw std::runtime_error(fmt::format("images of {}x{}x{} and {}x{}x{} cannot be compared", a.width,
                                             a.height, a.components, b.width, b.height, b.components));
}

// The channel by which background is recognised, and its value there.
std::optional<std::pair<int, float>> backgroundChannel(const Frame& a, const Frame& b) {
    for (const auto& [mode, value] : {std::pair{static_cast<int>(gpu::DEBUG_material_id), -1.0f},
                                      {static_cast<int>(gpu::DEBUG_depth), 0.0f}})
        if (a.channels.contains(mode) && b.channels.contains(mode)) return std::pair{mode, value};
    return {};
}

// Whether something blended covers the pixel, of a Frame that knows: in front of the background it is what
// the pixel shows.
bool showsBlended(const Frame& frame, std::size_t pixel) {
    if (!frame.blended.empty()) return *frame.blended.pixel(pixel) > 0;
    const auto lit = frame.channels.find(static_cast<int>(gpu::DEBUG_lit));
    if (frame.unblended.empty() || lit == frame.channels.end()) return false;
    return distance(lit->second.pixel(pixel), frame.unblended.pixel(pixel), lit->second.components) != 0;
}

}  // namespace

bool isBlack(const Image& image, const Coverage& coverage) {
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float* p = image.pixel(i);
        if (coverage.covered[i] && std::any_of(p, p + image.components, [](float v) { return v != 0; }))
            return false;
    }
    return true;
}

Coverage everyPixel(std::size_t pixels) {
    return {std::vector<std::uint8_t>(pixels, 1), pixels, false};
}

Coverage coverage(const Frame& a, const Frame& b) {
    for (const Frame* frame : {&a, &b})
        for (const auto& [mode, image] : frame->channels)
            if (image.width != frame->settings.size.width || image.height != frame->settings.size.height)
                throw std::runtime_error(fmt::format(
                    "{}: {} is {}x{} in a Frame of {}x{}", frame->name, debugMode(mode).name, image.width,
                    image.height, frame->settings.size.width, frame->settings.size.height));
    const auto channel = backgroundChannel(a, b);
    if (!channel) return everyPixel(a.channels.empty() ? 0 : a.channels.begin()->second.pixels());
    const auto [mode, value] = *channel;
    const Image &p = a.channels.at(mode), &q = b.channels.at(mode);
    checkAlike(p, q, p.pixels());
    Coverage coverage{std::vector<std::uint8_t>(p.pixels()), 0, true};
    for (std::size_t i = 0; i < p.pixels(); ++i)
        if (p.data[i] != value || q.data[i] != value || showsBlended(a, i) || showsBlended(b, i)) {
            coverage.covered[i] = 1;
            ++coverage.count;
        }
    return coverage;
}

PixelError::PixelError(Metric metric, ChannelKind kind, const Image& baseline, const Coverage& coverage)
    : metric_(metric), components_(baseline.components) {
    if (metric == Metric::relative) floor_ = 1e-3 * meanMagnitude(baseline, kind, coverage);
    if (metric == Metric::angular && components_ != 3)
        throw std::runtime_error(
            fmt::format("angles are between vectors of 3 components, not {}", components_));
}

double PixelError::operator()(const float* test, const float* baseline) const {
    const double difference = distance(test, baseline, components_);
    if (difference == 0 || difference == infinity) return difference;
    switch (metric_) {
        case Metric::relative:
            return difference / std::max(largestFinite(baseline, components_), floor_);
        case Metric::absolute:
            return difference;
        case Metric::angular:
            return finite(test, components_) ? angle(test, baseline) : infinity;
        case Metric::exact:
            return 1;
    }
    return infinity;
}

ChannelStats channelStats(Metric metric, ChannelKind kind, const Image& baseline, const Image& test,
                          const Coverage& coverage) {
    checkAlike(baseline, test, coverage.covered.size());
    const PixelError error(metric, kind, baseline, coverage);
    ChannelStats stats;
    std::vector<double> all;
    all.reserve(coverage.count);
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < baseline.pixels(); ++i) {
        const float *a = test.pixel(i), *b = baseline.pixel(i);
        stats.nonfinite_test += !finite(a, test.components);
        stats.nonfinite_baseline += !finite(b, test.components);
        if (!coverage.covered[i]) continue;
        const double e = error(a, b);
        all.push_back(e);
        sum += e;
        squares += e * e;
        stats.different += e > 0;
        stats.infinite += e == infinity;
        if (e > stats.max) {
            stats.max = e;
            stats.worst_x = static_cast<int>(i % static_cast<std::size_t>(baseline.width));
            stats.worst_y = static_cast<int>(i / static_cast<std::size_t>(baseline.width));
        }
    }
    if (all.empty()) return stats;
    stats.mean = sum / static_cast<double>(all.size());
    stats.rmse = std::sqrt(squares / static_cast<double>(all.size()));
    stats.p99 = nearestRank(all, 0.99);
    stats.p999 = nearestRank(all, 0.999);
    return stats;
}

Image errorImage(Metric metric, ChannelKind kind, const Image& baseline, const Image& test,
                 const Coverage& coverage) {
    checkAlike(baseline, test, coverage.covered.size());
    const PixelError error(metric, kind, baseline, coverage);
    Image errors(baseline.width, baseline.height, 1);
    for (std::size_t i = 0; i < errors.pixels(); ++i)
        if (coverage.covered[i]) {
            const double e = error(test.pixel(i), baseline.pixel(i));
            errors.data[i] = e > std::numeric_limits<float>::max() ? HUGE_VALF : static_cast<float>(e);
        }
    return errors;
}

std::uint64_t unequalPixels(const Image& a, const Image& b, int ulps) {
    checkAlike(a, b, a.pixels());
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        const float *p = a.pixel(i), *q = b.pixel(i);
        if (ulps == 0) {
            for (int c = 0; c < a.components; ++c)
                if (std::memcmp(p + c, q + c, sizeof(float)) != 0 &&
                    !(std::isnan(p[c]) && std::isnan(q[c]))) {
                    ++count;
                    break;
                }
        } else {
            const double largest = std::max(largestFinite(p, a.components), largestFinite(q, a.components));
            count += distance(p, q, a.components) > ulps * 0x1p-23 * largest;
        }
    }
    return count;
}

Image onePixel(const Image& image, std::size_t pixel) {
    Image one(1, 1, image.components);
    std::copy_n(image.pixel(pixel), image.components, one.data.data());
    return one;
}

}  // namespace diptych
