// SPDX-License-Identifier: MIT
#include "compare/metrics/flip.h"

#include "compare/metrics/flip_tiles.h"
#include "compare/metrics/order.h"
#include "compare/metrics/pixel.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <stdexcept>

namespace diptych {
namespace {

using metrics::finite;
using metrics::size;

constexpr double maxStops = 126;  // 2^126 is a float

// Two NaNs are equal, and so are equal infinities.
bool same(const float* a, const float* b) {
    for (int c = 0; c < 3; ++c)
        if (a[c] != b[c] && !(std::isnan(a[c]) && std::isnan(b[c]))) return false;
    return true;
}
bool within(const float* p, float min, float max) {
    return std::min({p[0], p[1], p[2]}) >= min && std::max({p[0], p[1], p[2]}) <= max;
}

void checkPair(const ImageRows& reference, const ImageRows& test, const FlipOptions& options) {
    if (reference.components != 3 || test.components != 3 || reference.width != test.width ||
        reference.height != test.height || reference.pixels() == 0)
        throw std::runtime_error(fmt::format(
            "FLIP compares two colour images of the same size, not {}x{} of {} components and {}x{} "
            "of {}; crop or resize one",
            reference.width, reference.height, reference.components, test.width, test.height,
            test.components));
    if (!options.covered.empty() && options.covered.size() != reference.pixels())
        throw std::runtime_error(fmt::format("FLIP of {}x{} pixels: {} coverage values; give one per pixel",
                                             reference.width, reference.height, options.covered.size()));
    if (!(options.pixels_per_degree >= 1 && options.pixels_per_degree <= 1000))
        throw std::runtime_error(
            fmt::format("FLIP with {} pixels per degree: give 1 to 1000", options.pixels_per_degree));
}

// Finds and counts holes.
FlipPair inspect(const ImageRows& reference, const ImageRows& test, FlipResult& result) {
    FlipPair pair{reference, test, {}};
    std::mutex lock;
    tbb::parallel_for(tbb::blocked_range<int>(0, reference.height, 32), [&](const auto& rows) {
        FlipResult found;
        eachPair(reference, test, rows.begin(), rows.end(), [&](std::size_t, const float* r, const float* t) {
            if (finite(r, 3) && finite(t, 3)) return;
            found.nonfinite_reference += !finite(r, 3);
            found.nonfinite_test += !finite(t, 3);
            found.nonfinite_different += !same(r, t);
        });
        const std::lock_guard hold(lock);
        result.nonfinite_reference += found.nonfinite_reference;
        result.nonfinite_test += found.nonfinite_test;
        result.nonfinite_different += found.nonfinite_different;
    });
    if (result.nonfinite_reference + result.nonfinite_test == 0) return pair;
    pair.holes.resize(reference.pixels());
    eachPair(reference, test, 0, reference.height, [&](std::size_t i, const float* r, const float* t) {
        if (!finite(r, 3) || !finite(t, 3)) pair.holes[i] = same(r, t) ? Hole::same : Hole::different;
    });
    return pair;
}

constexpr std::size_t pieceLength = 4096;  // values per chunk for an Order

// Order statistics of the errors that count.
metrics::Order counted(const FlipPair& pair, std::span<const std::uint8_t> covered, const Image& error) {
    if (covered.empty() && pair.holes.empty()) return metrics::Order(error.data);
    return {error.pixels(), [&pair, &error, covered](std::size_t from, std::size_t to, const auto& use) {
                std::vector<float> piece;
                for (std::size_t i = from; i < to; ++i) {
                    const bool counts = (covered.empty() || covered[i]) &&
                                        (pair.holes.empty() || pair.holes[i] != Hole::same);
                    if (counts) piece.push_back(error.data[i]);
                    if (piece.size() < pieceLength && i + 1 < to) continue;
                    use(piece);
                    piece.clear();
                }
            }};
}

void pool(const FlipPair& pair, std::span<const std::uint8_t> covered, FlipResult& result) {
    const metrics::Order order = counted(pair, covered, result.error);
    constexpr std::array ends{0.0, 1.0};
    const std::vector<float> ranks = order.nearestRanks(ends);
    result.pixels = order.size();
    result.mean = order.mean();
    result.min = ranks[0];
    result.max = ranks[1];
    result.weighted_first_quartile = order.weightedQuantile(0.25);
    result.weighted_median = order.weightedQuantile(0.5);
    result.weighted_third_quartile = order.weightedQuantile(0.75);
}

double checkedExposure(double stops) {
    if (!(std::abs(stops) <= maxStops))
        throw std::runtime_error(fmt::format("exposure {}: float32 has 2^{} to 2^{}; give stops in between",
                                             stops, -maxStops, maxStops));
    return stops;
}

void chooseExposures(const ImageRows& reference, const HdrFlipOptions& options, HdrFlipResult& result) {
    ExposureRange range;
    if (!options.start_exposure || !options.stop_exposure)
        range = exposureRange(reference, options.tone_mapper);
    result.start_exposure = checkedExposure(options.start_exposure.value_or(range.start));
    result.stop_exposure = checkedExposure(options.stop_exposure.value_or(range.stop));
    const double stops = result.stop_exposure - result.start_exposure;
    if (stops < 0)
        throw std::runtime_error(
            fmt::format("exposures from {} to {}: the first must be the lower one; swap them",
                        result.start_exposure, result.stop_exposure));
    result.exposures = options.exposures.value_or(std::max(2, static_cast<int>(std::ceil(stops))));
    if (result.exposures < 1)
        throw std::runtime_error(fmt::format("{} exposures: give 1 or more", result.exposures));
}

// Linear luminances (Rec.709) of the finite pixels; negative components count as 0. `lit`: only positive
// luminances.
metrics::Order luminances(const ImageRows& image, bool lit) {
    return {image.pixels(), [&image, lit](std::size_t from, std::size_t to, const auto& use) {
                const std::size_t width = size(image.width);
                std::vector<float> buffer, values;
                while (from < to) {
                    const std::size_t x = from % width, n = std::min(width - x, to - from);
                    const float* p = image.row(static_cast<int>(from / width), buffer) + 3 * x;
                    values.clear();
                    for (std::size_t i = 0; i < n; ++i, p += 3) {
                        if (!finite(p, 3)) continue;
                        const float y = 0.2126f * std::max(p[0], 0.0f) + 0.7152f * std::max(p[1], 0.0f) +
                                        0.0722f * std::max(p[2], 0.0f);
                        if (!lit || y > 0) values.push_back(y);
                    }
                    use(values);
                    from += n;
                }
            }};
}

// Linear values that no exposure shows: within half an 8-bit step of black at the highest, or of white at the
// lowest.
struct Beyond {
    double black = 0, white = std::numeric_limits<double>::infinity();
    explicit Beyond(const std::vector<FlipExposure>& flip_exposures) {
        if (flip_exposures.empty()) return;
        constexpr double half = 0.5 / 255;
        black = inverseToneCurve(flip_exposures.back().mapper, half / 12.92) /
                double{flip_exposures.back().scale};
        white =
            inverseToneCurve(flip_exposures.front().mapper, 1 - half) / double{flip_exposures.front().scale};
    }
    bool operator()(float r, float t) const { return std::max(r, t) <= black || std::min(r, t) >= white; }
};

// Sets the errors of different pixels that FLIP cannot see. `flip_exposures`: as for flipErrorMap().
void evaluateUnseen(const FlipPair& pair, const std::vector<FlipExposure>& flip_exposures,
                    FlipResult& result) {
    const Beyond beyond(flip_exposures);
    const float max = flip_exposures.empty() ? 1 : std::numeric_limits<float>::max();
    const auto isUnseen = [&](const float* r, const float* t) {
        if (!finite(r, 3) || !finite(t, 3) || same(r, t)) return false;
        if (!within(r, 0, max) || !within(t, 0, max)) return true;
        for (int c = 0; c < 3; ++c)
            if (r[c] != t[c] && !beyond(r[c], t[c])) return false;
        return true;
    };
    std::once_flag measured;
    double min = 0;
    std::atomic<std::uint64_t> different = 0;
    tbb::parallel_for(tbb::blocked_range<int>(0, pair.reference.height, 32), [&](const auto& rows) {
        eachPair(pair.reference, pair.test, rows.begin(), rows.end(),
                 [&](std::size_t i, const float* r, const float* t) {
                     if (!isUnseen(r, t)) return;
                     std::call_once(measured, [&] { min = 1e-3 * luminances(pair.reference, false).mean(); });
                     const bool differs = metrics::distance(r, t, 3) > min;
                     result.error.data[i] = differs ? 1.0f : 0.0f;
                     different += differs;
                 });
    });
    result.unseen_different = different;
}

}  // namespace

double pixelsPerDegree(double distance, double width, int pixels) {
    return distance * (pixels / width) * (std::numbers::pi / 180);
}

ExposureRange exposureRange(const ImageRows& reference, ToneMapper mapper) {
    constexpr std::array fractions{1.0, 0.5};
    const std::vector<float> ranks = luminances(reference, false).nearestRanks(fractions);
    const float max = ranks[0];
    if (!(max > 0)) return {};
    const float median = ranks[1] > 0 ? ranks[1] : luminances(reference, true).nearestRank(0.5);
    const double bright = inverseToneCurve(mapper, 0.85);
    return {std::clamp(std::log2(bright / max), -maxStops, maxStops),
            std::clamp(std::log2(bright / median), -maxStops, maxStops)};
}

FlipResult ldrFlip(const ImageRows& reference, const ImageRows& test, const FlipOptions& options) {
    checkPair(reference, test, options);
    FlipResult result;
    const FlipPair pair = inspect(reference, test, result);
    flipErrorMap(pair, FlipFilters(options.pixels_per_degree), {}, result.error);
    evaluateUnseen(pair, {}, result);
    pool(pair, options.covered, result);
    return result;
}

HdrFlipResult hdrFlip(const ImageRows& reference, const ImageRows& test, const HdrFlipOptions& options) {
    checkPair(reference, test, options);
    return HdrFlipAgainst(reference, options, 0)(test);
}

struct HdrFlipAgainst::State {
    State(const ImageRows& r, const HdrFlipOptions& o, std::size_t max_bytes) : reference(r), options(o) {
        checkPair(r, r, o);
        chooseExposures(r, o, begun);
        const double step =
            begun.exposures > 1 ? (begun.stop_exposure - begun.start_exposure) / (begun.exposures - 1) : 0;
        for (int i = 0; i < begun.exposures; ++i)
            flip_exposures.push_back(
                {static_cast<float>(std::exp2(begun.start_exposure + i * step)), o.tone_mapper});
        if (max_bytes == 0) return;
        FlipResult found;
        const FlipPair itself = inspect(r, r, found);
        cache.emplace(r, itself.holes, filters, flip_exposures, max_bytes);
    }

