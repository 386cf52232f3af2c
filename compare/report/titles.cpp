// SPDX-License-Identifier: MIT
#include "compare/report/titles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace diptych {
bool hasSeveralPairs(const Report& report) {
    return !report.closer_paths.empty() ||
           std::ranges::any_of(report.frames, [](const Frame& f) { return !f.origin.file.empty(); });
}

std::string pairTitle(const Report& report, const Comparison& comparison) {
    return fmt::format("{} against {}", report.test(comparison).name, report.baseline(comparison).name);
}

std::vector<std::size_t> failingFirst(const Report& report) {
    std::vector<std::size_t> order(report.comparisons.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return report.comparisons[i].passed(); });
    return order;
}

std::vector<const ChannelDiff*> failuresFirst(const Comparison& comparison) {
    std::vector<const ChannelDiff*> channels;
    for (const ChannelDiff& channel : comparison.channels) channels.push_back(&channel);
    const auto rank = [](const ChannelDiff* c) {
        return c->verdict == Verdict::fail ? 0 : c->verdict == Verdict::pass ? 1 : 2;
    };
    std::ranges::stable_sort(channels, {}, rank);
    return channels;
}

std::vector<std::string> notesOf(const Report& report, const Comparison& comparison) {
    std::vector<std::string> notes;
    for (const auto* source :
         {&comparison.notes, &report.baseline(comparison).notes, &report.test(comparison).notes})
        for (const std::string& note : *source)
            if (std::ranges::count(notes, note) == 0) notes.push_back(note);
    return notes;
}

std::string checksLine(const Comparison& comparison) {
    std::uint64_t count = 0;
    std::vector<std::string> features;
    for (const FeatureChecks& feature : comparison.visual_checks) {
        count += feature.found;
        features.push_back(fmt::format("{} {}", feature.feature, feature.found));
    }
    if (count == 0) return {};
    return fmt::format("{} place{} to check by eye: {}", count, count == 1 ? "" : "s",
                       fmt::join(features, ", "));
}

std::string verdictLine(const Report& report) {
    std::size_t compared = 0;
    std::vector<std::string> others;
    std::vector<std::string_view> failed;
    for (const Comparison& comparison : report.comparisons) {
        for (const std::string& failure : comparison.failures)
            if (std::ranges::count(others, failure) == 0) others.push_back(failure);
        for (const ChannelDiff& channel : comparison.channels) {
            compared += channel.verdict != Verdict::forward_only;
            if (channel.verdict == Verdict::fail && std::ranges::count(failed, channel.mode->name) == 0)
                failed.push_back(channel.mode->name);
        }
    }
    const std::string pictures =
        report.comparisons.size() == 1 ? "" : fmt::format(" of {} comparisons", report.comparisons.size());
    if (report.passed())
        return fmt::format("pass: all {} channels{} are within tolerance", compared, pictures);
    if (failed.empty())
        return fmt::format("FAIL: {}{}", others.front(),
                           others.size() > 1 ? fmt::format("; and {} more", others.size() - 1) : "");
    return fmt::format("FAIL: {}{} beyond tolerance", fmt::join(failed, ", "), pictures);
}

}  // namespace diptych
