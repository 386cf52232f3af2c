// SPDX-License-Identifier: MIT
#include "compare/metrics/plain.h"

#include "compare/metrics/order.h"
#include "compare/metrics/pixel.h"
#include "compare/metrics/plain_rows.h"
#include "compare/metrics/ssim.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace diptych {

using namespace metrics;

namespace {

constexpr float notCovered = -1;  // in a list of errors: not covered
constexpr int bandHeight = 16;    // rows whose sums are made by one thread and added in one order

// The sums of one band of rows.
struct BandSums {
    RowSums components;
    double angles = 0, mostDegrees = 0, mostLength = 0, peak = 0;
    std::uint64_t different = 0, infinite = 0, nonfinite_reference = 0, nonfinite_test = 0;
};

class PlainPass {
public:
    PlainPass(const Image& reference, const Image& test, ChannelKind kind, const Coverage& coverage)
        : reference_(reference),
          test_(test),
          coverage_(coverage),
          angles_(kind == ChannelKind::vector && reference.components == 3),
          floor_(PixelError(Metric::relative, kind, reference, coverage).floor()),
          absolute(reference.pixels()),
          relative(reference.pixels()) {}

    bool angles() const { return angles_; }
    double meanMagnitude() const { return 1e3 * floor_; }

    // The sums of all rows.
    BandSums run() {
        std::vector<BandSums> bands(size((reference_.height + bandHeight - 1) / bandHeight));
        tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t i) {
            const int from = static_cast<int>(i) * bandHeight;
            for (int y = from; y < std::min(from + bandHeight, reference_.height); ++y) row(y, bands[i]);
        });
        BandSums total;
        for (const BandSums& band : bands) {
            total.components.add(band.components);
            total.angles += band.angles;
            total.mostDegrees = std::max(total.mostDegrees, band.mostDegrees);
            total.mostLength = std::max(total.mostLength, band.mostLength);
            total.peak = std::max(total.peak, band.peak);
            total.different += band.different;
            total.infinite += band.infinite;
            total.nonfinite_reference += band.nonfinite_reference;
            total.nonfinite_test += band.nonfinite_test;
        }
        return total;
    }

private:
    void row(int y, BandSums& sums);
    // For a row with nonfinite or uncovered pixels: adds copies of the row in which their components are 0.
    void unevenRow(int y, BandSums& sums);
    void addFinite(int y, const float* test, const float* reference, BandSums& sums);

    const Image &reference_, &test_;
    const Coverage& coverage_;
    bool angles_;
    double floor_;

public:
    std::vector<float> absolute, relative;  // per pixel; below 0: not covered
};

void PlainPass::addFinite(int y, const float* test, const float* reference, BandSums& sums) {
    const int width = reference_.width, components = reference_.components;
    const std::size_t at = size(y) * size(width);
    addRow(sums.components, test, reference, width * components);
    pixelErrors(&absolute[at], &relative[at], test, reference, components, floor_, width);
    for (int i = 0; i < width * components; ++i)
        sums.peak = reference[i] > sums.peak ? double{reference[i]} : sums.peak;
    for (std::size_t x = 0; x < size(width); ++x) {
        if (absolute[at + x] == 0) continue;
        ++sums.different;
        if (!angles_) continue;
        const double degrees = angle(test + 3 * x, reference + 3 * x);
        sums.angles += degrees;
        sums.mostDegrees = std::max(sums.mostDegrees, degrees);
        sums.mostLength = std::max(sums.mostLength, lengthsApart(test + 3 * x, reference + 3 * x));
    }
}

void PlainPass::unevenRow(int y, BandSums& sums) {
    const int components = reference_.components;
    const std::size_t width = size(reference_.width), at = size(y) * width;
    const auto n = width * size(components);
    std::vector<float> test(test_.pixel(at), test_.pixel(at) + n);
    std::vector<float> reference(reference_.pixel(at), reference_.pixel(at) + n);
    std::vector<std::size_t> infinitePixels;
    for (std::size_t x = 0; x < width; ++x) {
        float *t = test.data() + x * size(components), *r = reference.data() + x * size(components);
        sums.nonfinite_reference += !finite(r, components);
        sums.nonfinite_test += !finite(t, components);
        if (coverage_.covered[at + x] && distance(t, r, components) == infinity) infinitePixels.push_back(x);
        for (int c = 0; c < components; ++c)
            if (!coverage_.covered[at + x] || !std::isfinite(t[c]) || !std::isfinite(r[c])) t[c] = r[c] = 0;
    }
    addFinite(y, test.data(), reference.data(), sums);
    for (const std::size_t x : infinitePixels) {
        sums.different += absolute[at + x] == 0;
        ++sums.infinite;
        absolute[at + x] = relative[at + x] = HUGE_VALF;
    }
    for (std::size_t x = 0; x < width; ++x)
        if (!coverage_.covered[at + x]) absolute[at + x] = relative[at + x] = notCovered;
}

