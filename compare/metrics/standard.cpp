// SPDX-License-Identifier: MIT
#include "compare/metrics/standard.h"

#include "compare/metrics/order.h"
#include "compare/metrics/pixel.h"
#include "compare/metrics/ssim.h"
#include "compare/metrics/standard_rows.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

namespace diptych {

using namespace metrics;

namespace {

constexpr float notCovered = -1;  // marks uncovered pixels in a list of errors
constexpr int bandHeight = 16;    // rows that one thread sums; bands are added in a fixed order

// Sums over one band of rows.
struct BandSums {
    RowSums components;
    double angles = 0, maxDegrees = 0, maxLength = 0, peak = 0;
    std::uint64_t different = 0, infinite = 0, nonfinite_reference = 0, nonfinite_test = 0;
};

class StandardPass {
public:
    StandardPass(const ImageRows& reference, const ImageRows& test, ChannelKind kind,
                 const Coverage& coverage, ErrorKind errorKind)
        : reference_(reference),
          test_(test),
          coverage_(coverage),
          angles_(kind == ChannelKind::vector && reference.components == 3),
          lines_(errorKind == ErrorKind::axial),
          floor_(PixelError(ErrorKind::relative, kind, reference, coverage).floor()) {}

    bool angles() const { return angles_; }
    double meanMagnitude() const { return 1e3 * floor_; }

    // Sums over all rows.
    BandSums run() const {
        std::vector<BandSums> bands(size((reference_.height + bandHeight - 1) / bandHeight));
        tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t i) {
            const int from = static_cast<int>(i) * bandHeight;
            Row row;
            for (int y = from; y < std::min(from + bandHeight, reference_.height); ++y) add(y, row, bands[i]);
        });
        BandSums total;
        for (const BandSums& band : bands) {
            total.components.add(band.components);
            total.angles += band.angles;
            total.maxDegrees = std::max(total.maxDegrees, band.maxDegrees);
            total.maxLength = std::max(total.maxLength, band.maxLength);
            total.peak = std::max(total.peak, band.peak);
            total.different += band.different;
            total.infinite += band.infinite;
            total.nonfinite_reference += band.nonfinite_reference;
            total.nonfinite_test += band.nonfinite_test;
        }
        return total;
    }

    // Relative errors of all pixels; < 0: not covered. They are recomputed for each pass.
    Order relative() const {
        return {reference_.pixels(), [this](std::size_t from, std::size_t to, const Order::Use& use) {
                    const std::size_t width = size(reference_.width);
                    Row row;
                    for (std::size_t at = from; at < to;) {
                        const std::size_t x = at % width, n = std::min(width - x, to - at);
                        measure(static_cast<int>(at / width), row);
                        use(std::span(row.relative).subspan(x, n));
                        at += n;
                    }
                }};
    }

private:
    // The measurements of one row; its buffers are reused.
    struct Row {
        std::vector<float> buffers[2];
        const float *test, *reference;          // uncovered and non-finite components are 0
        std::vector<float> absolute, relative;  // per pixel; < 0: not covered
        std::uint64_t infinite, nonfinite_reference, nonfinite_test;
    };
    void measure(int y, Row& row) const;
    // Copies rows and replaces non-finite and uncovered values by 0; returns columns with infinite
    // difference.
    std::vector<std::size_t> clean(int y, Row& row) const;
    void add(int y, Row& row, BandSums& sums) const;

    const ImageRows &reference_, &test_;
    const Coverage& coverage_;
    bool angles_, lines_;
    double floor_;
};

std::vector<std::size_t> StandardPass::clean(int y, Row& row) const {
    const int components = reference_.components;
    const std::size_t width = size(reference_.width), n = width * size(components);
    const std::uint8_t* covered = coverage_.covered.data() + size(y) * width;
    row.buffers[0].assign(row.test, row.test + n);
    row.buffers[1].assign(row.reference, row.reference + n);
    row.test = row.buffers[0].data();
    row.reference = row.buffers[1].data();
    std::vector<std::size_t> infinitePixels;
    for (std::size_t x = 0; x < width; ++x) {
        float *t = row.buffers[0].data() + x * size(components),
              *r = row.buffers[1].data() + x * size(components);
        row.nonfinite_reference += !finite(r, components);
        row.nonfinite_test += !finite(t, components);
        if (covered[x] && distance(t, r, components) == infinity) infinitePixels.push_back(x);
        for (int c = 0; c < components; ++c)
            if (!covered[x] || !std::isfinite(t[c]) || !std::isfinite(r[c])) t[c] = r[c] = 0;
    }
    return infinitePixels;
}

void StandardPass::measure(int y, Row& row) const {
    const int width = reference_.width, n = width * reference_.components;
    const std::uint8_t* covered = coverage_.covered.data() + size(y) * size(width);
    row.infinite = row.nonfinite_reference = row.nonfinite_test = 0;
    row.test = test_.row(y, row.buffers[0]);
    row.reference = reference_.row(y, row.buffers[1]);
    const bool whole = std::all_of(covered, covered + width, [](std::uint8_t c) { return c != 0; });
    const bool even = whole && allFinite(row.test, n) && allFinite(row.reference, n);
    const std::vector<std::size_t> infinitePixels = even ? std::vector<std::size_t>() : clean(y, row);
    row.absolute.resize(size(width));
    row.relative.resize(size(width));
    pixelErrors(row.absolute.data(), row.relative.data(),
                {row.test, row.reference, reference_.components, width}, floor_);
    row.infinite = infinitePixels.size();
    for (const std::size_t x : infinitePixels) row.absolute[x] = row.relative[x] = HUGE_VALF;
    if (whole) return;
    for (std::size_t x = 0; x < size(width); ++x)
        if (!covered[x]) row.absolute[x] = row.relative[x] = notCovered;
}

