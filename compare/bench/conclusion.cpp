// SPDX-License-Identifier: MIT
#include "compare/bench/findings.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::bench {
namespace {

bool comparable(const BenchRow& a, const BenchRow& b) {
    return a.settings.size == b.settings.size && a.whole(Measure::lights) == b.whole(Measure::lights) &&
           a.parts == b.parts;
}

void findPass(Conclusion& c) {
    std::map<std::string, std::pair<double, double>> ms;  // faster, slower row
    for (const PassTime& pass : c.faster->passes) ms[pass.name].first += pass.ms;
    for (const PassTime& pass : c.slower->passes) ms[pass.name].second += pass.ms;
    double max = 0;
    for (const auto& [name, times] : ms) {
        const double saved = times.second - times.first;
        if (saved <= max) continue;
        max = saved;
        c.pass = name;
        c.faster_ms = times.first;
        c.slower_ms = times.second;
    }
}

std::string timeText(double ms) {
    return ms > 0 ? msText(ms) + " ms" : "none";
}

}  // namespace

std::string Conclusion::describe() const {
    const auto mode = [](const BenchRow& row) {
        return fmt::format("{} ({})", nameOf(row.settings.path), row.assignLabel());
    };
    std::string text = fmt::format(
        "{}x{}, {}: {} takes {} ms, {} takes {:.2f} times as long (median ratio of {}; {:.2f} to {:.2f} at "
        "{:.1f} % confidence)",
        faster->settings.size.width, faster->settings.size.height, faster->lightsText(), mode(*faster),
        msText((*faster)[Measure::ms]), mode(*slower), ratio.ratio,
        counted(static_cast<std::uint64_t>(ratio.pairs), "interleaved frame pair"), ratio.low, ratio.high,
        100 * ratio.confidence);
    if (!ratio.isSure()) return text + "; no significant difference, more --runs may help";
    if (!pass.empty())
        text += fmt::format("; the pass that differs most is {}: {} against {}", pass, timeText(faster_ms),
                            timeText(slower_ms));
    return text;
}

std::vector<Conclusion> conclusionsOf(const Bench& bench) {
    // growthText() and layersText() replace them.
    if (bench.options.table == BenchTable::growth || bench.options.table == BenchTable::layers) return {};
    std::vector<const BenchRow*> left;
    for (const BenchRow& row : bench.rows)
        if (!drawsAnotherImage(row.settings.assign)) left.push_back(&row);
    std::vector<Conclusion> conclusions;
    while (!left.empty()) {
        std::vector<const BenchRow*> group;
        for (const BenchRow* row : left)
            if (comparable(*row, *left.front())) group.push_back(row);
        std::erase_if(left, [&](const BenchRow* row) { return std::ranges::count(group, row) > 0; });
        std::ranges::stable_sort(group, {}, [](const BenchRow* row) { return (*row)[Measure::ms]; });
        if (group.size() < 2) continue;
        const auto other = std::ranges::find_if(
            group, [&](const BenchRow* row) { return row->settings.path != group.front()->settings.path; });
        Conclusion c;
        c.faster = group.front();
        c.slower = other == group.end() ? group[1] : *other;
        c.ratio = experiment::pairedRatio(c.slower->ms, c.faster->ms);
        findPass(c);
        conclusions.push_back(std::move(c));
    }
    return conclusions;
}

}  // namespace diptych::bench
