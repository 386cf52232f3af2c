// SPDX-License-Identifier: MIT
#include "compare/verdict/granted.h"

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
Granted namedFor(std::size_t approximation, const Settings& settings) {
    switch (static_cast<Approximation>(approximation)) {
        case Approximation::shadow_filter:
            return {"shadow filtering", ""};
        case Approximation::ibl_diffuse:
            return settings.ibl_diffuse == IblDiffuse::map ? Granted{"diffuse IBL", ""}
                                                           : Granted{"diffuse IBL", "--ibl-diffuse map"};
        case Approximation::ibl_specular:
            return settings.ibl == Ibl::split
                       ? Granted{"split IBL", "--ibl sampled"}
                       : Granted{fmt::format("{} samples of IBL", settings.ibl_samples),
                                 fmt::format("--ibl-samples {}", 2 * settings.ibl_samples)};
        case Approximation::blending:
            return {"blending and glass", ""};
        case Approximation::haze_steps:
            return {"steps through haze", "--haze-march-steps 0"};
    }
    return {};
}

}  // namespace

std::vector<Granted> grantedIn(const DebugMode& mode, const FramePair& pair) {
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
    std::vector<Granted> all;
    for (std::size_t a = 0; a < approximations; ++a) {
        Granted granted = namedFor(a, pair.path().settings);
        granted.mean =
            std::accumulate(errors[a].begin(), errors[a].end(), 0.0) / static_cast<double>(errors[a].size());
        if (!(granted.mean > 0)) continue;
        granted.p999 = nearestRank(std::move(errors[a]), 0.999);
        all.push_back(std::move(granted));
    }
    std::ranges::stable_sort(all, std::greater(), &Granted::mean);
    return all;
}

double grantedMean(const std::vector<Granted>& granted) {
    return std::accumulate(granted.begin(), granted.end(), 0.0,
                           [](double sum, const Granted& each) { return sum + each.mean; });
}

std::string grantedText(const DebugMode& mode, const std::vector<Granted>& granted) {
    // The JSON also has approximations with less than a tenth of the largest grant.
    std::string text;
    for (const Granted& each : granted) {
        if (each.mean < 0.1 * granted.front().mean) break;
        text += fmt::format("{}{} (p99.9 {}){}", text.empty() ? "" : "; ", each.name, percentText(each.p999),
                            each.setting.empty() ? "" : ": " + each.setting);
    }
    return text.empty() ? text
                        : fmt::format("{} is off by {} in the mean, granted to {}", mode.name,
                                      percentText(grantedMean(granted)), text);
}

}  // namespace diptych