void StandardPass::add(int y, Row& row, BandSums& sums) const {
    measure(y, row);
    const int width = reference_.width, n = width * reference_.components;
    addRow(sums.components, row.test, row.reference, n);
    for (int i = 0; i < n; ++i)
        sums.peak = row.reference[i] > sums.peak ? double{row.reference[i]} : sums.peak;
    sums.infinite += row.infinite;
    sums.nonfinite_reference += row.nonfinite_reference;
    sums.nonfinite_test += row.nonfinite_test;
    for (std::size_t x = 0; x < size(width); ++x) {
        if (!(row.absolute[x] > 0)) continue;
        ++sums.different;
        if (!angles_) continue;
        const float *t = row.test + 3 * x, *r = row.reference + 3 * x;
        // They differ only in a non-finite component, which is 0 here.
        if (std::equal(t, t + 3, r)) continue;
        const double degrees = lines_ ? lineAngle(t, r) : angle(t, r);
        sums.angles += degrees;
        sums.maxDegrees = std::max(sums.maxDegrees, degrees);
        sums.maxLength = std::max(sums.maxLength, lengthDifference(t, r));
    }
}

void checkPair(const ImageRows& reference, const ImageRows& test, const Coverage& coverage) {
    if (reference.width != test.width || reference.height != test.height ||
        reference.components != test.components || reference.components < 1 || reference.components > 4 ||
        coverage.covered.size() != reference.pixels())
        throw std::runtime_error(
            fmt::format("images of {}x{}x{} and {}x{}x{} cannot be compared; give two of the same size with "
                        "1 to 4 components",
                        reference.width, reference.height, reference.components, test.width, test.height,
                        test.components));
}

void setPixels(const StandardPass& pass, StandardMetrics& m) {
    constexpr std::array fractions{1.0, 0.99, 0.999};
    const Order relative = pass.relative();
    const std::vector<float> ranks = relative.nearestRanks(fractions);
    m.relative_max = ranks[0];
    m.relative_mean = relative.mean();
    m.relative_p99 = ranks[1];
    m.relative_p999 = ranks[2];
}

void setComponents(const BandSums& sums, double components, Range range, StandardMetrics& m) {
    const double beyond = m.nonfinite_different ? infinity : 0;
    const RowSums& s = sums.components;
    m.mse = RowSums::total(s.squared) / components + beyond;
    m.rmse = std::sqrt(m.mse);
    m.mae = RowSums::total(s.absolute) / components + beyond;
    m.relative_mse = RowSums::total(s.relative) / components + beyond;
    m.ulp_mean = RowSums::total(s.ulps) / components + beyond;
    m.ulp_max = s.maxUlps + beyond;
    m.peak = range == Range::display ? 1 : sums.peak;
    m.psnr = m.mse > 0 ? 10 * std::log10(m.peak * m.peak / m.mse) : infinity;
}

void setAngles(const BandSums& sums, StandardMetrics& m) {
    const double beyond = m.nonfinite_different ? infinity : 0;
    m.angle_max = sums.maxDegrees + beyond;
    m.length_max = sums.maxLength + beyond;
    m.angle_mean = sums.angles / static_cast<double>(m.pixels) + beyond;
}

// The luma plane for SSIM.
PlaneRow luma(const ImageRows& image, Range range, float scale) {
    return [=, &image](float* out, int y) {
        static thread_local std::vector<float> buffer;
        const float* rgb = image.row(y, buffer);
        if (range == Range::display)
            lumaFromDisplay(out, rgb, image.width);
        else
            lumaFromLinear(out, rgb, image.width, scale);
    };
}

std::optional<double> ssimOf(const ImageRows& reference, const ImageRows& test, Range range,
                             double meanLuminance, const Coverage& coverage) {
    // A black reference has no mean; the inverse of a tiny mean may overflow.
    const double scale = meanLuminance > 0 ? std::min(0.18 / meanLuminance, 1e30) : 1;
    const auto s = static_cast<float>(scale);
    return ssim(reference.width, reference.height, luma(reference, range, s), luma(test, range, s),
                coverage.covered);
}

}  // namespace

StandardMetrics standardMetrics(const ImageRows& reference, const ImageRows& test, ChannelKind kind,
                                Range range, const Coverage& coverage, ErrorKind errorKind) {
    checkPair(reference, test, coverage);
    StandardMetrics m;
    const StandardPass pass(reference, test, kind, coverage, errorKind);
    const BandSums sums = pass.run();
    m.pixels = coverage.count;
    m.different = sums.different;
    m.nonfinite_different = sums.infinite;
    m.nonfinite_reference = sums.nonfinite_reference;
    m.nonfinite_test = sums.nonfinite_test;
    if (m.pixels == 0) return m;
    setComponents(sums, static_cast<double>(m.pixels) * reference.components, range, m);
    if (m.different > 0) setPixels(pass, m);
    if (pass.angles()) setAngles(sums, m);
    if (kind == ChannelKind::color && reference.components == 3)
        m.ssim = ssimOf(reference, test, range, pass.meanMagnitude(), coverage);
    return m;
}

}  // namespace diptych
