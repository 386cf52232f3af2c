// SPDX-License-Identifier: MIT
#include "compare/bench/findings.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::bench {
namespace {

std::size_t wayOf(const Settings& settings) {
    const auto way = std::ranges::find_if(layerWays, [&](const LayerWay& w) {
        return w.path() == settings.path && (!w.has_gbuffer || w.layers == settings.layers);
    });
    return static_cast<std::size_t>(way - layerWays.begin());
}

// Finds the fastest ways.
void compareWays(LayerRow& row) {
    const BenchRow* min = nullptr;
    std::size_t timed = 0;
    for (const BenchRow* const way : row.ways) {
        if (way == nullptr) continue;
        ++timed;
        if (min == nullptr || (*way)[Measure::ms] < (*min)[Measure::ms]) min = way;
    }
    if (timed < 2) return;
    for (std::size_t i = 0; i < row.ways.size(); ++i) {
        if (row.ways[i] == nullptr) continue;
        const experiment::TimeRatio ratio = experiment::pairedRatio(row.ways[i]->ms, min->ms);
        if (row.ways[i] == min || !ratio.isSure() || ratio.low < 1)
            row.fastest.push_back(i);
        else
            row.lead = row.lead == 0 ? ratio.ratio : std::min(row.lead, ratio.ratio);
    }
}

std::string lightsText(const std::vector<std::uint64_t>& counts) {
    return counts.size() == 1 ? counted(counts.front(), "light")
                              : fmt::format("{} lights", fmt::join(counts, ", "));
}

// All combinations of the lists.
struct Conditions {
    std::vector<std::string_view> kinds;
    std::vector<int> percents;
    std::vector<std::uint64_t> lights;
    bool operator==(const Conditions&) const = default;
};

// Joins conditions that differ in one list alone.
template <class T>
void joinBy(std::vector<T> Conditions::*list, std::vector<Conditions>& all) {
    std::vector<Conditions> joined;
    for (const Conditions& one : all) {
        const auto known = std::ranges::find_if(joined, [&](Conditions other) {
            other.*list = one.*list;
            return other == one;
        });
        if (known != joined.end())
            ((*known).*list).push_back((one.*list).front());
        else
            joined.push_back(one);
    }
    all = std::move(joined);
}

// "5, 25 % coated, woven under 1, 64 lights; no layers under 1 light"
std::string conditionsText(const std::vector<const LayerRow*>& rows) {
    std::vector<Conditions> all;
    for (const LayerRow* const row : rows)
        all.push_back({{row->cover.kind}, {row->cover.percent}, {row->lights}});
    joinBy(&Conditions::percents, all);
    joinBy(&Conditions::lights, all);
    joinBy(&Conditions::kinds, all);
    std::vector<std::string> words;
    for (const Conditions& c : all)
        words.push_back(
            fmt::format("{} under {}",
                        c.kinds.front().empty()
                            ? coverName({})
                            : fmt::format("{} % {}", fmt::join(c.percents, ", "), fmt::join(c.kinds, ", ")),
                        lightsText(c.lights)));
    return fmt::format("{}", fmt::join(words, "; "));
}

// Where these ways are the fastest; `all`: number of the table's rows.
std::string outcomeText(const std::vector<const LayerRow*>& rows, std::size_t all) {
    const std::vector<std::string> fastest = rows.front()->fastestNames();
    std::string subject = "no significant difference between the ways", detail;
    if (fastest.size() == 1) {
        const LayerRow& max = **std::ranges::max_element(rows, {}, &LayerRow::lead);
        subject = fastest.front() + " is the fastest";
        detail = fmt::format(" (the next takes up to {:.2f} times as long: {}, {})", max.lead,
                             coverName(max.cover), counted(max.lights, "light"));
    } else if (fastest.size() < layerWays.size()) {
        subject = fmt::format("{} are the fastest, without a significant difference between them,",
                              fmt::join(fastest, " and "));
    }
    return fmt::format("{} in {} of {}{}: {}", subject, rows.size(), counted(all, "row"), detail,
                       conditionsText(rows));
}

std::string rangeText(const std::vector<std::uint64_t>& values) {
    const auto [min, max] = std::ranges::minmax(values);
    return min == max ? fmt::format("{}", min) : fmt::format("{} to {}", min, max);
}

std::string registersText(const BenchRow& row) {
    std::vector<std::string> words;
    for (const PassRegisters& pass : row.registers)
        words.push_back(
            rangeText({static_cast<std::uint64_t>(pass.min), static_cast<std::uint64_t>(pass.max)}));
    return words.empty() ? "-" : fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace

std::string LayerWay::name() const {
    const std::string_view path_name = nameOf(path());
    return has_gbuffer
               ? fmt::format("{} by {}", path_name, layers == Layers::gbuffer ? "G-buffer" : "forward")
               : std::string(path_name);
}

std::vector<std::string> LayerRow::fastestNames() const {
    std::vector<std::string> names;
    for (const std::size_t way : fastest) names.push_back(layerWays.at(way).name());
    return names;
}

std::uint64_t imageBytesPerPixel(const BenchRow& row) {
    const Size& size = row.settings.size;
    return row.whole(Measure::full_size_bytes) /
           (static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height));
}

std::vector<LayerRow> layerRows(const Bench& bench) {
    std::vector<LayerRow> rows;
    for (const BenchRow& row : bench.rows) {
        if (!row.cover) continue;
        const std::uint64_t lights = row.requested_lights.value();
        if (rows.empty() || rows.back().cover != *row.cover || rows.back().lights != lights)
            rows.push_back({*row.cover, lights});
        rows.back().ways.at(wayOf(row.settings)) = &row;
    }
    std::ranges::for_each(rows, compareWays);
    return rows;
}

std::vector<std::string> layersText(const Bench& bench) {
    const std::vector<LayerRow> rows = layerRows(bench);
    // Single ways first.
    std::map<std::pair<std::size_t, std::vector<std::size_t>>, std::vector<const LayerRow*>> outcomes;
    for (const LayerRow& row : rows)
        if (!row.fastest.empty()) outcomes[{row.fastest.size(), row.fastest}].push_back(&row);
    std::vector<std::string> words;
    for (const auto& [fastest, where] : outcomes) words.push_back(outcomeText(where, rows.size()));
    for (std::size_t way = 0; way < layerWays.size(); ++way) {
        std::vector<std::uint64_t> stored, all;
        for (const LayerRow& row : rows)
            if (const BenchRow* const timed = row.ways.at(way)) {
                stored.push_back(timed->whole(Measure::gbuffer_bytes));
                all.push_back(imageBytesPerPixel(*timed));
            }
        if (!stored.empty())
            words.push_back(fmt::format("{} stores {} bytes per pixel of {}; all its images {}",
                                        layerWays.at(way).name(), rangeText(stored),
                                        layerWays.at(way).has_gbuffer ? "G-buffer and depth" : "depth",
                                        rangeText(all)));
    }
    return words;
}

std::vector<output::Block> layerBlocks(const Bench& bench) {
    using output::Column;
    const std::vector<LayerRow> rows = layerRows(bench);
    if (rows.empty()) return {};
    output::Table table{.columns = {}, .style = "", .groups = {{"", 3}}};
    addColumn(table, {"covered"}, rows, [](const LayerRow& row) { return coverName(row.cover); });
    addColumn(table, {"lights", Column::number}, rows,
              [](const LayerRow& row) { return fmt::format("{}", row.lights); });
    addColumn(table, {"fastest"}, rows, [](const LayerRow& row) {
        return row.fastest.empty() ? "-"
               : row.fastest.size() == layerWays.size()
                   ? "no significant difference"
                   : fmt::format("{}", fmt::join(row.fastestNames(), " or "));
    });
    const bool registers = !bench.compiler.empty();
    for (std::size_t way = 0; way < layerWays.size(); ++way) {
        const auto add = [&](const char* title, const auto& textOf) {
            addColumn(table, {title, Column::number}, rows, [&](const LayerRow& row) {
                return row.ways[way] != nullptr ? textOf(*row.ways[way]) : "-";
            });
        };
        table.groups.emplace_back(layerWays[way].name(), registers ? 4 : 3);
        add("ms (min to max)", describeTime);
        add("B/pixel",
            [](const BenchRow& row) { return fmt::format("{}", row.whole(Measure::gbuffer_bytes)); });
        add("all B/pixel", [](const BenchRow& row) { return fmt::format("{}", imageBytesPerPixel(row)); });
        if (registers) add("VGPRs", registersText);
    }
    std::string means =
        "B/pixel: of G-buffer and depth, and of all images of the picture's size; fastest: by a sign test of "
        "frames of the same round";
    if (registers)
        means +=
            "; VGPRs: vector registers per lane of the pipelines that shade, pass after pass, by the "
            "compiler of " +
            bench.compiler;
    const std::vector<std::string> words = layersText(bench);
    return {output::Heading{2, "Where each way is the fastest"},
            output::List{{words.begin(), words.end()}, "box says"}, table,
            output::Paragraph{means, "soft small"}};
}

}  // namespace diptych::bench
