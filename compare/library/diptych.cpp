// SPDX-License-Identifier: MIT
#include "compare/library/diptych.h"

#include "compare/metrics/channel.h"
#include "compare/verdict/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych::library {
namespace {

Image imageOf(const Picture& picture, const char* which) {
    if (picture.width < 1 || picture.height < 1 ||
        picture.rgb.size() !=
            3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height))
        throw std::runtime_error(fmt::format("the {} is {}x{} and has {} values; give 3 per pixel", which,
                                             picture.width, picture.height, picture.rgb.size()));
    Image image(picture.width, picture.height, 3);
    std::ranges::copy(picture.rgb, image.data.begin());
    return image;
}

Coverage coverageOf(const Options& options, std::size_t pixels) {
    Coverage coverage = everyPixel(pixels);
    if (options.covered.empty()) return coverage;
    if (options.covered.size() != pixels)
        throw std::runtime_error(
            fmt::format("Options::covered has {} values for {} pixels; give one per pixel",
                        options.covered.size(), pixels));
    for (std::size_t i = 0; i < pixels; ++i) coverage.covered[i] = options.covered[i] != 0;
    coverage.count =
        static_cast<std::size_t>(std::ranges::count_if(coverage.covered, [](auto c) { return c; }));
    return coverage;
}

}  // namespace

Result compare(const Picture& reference, const Picture& test, const Options& options) {
    const Image a = imageOf(reference, "reference"), b = imageOf(test, "test");
    if (a.width != b.width || a.height != b.height)
        throw std::runtime_error(
            fmt::format("the reference is {}x{} and the test is {}x{}: images must have the same size",
                        a.width, a.height, b.width, b.height));
    const Coverage coverage = coverageOf(options, a.pixels());
    if (coverage.count == 0) throw std::runtime_error("no pixel counts: Options::covered is 0 everywhere");
    HdrFlipOptions flip;
    flip.pixels_per_degree = options.pixels_per_degree;
    const Measurement measurement({.error_kind = ErrorKind::absolute,
                                   .kind = ChannelKind::color,
                                   .display = options.display,
                                   .reference = a,
                                   .test = b,
                                   .coverage = &coverage,
                                   .flip = flip});
    Result result;
    result.compared = coverage.count;
    for (const auto& [name, value] : measurement.all()) result.figures.emplace(name, value);
    for (const Limit& limit : options.limits) {
        const Metric* const metric = findMetric(limit.figure);
        if (!metric)
            throw std::runtime_error(
                fmt::format("{}: unknown metric; figureNames() lists them", limit.figure));
        const auto measured = result.figures.find(limit.figure);
        if (measured == result.figures.end())
            throw std::runtime_error(fmt::format("{}: is not defined for colours", limit.figure));
        // The same rule as in a tolerance file.
        Rule rule;
        rule.fail = {Condition::Kind::bound, {limit.figure, 0}, limit.value, {}};
        const bool holds = decide(rule, measurement).level != Level::fail;
        result.outcomes.push_back({limit, measured->second, holds});
        result.passed = result.passed && holds;
    }
    result.passed = result.passed && measurement.plain().nonfinite_different == 0;
    const Image& error = measurement.flip()->error;
    result.flip.assign(error.data.begin(), error.data.end());
    float max = 0;
    for (std::size_t i = 0; i < result.flip.size(); ++i)
        if (coverage.covered[i] && result.flip[i] > max) {
            max = result.flip[i];
            result.worst_x = static_cast<int>(i % static_cast<std::size_t>(a.width));
            result.worst_y = static_cast<int>(i / static_cast<std::size_t>(a.width));
        }
    return result;
}

std::vector<std::string> figureNames() {
    std::vector<std::string> names;
    for (const Metric& metric : allMetrics()) names.emplace_back(metric.name);
    return names;
}

std::string meaningOf(const std::string& name) {
    const Metric* const metric = findMetric(name);
    return metric ? std::string(metric->meaning) : "";
}

std::string version() {
    return DIPTYCH_VERSION;
}

}  // namespace diptych::library
