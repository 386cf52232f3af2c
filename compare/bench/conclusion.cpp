// SPDX-License-Identifier: MIT
#include "compare/bench/conclusion.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace diptych::bench {
namespace {

constexpr double wantedConfidence = 0.95;

// Probability that the median of n lies between the k-th least and the k-th greatest value: 1 - 2
// P(Binomial(n, 1/2) < k).
double confidenceOf(int n, int k) {
    double below = 0;
    // In log space: 2^-n underflows from about a thousand pairs on.
    for (int i = 0; i < k; ++i)
        below += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) -
                          n * std::numbers::ln2);
    return 1 - 2 * below;
}

bool comparable(const BenchRow& a, const BenchRow& b) {
    return a.settings.size == b.settings.size && a.counters.lights == b.counters.lights && a.parts == b.parts;
}

void findPass(Conclusion& c) {
    std::map<std::string, std::pair<double, double>> ms;  // faster, slower row
    for (const PassTime& pass : c.faster->passes) ms[pass.name].first += pass.ms;
    for (const PassTime& pass : c.slower->passes) ms[pass.name].second += pass.ms;
    double most = 0;
    for (const auto& [name, times] : ms) {
        const double saved = times.second - times.first;
        if (saved <= most) continue;
        most = saved;
        c.pass = name;
        c.faster_ms = times.first;
        c.slower_ms = times.second;
    }
}

std::string passMs(double ms) {
    return ms > 0 ? msText(ms) + " ms" : "none";
}

}  // namespace

PairedRatio pairedRatio(const std::vector<double>& slower, const std::vector<double>& faster) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(slower.size(), faster.size()); ++i)
        if (faster[i] > 0) ratios.push_back(slower[i] / faster[i]);
    PairedRatio result;
    result.pairs = static_cast<int>(ratios.size());
    if (ratios.empty()) return result;
    std::ranges::sort(ratios);
    result.median = 0.5 * (ratios[(ratios.size() - 1) / 2] + ratios[ratios.size() / 2]);
    int k = 1;
    while (2 * k < result.pairs && confidenceOf(result.pairs, k + 1) >= wantedConfidence) ++k;
    result.confidence = std::max(0.0, confidenceOf(result.pairs, k));
    result.low = ratios[static_cast<std::size_t>(k) - 1];
    result.high = ratios[ratios.size() - static_cast<std::size_t>(k)];
    return result;
}

std::string Conclusion::inWords() const {
    const Settings &a = faster->settings, &b = slower->settings;
    const auto mode = [this](const Settings& s) {
        return fmt::format("{} ({})", nameOf(s.path), assignLabel(s.assign, faster->parts));
    };
    std::string words = fmt::format(
        "{}x{}, {}: {} takes {} ms, {} takes {:.2f} times as long (median ratio of {}; {:.2f} to {:.2f} at "
        "{:.1f} % confidence)",
        a.size.width, a.size.height, counted(faster->counters.lights, "light"), mode(a),
        msText(faster->time.median), mode(b), ratio.median,
        counted(static_cast<std::uint64_t>(ratio.pairs), "interleaved frame pair"), ratio.low, ratio.high,
        100 * ratio.confidence);
    if (!ratio.isSure()) return words + "; no significant difference, more --runs may help";
    if (!pass.empty())
        words += fmt::format("; the pass that differs most is {}: {} against {}", pass, passMs(faster_ms),
                             passMs(slower_ms));
    return words;
}

std::vector<Conclusion> conclusionsOf(const Bench& bench) {
    // growthInWords() and layersInWords() replace them.
    if (bench.options.table == BenchTable::growth || bench.options.table == BenchTable::layers) return {};
    std::vector<const BenchRow*> left;
    for (const BenchRow& row : bench.rows)
        if (!drawsAnotherPicture(row.settings.assign)) left.push_back(&row);
    std::vector<Conclusion> conclusions;
    while (!left.empty()) {
        std::vector<const BenchRow*> group;
        for (const BenchRow* row : left)
            if (comparable(*row, *left.front())) group.push_back(row);
        std::erase_if(left, [&](const BenchRow* row) { return std::ranges::count(group, row) > 0; });
        std::ranges::stable_sort(group, {}, [](const BenchRow* row) { return row->time.median; });
        if (group.size() < 2) continue;
        const auto other = std::ranges::find_if(
            group, [&](const BenchRow* row) { return row->settings.path != group.front()->settings.path; });
        Conclusion c;
        c.faster = group.front();
        c.slower = other == group.end() ? group[1] : *other;
        c.ratio = pairedRatio(c.slower->ms, c.faster->ms);
        findPass(c);
        conclusions.push_back(std::move(c));
    }
    return conclusions;
}

}  // namespace diptych::bench
