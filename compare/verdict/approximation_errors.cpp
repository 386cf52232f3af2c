// SPDX-License-Identifier: MIT
#include "compare/verdict/approximation_errors.h"

#include "compare/metrics/channel.h"
#include "compare/metrics/pixel.h"
#include "compare/verdict/rules.h"
#include "compare/verdict/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace diptych {
namespace {

// The name and the setting that removes it, by Approximation.
ApproximationError namedFor(std::size_t approximation, const Settings& settings) {
    switch (static_cast<Approximation>(approximation)) {
        case Approximation::shadow_filter:
            return {"shadow filtering", ""};
        case Approximation::ibl_diffuse:
            return settings.ibl_diffuse == IblDiffuse::map
                       ? ApproximationError{"diffuse IBL", ""}
                       : ApproximationError{"diffuse IBL", "--ibl-diffuse map"};
        case Approximation::ibl_specular:
            return settings.ibl == Ibl::split
                       ? ApproximationError{"split IBL", "--ibl sampled"}
                       : ApproximationError{fmt::format("{} samples of IBL", settings.ibl_samples),
                                            fmt::format("--ibl-samples {}", 2 * settings.ibl_samples)};
        case Approximation::blending:
            return {"blending and glass", ""};
        case Approximation::haze_steps:
            return {"steps through haze", "--haze-march-steps 0"};
    }
    return {};
}

}  // namespace

std::vector<ApproximationError> approximationErrors(const DebugMode& mode, const FramePair& pair) {
    if (!isPathAgainstReference(pair) || pair.coverage.count == 0) return {};
    const Image &baseline = pair.baseline.channels.at(mode.channel),
                &test = pair.test.channels.at(mode.channel);
    const PixelError error(mode.error_kind, mode.kind, baseline, pair.coverage);
    const Allowances allowances(pair);
    std::array<std::vector<double>, approximations> errors;
    for (std::size_t i = 0; i < baseline.pixels(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        const float* const p = baseline.pixel(i);
        const auto allowed = allowances.at(mode, i);
        const double all = std::accumulate(allowed.begin(), allowed.end(), 0.0);
        const double unit = std::max(metrics::largestFinite(p, baseline.components), error.floor());
        const double taken = all > 0 ? std::min(error(test.pixel(i), p), all / unit) / all : 0;
        for (std::size_t a = 0; a < approximations; ++a) errors[a].push_back(allowed[a] * taken);
    }
    std::vector<ApproximationError> all;
    for (std::size_t a = 0; a < approximations; ++a) {
        ApproximationError found = namedFor(a, pair.path().settings);
        found.mean =
            std::accumulate(errors[a].begin(), errors[a].end(), 0.0) / static_cast<double>(errors[a].size());
        if (!(found.mean > 0)) continue;
        found.p999 = nearestRank(std::move(errors[a]), 0.999);
        all.push_back(std::move(found));
    }
    std::ranges::stable_sort(all, std::greater(), &ApproximationError::mean);
    return all;
}

double meanApproximationError(const std::vector<ApproximationError>& errors) {
    return std::accumulate(errors.begin(), errors.end(), 0.0,
                           [](double sum, const ApproximationError& each) { return sum + each.mean; });
}

std::string approximationErrorText(const DebugMode& mode, const std::vector<ApproximationError>& errors) {
    // The JSON also has approximations with less than a tenth of the largest mean.
    std::string text;
    for (const ApproximationError& each : errors) {
        if (each.mean < 0.1 * errors.front().mean) break;
        text += fmt::format("{}{} (p99.9 {}){}", text.empty() ? "" : "; ", each.name, percentText(each.p999),
                            each.setting.empty() ? "" : ": " + each.setting);
    }
    return text.empty() ? text
                        : fmt::format("{} is off by {} in the mean, granted to {}", mode.name,
                                      percentText(meanApproximationError(errors)), text);
}

}  // namespace diptych
