// SPDX-License-Identifier: MIT
#include "compare/verdict/measurement.h"

#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

namespace diptych {
namespace {

using Value = std::optional<double>;

// A metric and the function that returns its value.
struct Row {
    Metric metric;
    Value (*value)(const Measurement&);
};

template <double ChannelStats::*member>
Value stat(const Measurement& m) {
    return m.stats().*member;
}
template <double StandardMetrics::*member>
Value plain(const Measurement& m) {
    return m.plain().*member;
}
template <double FlipResult::*member>
Value flip(const Measurement& m) {
    return m.flip() ? Value(m.flip()->*member) : Value();
}
template <double StandardMetrics::*member>
Value angle(const Measurement& m) {
    return m.isVector() ? Value(m.plain().*member) : Value();
}

const std::array rows{
    Row{{"max", false, "largest error, in the channel's metric"}, stat<&ChannelStats::max>},
    Row{{"mean", false, "mean error, in the channel's metric"}, stat<&ChannelStats::mean>},
    Row{{"rmse", false, "root of the mean squared error, in the channel's metric"},
        stat<&ChannelStats::rmse>},
    Row{{"p99", false, "99th percentile of the error, nearest rank, in the channel's metric"},
        stat<&ChannelStats::p99>},
    Row{{"p999", false, "99.9th percentile of the error, nearest rank, in the channel's metric"},
        stat<&ChannelStats::p999>},
    Row{{"flip", false, "mean FLIP, 0 to 1 (Andersson et al. 2020; HDR: 2021)"}, flip<&FlipResult::mean>},
    Row{{"flip_median", false, "weighted median of FLIP"}, flip<&FlipResult::weighted_median>},
    Row{{"flip_max", false, "largest FLIP"}, flip<&FlipResult::max>},
    Row{{"mse", false, "mean over components of (t - r)^2"}, plain<&StandardMetrics::mse>},
    Row{{"mae", false, "mean over components of |t - r|"}, plain<&StandardMetrics::mae>},
    Row{{"relative_mse", false, "mean of (t - r)^2 / (r^2 + 0.01) (Rousselle et al. 2011)"},
        plain<&StandardMetrics::relative_mse>},
    Row{{"relative_max", false, "largest |t - r| / max(|r|, 1e-3 mean)"},
        plain<&StandardMetrics::relative_max>},
    Row{{"relative_mean", false, "mean of |t - r| / max(|r|, 1e-3 mean)"},
        plain<&StandardMetrics::relative_mean>},
    Row{{"relative_p99", false, "99th percentile of |t - r| / max(|r|, 1e-3 mean)"},
        plain<&StandardMetrics::relative_p99>},
    Row{{"relative_p999", false, "99.9th percentile of |t - r| / max(|r|, 1e-3 mean)"},
        plain<&StandardMetrics::relative_p999>},
    Row{{"psnr", true, "10 log10(peak^2 / mse), dB; peak 1, or the reference's largest linear value"},
        plain<&StandardMetrics::psnr>},
    Row{{"ssim", true, "mean structural similarity, at most 1 (Wang et al. 2004)"},
        [](const Measurement& m) { return m.plain().ssim; }},
    Row{{"ulp_max", false, "largest number of float32 values between t and r"},
        plain<&StandardMetrics::ulp_max>},
    Row{{"ulp_mean", false, "mean number of float32 values between t and r"},
        plain<&StandardMetrics::ulp_mean>},
    Row{{"angle_max", false, "largest angle between vectors, degrees"}, angle<&StandardMetrics::angle_max>},
    Row{{"angle_mean", false, "mean angle between vectors, degrees"}, angle<&StandardMetrics::angle_mean>},
    Row{{"granted", false, "against the reference: mean relative error of lit granted to approximations"},
        [](const Measurement& m) { return m.approximationError(); }},
    Row{{"length_max", false, "largest difference of vector lengths"}, angle<&StandardMetrics::length_max>},
};

}  // namespace

std::span<const Metric> allMetrics() {
    static const auto table = [] {
        std::array<Metric, rows.size()> all{};
        std::ranges::transform(rows, all.begin(), &Row::metric);
        return all;
    }();
    return table;
}

const Metric* findMetric(std::string_view name) {
    const auto found = std::ranges::find(allMetrics(), name, &Metric::name);
    return found == allMetrics().end() ? nullptr : &*found;
}

bool isBetterIfMore(std::string_view name) {
    const Metric* const metric = findMetric(name);
    return metric && metric->more_is_better;
}

bool Measurement::isVector() const {
    return pair_.kind == ChannelKind::vector && pair_.reference.components == 3;
}

std::optional<double> Measurement::operator()(const Quantity& quantity) const {
    if (quantity.metric == FAILING) return fractionOf(pixelsAbove(quantity.above));
    const auto row = std::ranges::find(rows, quantity.metric, [](const Row& r) { return r.metric.name; });
    return row == rows.end() ? Value() : row->value(*this);
}

std::vector<std::pair<std::string, double>> Measurement::all() const {
    std::vector<std::pair<std::string, double>> values;
    for (const Row& row : rows)
        if (const Value value = row.value(*this)) values.emplace_back(row.metric.name, *value);
    return values;
}

const ChannelStats& Measurement::stats() const {
    if (pair_.stats) return *pair_.stats;
    if (!stats_) {
        stats_ = channelStats(pair_.error_kind, pair_.kind, pair_.reference, pair_.test, *pair_.coverage);
        if (pair_.error_kind == ErrorKind::absolute) {
            stats_->mean = plain().mae;
            stats_->rmse = plain().rmse;
        }
    }
    return *stats_;
}

const StandardMetrics& Measurement::plain() const {
    if (!plain_)
        plain_ = standardMetrics(pair_.reference, pair_.test, pair_.kind,
                                 pair_.display ? Range::display : Range::linear, *pair_.coverage,
                                 pair_.error_kind);
    return *plain_;
}

// FLIP's filters read neighbouring pixels. Uncovered pixels become NaN in both images, so that they do not
// affect covered ones.
Image Measurement::withHoles(const ImageRows& image) const {
    Image holed(image.width, image.height, image.components);
    for (int y = 0; y < image.height; ++y) image.copy(&holed.at(0, y), 0, y, image.width);
    for (std::size_t i = 0; i < holed.pixels(); ++i)
        if (!pair_.coverage->covered[i])
            std::fill_n(holed.pixel(i), holed.components, std::numeric_limits<float>::quiet_NaN());
    return holed;
}

const HdrFlipResult* Measurement::flip() const {
    if (pair_.kind != ChannelKind::color || pair_.reference.components != 3) return nullptr;
    if (!flip_) {
        HdrFlipOptions options = pair_.flip;
        options.covered = pair_.coverage->covered;
        const bool whole = pair_.coverage->count == pair_.reference.pixels();
        const Image reference = whole ? Image() : withHoles(pair_.reference),
                    test = whole ? Image() : withHoles(pair_.test);
        const ImageRows r = whole ? pair_.reference : reference, t = whole ? pair_.test : test;
        auto result = std::make_shared<HdrFlipResult>();
        if (pair_.display)
            static_cast<FlipResult&>(*result) = ldrFlip(r, t, options);
        else
            *result = hdrFlip(r, t, options);
        flip_ = std::move(result);
    }
    return flip_.get();
}

std::uint64_t Measurement::unseenDifferent() const {
    const auto isLess = [](const ImageRows& image) {
        std::vector<float> buffer;
        for (int y = 0; y < image.height; ++y) {
            const float* p = image.row(y, buffer);
            if (std::any_of(p, p + image.width * image.components, [](float v) { return v < 0; }))
                return true;
        }
        return false;
    };
    if (!flip_ && !isLess(pair_.reference) && !isLess(pair_.test)) return 0;
    return flip() ? flip()->unseen_different : 0;
}

std::shared_ptr<const Image> Measurement::flipErrors() const {
    return flip() ? std::shared_ptr<const Image>(flip_, &flip_->error) : nullptr;
}

std::uint64_t Measurement::pixelsAbove(double max) const {
    const PixelError error(pair_.error_kind, pair_.kind, pair_.reference, *pair_.coverage);
    std::uint64_t count = 0;
    eachPair(pair_.test, pair_.reference, 0, pair_.reference.height,
             [&](std::size_t i, const float* test, const float* reference) {
                 if (pair_.coverage->covered[i]) count += !(error(test, reference) <= max);
             });
    return count;
}

double Measurement::fractionOf(std::uint64_t pixels) const {
    return pair_.coverage->count ? static_cast<double>(pixels) / static_cast<double>(pair_.coverage->count)
                                 : 0;
}

namespace {

// Counts the pixels of the deciding bound: those out of tolerance, or for a metric of the whole channel,
// those that differ.
void countPixels(Criterion& criterion, const Measurement& measurement) {
    if (criterion.above) {
        criterion.pixels = measurement.pixelsAbove(*criterion.above);
    } else if (criterion.metric == "max" || criterion.metric == "p99" || criterion.metric == "p999") {
        criterion.pixels = measurement.pixelsAbove(criterion.limit);
    } else {
        criterion.pixels = measurement.stats().different;
        criterion.differing = true;
    }
    criterion.fraction = measurement.fractionOf(criterion.pixels);
}

}  // namespace

Decision decide(const Rule& rule, const Measurement& measurement) {
    const Measured measured = std::cref(measurement);
    Decision decision = decide(rule, measured);
    if (decision.criterion) countPixels(*decision.criterion, measurement);
    if (decision.level != Level::pass) {
        const Condition& broken = decision.level == Level::fail ? rule.fail : *rule.warn;
        if (auto bound = decidingBound(broken, measured)) {
            countPixels(*bound, measurement);
            decision.reason += fractionText(*bound);
        }
    }
    if (boundsMetric(rule.fail, FAILING)) return decision;
    const auto failAt = [&](std::uint64_t pixels, const char* what) {
        if (pixels == 0) return;
        const std::string why = fmt::format("{} at {}", what, counted(pixels, "pixel"));
        decision.reason = decision.level == Level::fail ? fmt::format("{}; {}", why, decision.reason) : why;
        decision.level = Level::fail;
    };
    failAt(measurement.plain().nonfinite_different, "NaN or infinite values differ");
    if (boundsMetric(rule.fail, "ssim"))
        failAt(measurement.unseenDifferent(), "values that SSIM cannot see (negative) differ");
    return decision;
}

}  // namespace diptych
