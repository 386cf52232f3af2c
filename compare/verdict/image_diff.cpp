// SPDX-License-Identifier: MIT
#include "compare/verdict/image_diff.h"

#include "compare/metrics/pixel.h"
#include "compare/metrics/prefilter.h"
#include "compare/run/still_working.h"
#include "compare/verdict/image_pair.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <ranges>
#include <stdexcept>

namespace diptych {
namespace {

// nullptr: no channel of this name with one component.
const Image* planeOf(const std::vector<ImageChannel>& channels, const char* name) {
    const auto found = std::ranges::find(channels, name, &ImageChannel::name);
    return found == channels.end() || found->image.components != 1 ? nullptr : &found->image;
}

constexpr const char* commandLine = "command line";
constexpr const char* byDefault = "default of diff";

// Whether only equal values pass: without a tolerance, or where its metric is undefined.
bool needsEquality(const ImageDiffOptions& options, const ImageChannelDiff& channel) {
    return !options.failing &&
           (!options.tolerance_requested || !(*channel.measurement)({options.metric, 0}).has_value());
}

// The command line's rule for a channel that no rule names.
Rule ruleOf(const ImageDiffOptions& options, const ImageChannelDiff& channel) {
    Rule rule;
    rule.channel = channel.pair.name;
    rule.origin =
        options.metric_requested || options.tolerance_requested || options.failing ? commandLine : byDefault;
    Quantity quantity{options.metric, 0};
    const std::optional<double> value = (*channel.measurement)(quantity);
    const bool defined = options.failing || value;
    if (!defined) {
        rule.because = fmt::format("{} is not defined for this channel", quantity.metric);
        quantity.metric = "max";
    }
    const auto bound = [&](double limit) { return Condition{Condition::Kind::bound, quantity, limit, {}}; };
    const double equal = !isBetterIfMore(quantity.metric) ? 0
                         : quantity.metric == "ssim"      ? 1
                                                          : metrics::infinity;
    rule.fail = bound(needsEquality(options, channel) ? equal : options.tolerance);
    if (options.failing)
        rule.fail = {Condition::Kind::bound, {FAILING, options.tolerance}, *options.failing, {}};
    if (options.warn && defined) rule.warn = bound(*options.warn);
    return rule;
}

// Decides by the values themselves, because metrics round, and some leave pixels out.
void evaluateEquality(ImageChannelDiff& channel, const ImageDiffOptions& options) {
    const std::uint64_t different = channel.measurement->plain().different;
    Decision& decision = channel.decision;
    if (different == 0) {
        decision.level = Level::pass;
        decision.reason.clear();
    } else if (decision.level != Level::fail) {
        decision.level = Level::fail;
        decision.reason =
            fmt::format("{} of {} {}", different, counted(channel.measurement->plain().pixels, "pixel"),
                        different == 1 ? "differs" : "differ");
    }
    if (different > 0 && options.tolerance_requested)
        decision.reason +=
            "; judge it by a rule, by a --metric defined for it, or leave it out with --channels";
}

void evaluate(ImageChannelDiff& channel, const ImageDiffOptions& options) {
    const Rule* rule = ruleFor(options.rules, channel.pair.name);
    channel.rule = rule ? *rule : ruleOf(options, channel);
    channel.decision = decide(channel.rule, *channel.measurement);
    if (!rule && needsEquality(options, channel)) evaluateEquality(channel, options);
}

// Handles a colour that only fails at pixels with an alpha of 0 in both images.
void sayHidden(const ImageDiff& diff, ImageChannelDiff& color) {
    if (color.pair.kind != ChannelKind::color || color.decision.level == Level::pass) return;
    const std::string name = color.pair.name == "lit" ? "A" : color.pair.name + ".A";
    const auto found = std::ranges::find(diff.channels, name, [](const auto& c) { return c->pair.name; });
    if (found == diff.channels.end()) return;
    const ImageRows colors[2] = {color.pair.reference.rows(), color.pair.test.rows()},
                    alphas[2] = {(*found)->pair.reference.rows(), (*found)->pair.test.rows()};
    std::vector<float> buffers[4];
    for (int y = 0; y < diff.height; ++y) {
        const float *a = colors[0].row(y, buffers[0]), *b = colors[1].row(y, buffers[1]),
                    *alpha_a = alphas[0].row(y, buffers[2]), *alpha_b = alphas[1].row(y, buffers[3]);
        for (int x = 0; x < diff.width; ++x)
            if ((alpha_a[x] != 0 || alpha_b[x] != 0) && !std::equal(a + 3 * x, a + 3 * x + 3, b + 3 * x))
                return;
    }
    color.decision.reason +=
        fmt::format("; {} is 0 in both wherever they differ, so the difference is invisible", name);
}

void findWorst(const ImageDiff& diff, ImageChannelDiff& channel) {
    if (channel.measurement->stats().different == 0) return;
    const DecidingErrors deciding = decidingErrors(diff, channel);
    const Image& errors = *deciding.image;
    const auto max = std::max_element(errors.data.begin(), errors.data.end());
    if (!(*max > 0)) return;
    const auto at = static_cast<int>(max - errors.data.begin());
    channel.worst_x = at % errors.width;
    channel.worst_y = at / errors.width;
}

// Notes on what no metric shows: a NaN in both images, what FLIP cannot see, an undefined metric.
void addNotes(ImageDiff& diff, const ImageDiffOptions& options) {
    std::vector<std::string> without;
    for (const auto& channel : diff.channels) {
        const ChannelStats& s = channel->measurement->stats();
        if (s.nonfinite_baseline + s.nonfinite_test > 0)
            diff.notes.push_back(fmt::format("{}: {} of the reference and {} of the test are NaN or infinite",
                                             channel->pair.name, counted(s.nonfinite_baseline, "pixel"),
                                             s.nonfinite_test));
        const bool by_flip =
            std::ranges::any_of(std::array{"flip", "flip_median", "flip_max"},
                                [&](const char* metric) { return boundsMetric(channel->rule.fail, metric); });
        if (const std::uint64_t unseen = by_flip ? channel->measurement->unseenDifferent() : 0; unseen > 0)
            diff.notes.push_back(fmt::format(
                "{}: FLIP cannot see {} that {} (negative, or beyond its exposures): error 1 each",
                channel->pair.name, counted(unseen, "pixel"), unseen == 1 ? "differs" : "differ"));
        if (!channel->rule.because.empty() && isOwnRule(channel->rule)) without.push_back(channel->pair.name);
    }
    if (!without.empty())
        diff.notes.push_back(fmt::format("{} is not defined for {}: only equal values pass", options.metric,
                                         fmt::join(without, ", ")));
}

// The channel with its measurement, after --blur and --shift.
std::unique_ptr<ImageChannelDiff> diffOf(MatchedChannel pair, const ImageDiff& diff,
                                         const ImageDiffOptions& options) {
    auto channel = std::make_unique<ImageChannelDiff>();
    channel->pair = std::move(pair);
    MatchedChannel& p = channel->pair;
    if (p.kind != ChannelKind::id) {
        if (options.blur > 0) {
            p.reference.image = metrics::blurred(p.reference.image, options.blur);
            p.test.image = metrics::blurred(p.test.image, options.blur);
        }
        if (options.shift > 0)
            p.test.image = metrics::shifted(p.reference.image, p.test.image, options.shift);
    }
    channel->display = diff.display && p.kind == ChannelKind::color;
    channel->measurement =
        std::make_unique<Measurement>(ChannelPair{p.error_kind, p.kind, channel->display, p.reference.rows(),
                                                  p.test.rows(), diff.coverage.get(), nullptr, options.flip});
    return channel;
}

void evaluateChannels(ImageDiff& diff, const ImageDiffOptions& options) {
    constexpr double reading = 0.3;
    const auto all = static_cast<double>(diff.channels.size());
    double done = 0;
    for (auto& channel : diff.channels) {
        options.progress.at(reading + (1 - reading) * done++ / all, "measure " + channel->pair.name);
        evaluate(*channel, options);
        findWorst(diff, *channel);
    }
    if (options.metric_requested && options.rules.empty() &&
        std::ranges::none_of(diff.channels, [&](const auto& channel) {
            return (*channel->measurement)({options.metric, 0}).has_value();
        })) {
        std::vector<std::string> names;
        for (const auto& channel : diff.channels) names.push_back(channel->pair.name);
        throw std::runtime_error(fmt::format("--metric {}: not defined for any channel of these images: {}",
                                             options.metric, fmt::join(names, ", ")));
    }
    for (auto& channel : diff.channels) sayHidden(diff, *channel);
}

void checkBlackness(ImageDiff& diff, const ImageDiffOptions& options) {
    const bool black = std::ranges::all_of(diff.channels, [&](const auto& channel) {
        return isBlack(channel->pair.reference.rows(), *diff.coverage) &&
               isBlack(channel->pair.test.rows(), *diff.coverage);
    });
    if (!black || options.allow_empty) return;
    constexpr const char* blackness = "both images are black: every compared value is 0";
    if (options.strict)
        diff.failures.push_back(fmt::format("{}; --allow-empty accepts that", blackness));
    else
        diff.emptiness = blackness;
}

}  // namespace

std::string metricOfOption(const std::string& name) {
    static const std::map<std::string, std::string> others{{"relative", "relative_max"},
                                                           {"angular", "angle_max"},
                                                           {"angle", "angle_max"},
                                                           {"ulp", "ulp_max"},
                                                           {"relmse", "relative_mse"}};
    if (const auto other = others.find(name); other != others.end()) return other->second;
    if (findMetric(name)) return name;
    throw std::runtime_error(
        fmt::format("--metric {}: unknown metric; use one of relative, angular, ulp, {}", name,
                    fmt::join(allMetrics() | std::views::transform(&Metric::name), ", ")));
}

DecidingErrors decidingErrors(const ImageDiff& diff, const ImageChannelDiff& channel) {
    const MatchedChannel& pair = channel.pair;
    const auto decides = [&](const char* metric) {
        return std::ranges::any_of(allMetrics(), [&](const Metric& f) {
            return f.name.starts_with(metric) && boundsMetric(channel.rule.fail, f.name);
        });
    };
    if (decides("flip"))
        if (auto errors = channel.measurement->flipErrors()) return {std::move(errors), "FLIP", 1};
    const bool relative = decides("relative") && pair.error_kind == ErrorKind::absolute;
    const ErrorKind errorKind = relative ? ErrorKind::relative : pair.error_kind;
    auto errors = std::make_shared<Image>(
        errorImage(errorKind, pair.kind, pair.reference.rows(), pair.test.rows(), *diff.coverage));
    if (!relative) return {std::move(errors), "", channel.measurement->stats().max};
    const double top = channel.measurement->plain().relative_max;
    return {std::move(errors), "relative", top};
}

bool isOwnRule(const Rule& rule) {
    return rule.origin == commandLine || rule.origin == byDefault;
}

bool ImageDiff::passed() const {
    return failures.empty() &&
           std::ranges::none_of(channels, [](const auto& c) { return c->decision.level == Level::fail; });
}

ImageDiff diffImages(const std::string& reference, const std::string& test, const ImageDiffOptions& options) {
    ImageDiff diff;
    diff.reference = reference;
    diff.test = test;
    std::optional<StillWorking> working(std::in_place, options.progress, "read");
    auto [a, b, compared, notes, failures] = readPair(reference, test, options);
    working.reset();
    const Claim claims[] = {a.claim, b.claim};  // of images that are moved below
    diff.reference_format = a.format;
    diff.test_format = b.format;
    diff.width = a.width;
    diff.height = a.height;
    diff.display = a.display_referred;
    diff.notes = std::move(notes);
    diff.failures = std::move(failures);

    checkNames(a, b, options.names);
    std::vector<ImageChannel> left = channelsOf(std::move(a), options.names),
                              right = channelsOf(std::move(b), options.names);
    diff.coverage = std::make_unique<Coverage>(
        everyPixel(static_cast<std::size_t>(diff.width) * static_cast<std::size_t>(diff.height)));
    applySelection(*diff.coverage, diff.width, diff.height, options.selection,
                   {{planeOf(left, "material_id"), planeOf(right, "material_id")},
                    {planeOf(left, "depth"), planeOf(right, "depth")}},
                   diff.notes);
    std::vector<std::string> names;
    for (const auto* side : {&left, &right})
        for (const ImageChannel& channel : *side) names.push_back(channel.name);
    MatchedChannels matched = matchChannels(std::move(left), std::move(right), options.channels);
    diff.notes.insert(diff.notes.end(), matched.notes.begin(), matched.notes.end());
    for (const OneSidedChannel& channel : matched.one_sided)
        evaluateOneSided(channel.name, channel.owner, {options.rules, options.channels, options.strict},
                         diff.failures, diff.notes);
    for (MatchedChannel& pair : matched.channels)
        diff.channels.push_back(diffOf(std::move(pair), diff, options));
    evaluateChannels(diff, options);
    addNotes(diff, options);
    // A rule that names no channel by its whole name fails, because its author expects a match; a pattern
    // may match nothing.
    for (const Rule* rule : idleRules(options.rules, names))
        (isPattern(*rule) ? diff.notes : diff.failures).push_back(idleText(*rule, names));
    checkBlackness(diff, options);
    return diff;
}

}  // namespace diptych
