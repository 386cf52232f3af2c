// SPDX-License-Identifier: MIT
#include "compare/cli/scene_comparison.h"

#include "compare/cli/commands.h"
#include "compare/render/reference_frame.h"
#include "compare/verdict/baseline.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych::cli {
namespace {

bool againstReference(const Options& options) {
    return comparedOf(options).withReference();
}

}  // namespace

experiment::Compared comparedOf(const Options& options) {
    return {options.baseline, !options.baseline_file.empty(), options.renderers, options.renderer_words};
}

bool isTraced(const std::vector<Settings>& settings, const std::optional<Frame>& baseline) {
    const auto traced = [](const Settings& s) {
        return isReference(s.path) && s.reference_mode == ReferenceMode::scene;
    };
    return std::ranges::any_of(settings, traced) ||
           (baseline && isReferenceFrame(*baseline) && traced(baseline->settings));
}

void checkSamples(const Options& options, const std::vector<Settings>& settings,
                  const std::optional<Frame>& baseline) {
    std::optional<Settings> reference;
    if (againstReference(options)) reference = referenceSettings(options.settings);
    if (baseline && isReferenceFrame(*baseline)) reference = baseline->settings;
    if (!reference) return;
    for (const Settings& s : settings) {
        if (isReference(s.path) || s.msaa == 1) continue;
        if (const std::string problem = samplesProblem(*reference, s); !problem.empty())
            throw std::runtime_error(problem);
        if (!options.channels.empty() && std::ranges::count(options.channels, Channel::lit) == 0)
            throw std::runtime_error(fmt::format(
                "--msaa {}: only lit is compared with the reference; add it to --channels", s.msaa));
    }
}

void checkAgainstDevice(const Options& options, const std::vector<Settings>& settings) {
    if (options.against_device.empty()) return;
    const auto refuse = [&](const std::string& why) {
        throw std::runtime_error(fmt::format("--against-device {}: {}", options.against_device, why));
    };
    if (againstReference(options) || !options.baseline_file.empty())
        refuse(
            "compares each path with itself on another device; leave out --baseline reference or FILE.exr");
    if (options.pixel) refuse("compares whole images; leave out --pixel");
    if (!options.renderers.empty()) refuse("compares two devices; leave out --renderer");
    for (const Settings& of : settings)
        if (of.msaa > 1)
            refuse(
                fmt::format("--msaa {}: lit averages several samples, but the surface channels hold only the "
                            "first; use --msaa 1",
                            of.msaa));
}

ExplanationQuestion explanationOf(const Options& options) {
    return {options.explain, options.settings, options.sides, renderOptions(options), options.picture};
}

}  // namespace diptych::cli