    // Computes only the error map; returns the pair.
    FlipPair compare(const ImageRows& test, HdrFlipResult& result) const {
        checkPair(reference, test, options);
        result = begun;
        FlipPair pair = inspect(reference, test, result);
        // The cached reference excludes only its own holes; a test may have more.
        const auto holes =
            pair.holes.size() - static_cast<std::size_t>(std::ranges::count(pair.holes, Hole::none));
        flipErrorMap(pair, filters, flip_exposures, result.error,
                     cache && holes == result.nonfinite_reference ? &*cache : nullptr);
        evaluateUnseen(pair, flip_exposures, result);
        return pair;
    }

    const ImageRows reference;
    const HdrFlipOptions options;
    const FlipFilters filters{options.pixels_per_degree};
    HdrFlipResult begun;  // has the exposures
    std::vector<FlipExposure> flip_exposures;
    std::optional<FilteredReference> cache;
};

HdrFlipAgainst::HdrFlipAgainst(const ImageRows& reference, const HdrFlipOptions& options,
                               std::size_t max_bytes)
    : state_(std::make_unique<const State>(reference, options, max_bytes)) {}
HdrFlipAgainst::~HdrFlipAgainst() = default;

HdrFlipResult HdrFlipAgainst::operator()(const ImageRows& test) const {
    HdrFlipResult result;
    const FlipPair pair = state_->compare(test, result);
    pool(pair, state_->options.covered, result);
    return result;
}

HdrFlipAgainst::Mean HdrFlipAgainst::mean(const ImageRows& test) const {
    HdrFlipResult result;
    const FlipPair pair = state_->compare(test, result);
    const metrics::Order order = counted(pair, state_->options.covered, result.error);
    return {order.mean(), order.size()};
}

}  // namespace diptych
