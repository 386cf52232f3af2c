// SPDX-License-Identifier: MIT
#include "compare/metrics/channel.h"

#include "compare/metrics/pixel.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>

namespace diptych {

using namespace metrics;

namespace {

// Luminance of a colour (Rec.709), magnitude of other values.
double magnitude(const float* p, int components, ChannelKind kind) {
    if (kind == ChannelKind::color && components == 3)
        return std::abs(0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
    double squares = 0;
    for (int c = 0; c < components; ++c) squares += double{p[c]} * p[c];
    return std::sqrt(squares);
}

double meanMagnitude(const ImageRows& image, ChannelKind kind, const Coverage& coverage) {
    double sum = 0;
    std::size_t count = 0;
    std::vector<float> buffer;
    for (int y = 0; y < image.height; ++y) {
        const float* p = image.row(y, buffer);
        const std::uint8_t* covered = coverage.covered.data() + size(y) * size(image.width);
        for (int x = 0; x < image.width; ++x, p += image.components)
            if (covered[x] && finite(p, image.components)) {
                sum += magnitude(p, image.components, kind);
                ++count;
            }
    }
    return count ? sum / static_cast<double>(count) : 0;
}

// The bits of non-negative doubles sort like their values.
constexpr int digit = 16;  // bits per histogram pass
using Histogram = std::vector<std::uint64_t>;

// Exact ranks of the errors of covered pixels without storing them all. A histogram of the first digits
// selects a bin; the pixels are then measured again for errors in that bin.
class Ranks {
public:
    // `first`: histogram of the non-zero errors by first digit. `zeros`: count of the others.
    Ranks(const ImageRows& baseline, const ImageRows& test, const Coverage& coverage, const PixelError& error,
          const Histogram& first, std::uint64_t zeros)
        : baseline_(baseline),
          test_(test),
          coverage_(coverage),
          error_(error),
          first_(first),
          zeros_(zeros),
          count_(std::accumulate(first.begin(), first.end(), zeros)) {}

    // The ceil(fraction N)-th smallest error for each fraction.
    std::array<double, 2> nearest(const std::array<double, 2>& fractions) const {
        std::array<double, 2> values{};
        std::vector<Sought> sought;
        for (std::size_t i = 0; i < fractions.size(); ++i) {
            const auto rank =
                static_cast<std::uint64_t>(std::ceil(fractions[i] * static_cast<double>(count_)));
            if (rank > zeros_) sought.push_back({&values[i], rank - zeros_, first_});
        }
        for (int shift = 64 - digit; !sought.empty(); shift -= digit) {
            for (Sought& s : sought) {
                std::size_t bin = 0;
                for (; s.rank > s.counts[bin]; ++bin) s.rank -= s.counts[bin];
                s.prefix = s.prefix << digit | bin;
                s.few = s.counts[bin] <= few;
                if (shift == 0) *s.value = std::bit_cast<double>(s.prefix);
            }
            if (shift == 0) break;
            countErrors(sought, shift);
            std::erase_if(sought, [](Sought& s) {
                if (!s.few) return false;
                const auto nth = s.gathered.begin() + static_cast<std::ptrdiff_t>(s.rank - 1);
                std::ranges::nth_element(s.gathered, nth);
                *s.value = *nth;
                return true;
            });
        }
        return values;
    }

private:
    static constexpr std::uint64_t few = 1 << 20;  // 8 MB of errors

    struct Sought {
        double* value;
        std::uint64_t rank;              // among the errors that begin with `prefix`, from 1
        Histogram counts;                // of these errors, by the next digit
        std::vector<double> gathered{};  // these errors, if few
        std::uint64_t prefix = 0;
        bool few = false;
    };

    // Gathers or counts the errors that begin with each prefix. A prefix has all bits except the lowest
    // `shift`.
    void countErrors(std::vector<Sought>& sought, int shift) const {
        struct Found {
            std::vector<Histogram> counts;
            std::vector<std::vector<double>> gathered;
        };
        const std::size_t n = sought.size();
        tbb::enumerable_thread_specific<Found> results([n] {
            return Found{std::vector(n, Histogram(std::size_t{1} << digit)),
                         std::vector<std::vector<double>>(n)};
        });
        tbb::parallel_for(tbb::blocked_range<int>(0, baseline_.height, 16), [&](const auto& rows) {
            Found& own = results.local();
            eachPair(test_, baseline_, rows.begin(), rows.end(),
                     [&](std::size_t i, const float* a, const float* b) {
                         if (!coverage_.covered[i]) return;
                         const double e = error_(a, b);
                         const auto bits = std::bit_cast<std::uint64_t>(e);
                         for (std::size_t k = 0; e != 0 && k < n; ++k)
                             if (bits >> shift != sought[k].prefix)
                                 continue;
                             else if (sought[k].few)
                                 own.gathered[k].push_back(e);
                             else
                                 ++own.counts[k][bits >> (shift - digit) & ((1u << digit) - 1)];
                     });
        });
        for (std::size_t k = 0; k < n; ++k) {
            std::ranges::fill(sought[k].counts, 0);
            for (const Found& found : results) {
                std::ranges::transform(sought[k].counts, found.counts[k], sought[k].counts.begin(),
                                       std::plus());
                sought[k].gathered.insert(sought[k].gathered.end(), found.gathered[k].begin(),
                                          found.gathered[k].end());
            }
        }
    }

    const ImageRows &baseline_, &test_;
    const Coverage& coverage_;
    const PixelError& error_;
    const Histogram& first_;
    std::uint64_t zeros_, count_;
};

void checkAlike(const ImageRows& a, const ImageRows& b, std::size_t covered) {
    if (a.width != b.width || a.height != b.height || a.components != b.components || a.pixels() != covered)
        throw std::runtime_error(fmt::format("images of {}x{}x{} and {}x{}x{} cannot be compared", a.width,
                                             a.height, a.components, b.width, b.height, b.components));
}

// The channel that identifies background, and its value there.
std::optional<std::pair<Channel, float>> backgroundChannel(const Frame& a, const Frame& b) {
    for (const auto& [mode, value] : {std::pair{Channel::material_id, -1.0f}, {Channel::depth, 0.0f}})
        if (a.channels.contains(mode) && b.channels.contains(mode)) return std::pair{mode, value};
    return {};
}

// Whether a blended surface covers the pixel, if the Frame knows. Against the background, such a pixel
// counts as surface.
bool showsBlended(const Frame& frame, std::size_t pixel) {
    if (!frame.blended.empty()) return *frame.blended.pixel(pixel) > 0;
    const Image* const lit = findChannel(frame, Channel::lit);
    return lit && !frame.unblended.empty() &&
           distance(lit->pixel(pixel), frame.unblended.pixel(pixel), lit->components) != 0;
}

}  // namespace

bool isBlack(const ImageRows& image, const Coverage& coverage) {
    std::vector<float> buffer;
    for (int y = 0; y < image.height; ++y) {
        const float* p = image.row(y, buffer);
        const std::uint8_t* covered = coverage.covered.data() + size(y) * size(image.width);
        for (int x = 0; x < image.width; ++x, p += image.components)
            if (covered[x] && std::any_of(p, p + image.components, [](float v) { return v != 0; }))
                return false;
    }
    return true;
}

double litFraction(const ImageRows& image, const Coverage& coverage) {
    std::vector<float> buffer;
    std::size_t all = 0, lit = 0;
    for (int y = 0; y < image.height; ++y) {
        const float* p = image.row(y, buffer);
        const std::uint8_t* covered = coverage.covered.data() + size(y) * size(image.width);
        for (int x = 0; x < image.width; ++x, p += image.components) {
            if (!covered[x]) continue;
            ++all;
            lit += std::any_of(p, p + image.components, [](float v) { return v != 0; });
        }
    }
    return all == 0 ? 0 : static_cast<double>(lit) / static_cast<double>(all);
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

PixelError::PixelError(ErrorKind errorKind, ChannelKind kind, const ImageRows& baseline,
                       const Coverage& coverage)
    : error_kind_(errorKind), components_(baseline.components) {
    if (errorKind == ErrorKind::relative) floor_ = 1e-3 * meanMagnitude(baseline, kind, coverage);
    if (isAngle(errorKind) && components_ != 3)
        throw std::runtime_error(fmt::format("angles need vectors of 3 components, not {}", components_));
}

double PixelError::operator()(const float* test, const float* baseline) const {
    const double difference = distance(test, baseline, components_);
    if (difference == 0 || difference == infinity) return difference;
    switch (error_kind_) {
        case ErrorKind::relative:
            return difference / std::max(largestFinite(baseline, components_), floor_);
        case ErrorKind::absolute:
            return difference;
        case ErrorKind::angular:
            return finite(test, components_) ? angle(test, baseline) : infinity;
        case ErrorKind::axial:
            return finite(test, components_) ? lineAngle(test, baseline) : infinity;
        case ErrorKind::exact:
            return 1;
    }
    return infinity;
}

ChannelStats channelStats(ErrorKind errorKind, ChannelKind kind, const ImageRows& baseline,
                          const ImageRows& test, const Coverage& coverage) {
    checkAlike(baseline, test, coverage.covered.size());
    const PixelError error(errorKind, kind, baseline, coverage);
    ChannelStats stats;
    Histogram first(std::size_t{1} << digit);
    std::uint64_t zeros = 0;
    double sum = 0, squares = 0;
    eachPair(test, baseline, 0, baseline.height, [&](std::size_t i, const float* a, const float* b) {
        stats.nonfinite_test += !finite(a, test.components);
        stats.nonfinite_baseline += !finite(b, test.components);
        if (!coverage.covered[i]) return;
        const double e = error(a, b);
        if (e == 0) {
            ++zeros;
            return;
        }
        ++first[std::bit_cast<std::uint64_t>(e) >> (64 - digit)];
        sum += e;
        squares += e * e;
        ++stats.different;
        stats.infinite += e == infinity;
        if (e > stats.max) {
            stats.max = e;
            stats.worst_x = static_cast<int>(i % size(baseline.width));
            stats.worst_y = static_cast<int>(i / size(baseline.width));
        }
    });
    if (stats.different == 0) return stats;
    const auto count = static_cast<double>(stats.different + zeros);
    stats.mean = sum / count;
    stats.rmse = std::sqrt(squares / count);
    const auto ranks = Ranks(baseline, test, coverage, error, first, zeros).nearest({0.99, 0.999});
    stats.p99 = ranks[0];
    stats.p999 = ranks[1];
    return stats;
}

Image errorImage(ErrorKind errorKind, ChannelKind kind, const ImageRows& baseline, const ImageRows& test,
                 const Coverage& coverage) {
    checkAlike(baseline, test, coverage.covered.size());
    const PixelError error(errorKind, kind, baseline, coverage);
    Image errors(baseline.width, baseline.height, 1);
    eachPair(test, baseline, 0, baseline.height, [&](std::size_t i, const float* a, const float* b) {
        if (!coverage.covered[i]) return;
        const double e = error(a, b);
        errors.data[i] = e > std::numeric_limits<float>::max() ? HUGE_VALF : static_cast<float>(e);
    });
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