void PlainPass::row(int y, BandSums& sums) {
    const std::size_t at = size(y) * size(reference_.width);
    const int n = reference_.width * reference_.components;
    const std::uint8_t* covered = coverage_.covered.data() + at;
    if (allFinite(test_.pixel(at), n) && allFinite(reference_.pixel(at), n) &&
        std::all_of(covered, covered + reference_.width, [](std::uint8_t c) { return c != 0; }))
        addFinite(y, test_.pixel(at), reference_.pixel(at), sums);
    else
        unevenRow(y, sums);
}

void checkPair(const Image& reference, const Image& test, const Coverage& coverage) {
    if (reference.width != test.width || reference.height != test.height ||
        reference.components != test.components || reference.components < 1 || reference.components > 4 ||
        coverage.covered.size() != reference.pixels())
        throw std::runtime_error(
            fmt::format("pictures of {}x{}x{} and {}x{}x{} cannot be compared; give two of one size, of 1 to "
                        "4 components",
                        reference.width, reference.height, reference.components, test.width, test.height,
                        test.components));
}

void setPixels(const PlainPass& pass, PlainMetrics& m) {
    const Order absolute(pass.absolute), relative(pass.relative);
    m.max = absolute.nearestRank(1);
    m.p99 = absolute.nearestRank(0.99);
    m.p999 = absolute.nearestRank(0.999);
    m.relative_max = relative.nearestRank(1);
    m.relative_mean = relative.mean();
    m.relative_p99 = relative.nearestRank(0.99);
    m.relative_p999 = relative.nearestRank(0.999);
}

void setComponents(const BandSums& sums, double components, Range range, PlainMetrics& m) {
    const double beyond = m.nonfinite_different ? infinity : 0;
    const RowSums& s = sums.components;
    m.mse = RowSums::total(s.squared) / components + beyond;
    m.rmse = std::sqrt(m.mse);
    m.mae = RowSums::total(s.absolute) / components + beyond;
    m.relative_mse = RowSums::total(s.relative) / components + beyond;
    m.ulp_mean = RowSums::total(s.ulps) / components + beyond;
    m.ulp_max = s.mostUlps + beyond;
    m.peak = range == Range::display ? 1 : sums.peak;
    m.psnr = m.mse > 0 ? 10 * std::log10(m.peak * m.peak / m.mse) : infinity;
}

void setAngles(const BandSums& sums, PlainMetrics& m) {
    const double beyond = m.nonfinite_different ? infinity : 0;
    m.angle_max = sums.mostDegrees + beyond;
    m.length_max = sums.mostLength + beyond;
    m.angle_mean = sums.angles / static_cast<double>(m.pixels) + beyond;
}

// The plane of luma that SSIM compares.
Image luma(const Image& image, Range range, float scale) {
    Image plane(image.width, image.height, 1);
    tbb::parallel_for(tbb::blocked_range<int>(0, image.height, bandHeight), [&](const auto& rows) {
        for (int y = rows.begin(); y < rows.end(); ++y) {
            float* out = &plane.at(0, y);
            const float* rgb = image.data.data() + image.offset(0, y);
            if (range == Range::display)
                lumaFromDisplay(out, rgb, image.width);
            else
                lumaFromLinear(out, rgb, image.width, scale);
        }
    });
    return plane;
}

std::optional<double> ssimOf(const Image& reference, const Image& test, Range range, double meanLuminance,
                             const Coverage& coverage) {
    // A black reference has no mean to go by; a dim one's inverse may be no float.
    const double scale = meanLuminance > 0 ? std::min(0.18 / meanLuminance, 1e30) : 1;
    const auto s = static_cast<float>(scale);
    return ssim(luma(reference, range, s), luma(test, range, s), coverage.covered);
}

}  // namespace

PlainMetrics plainMetrics(const Image& reference, const Image& test, ChannelKind kind, Range range,
                          const Coverage& coverage) {
    checkPair(reference, test, coverage);
    PlainMetrics m;
    PlainPass pass(reference, test, kind, coverage);
    const BandSums sums = pass.run();
    m.pixels = coverage.count;
    m.different = sums.different;
    m.nonfinite_different = sums.infinite;
    m.nonfinite_reference = sums.nonfinite_reference;
    m.nonfinite_test = sums.nonfinite_test;
    if (m.pixels == 0) return m;
    setComponents(sums, static_cast<double>(m.pixels) * reference.components, range, m);
    setPixels(pass, m);
    if (pass.angles()) setAngles(sums, m);
    if (kind == ChannelKind::color && reference.components == 3)
        m.ssim = ssimOf(reference, test, range, pass.meanMagnitude(), coverage);
    return m;
}

}  // namespace diptych
