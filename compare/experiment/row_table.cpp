// SPDX-License-Identifier: MIT
// Rows as tables.
#include "compare/experiment/row.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::experiment {
namespace {

std::string roundedText(const NamedMeasure& measure, double value) {
    if (measure.unit == "bytes" && value >= 0) return page::bytes(static_cast<std::uint64_t>(value));
    if (measure.isWhole()) return fmt::format("{:.0f}", value);
    return measure.unit == "ms" ? fmt::format("{:.4g}", value) : page::number(value);
}

}  // namespace

output::Cell cellOf(const Row& row, Measure measure) {
    if (!row.measured.has(measure)) return "";
    return output::sorted(row[measure], roundedText(named(measure), row[measure]));
}

output::Column columnOf(Measure measure, std::size_t width) {
    const NamedMeasure& of = named(measure);
    return {std::string(of.title), output::Column::number, width, output::Column::everywhere, "",
            std::string(of.means)};
}

std::string exactText(const Row& row, Measure measure) {
    if (!row.measured.has(measure)) return "";
    return named(measure).isWhole() ? fmt::format("{:.0f}", row[measure]) : fmt::format("{}", row[measure]);
}

std::string pathOf(const Row& row) {
    return row.renderer.empty() ? std::string(nameOf(row.settings.path)) : row.renderer;
}

void addOptions(output::Table& table, std::span<const Row* const> rows, bool differing) {
    for (const Field& field : settingFields()) {
        if (field.sweep.empty() || field.option == "path") continue;
        const auto valueOf = [&](const Row* row) {
            return ignoredBecause(row->settings, field.option).empty() ? row->settings.valueOf(field.option)
                                                                       : "";
        };
        if (!differing ||
            std::ranges::any_of(rows, [&](const Row* row) { return valueOf(row) != valueOf(rows.front()); }))
            addColumn(table, {std::string(field.option)}, rows, valueOf);
    }
}

void addPasses(output::Table& table, std::span<const Row* const> rows, std::string_view before,
               std::string_view after) {
    std::vector<std::string> passes;
    for (const Row* row : rows)
        for (const PassTime& pass : row->passes)
            if (std::ranges::count(passes, pass.name) == 0) passes.push_back(pass.name);
    for (const std::string& pass : passes)
        addColumn(table, {fmt::format("{}{}{}", before, pass, after)}, rows, [&](const Row* row) {
            const auto found = std::ranges::find(row->passes, pass, &PassTime::name);
            return found == row->passes.end() ? "" : fmt::format("{}", found->ms);
        });
}

output::Table rowsTable(std::span<const Row* const> rows) {
    output::Table table;
    const auto text = [&](std::string title, const auto& valueOf) {
        addColumn(table, {std::move(title)}, rows, [&](const Row* row) { return valueOf(*row); });
    };
    const auto any = [&](const auto& has) {
        return std::ranges::any_of(rows, [&](const Row* row) { return has(*row); });
    };
    std::size_t number = 0;
    text("row", [&](const Row&) { return fmt::format("{}", ++number); });
    text("scene", [](const Row& row) { return row.scene; });
    if (any([](const Row& row) { return !row.varied.empty(); }))
        text("varied", [](const Row& row) { return row.varied; });
    text("camera", [](const Row& row) { return row.camera; });
    text("path", pathOf);
    addOptions(table, rows, true);
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const auto measure = static_cast<Measure>(i);
        const NamedMeasure& of = measures[i];
        if (!any([&](const Row& row) { return row.measured.has(measure); })) continue;
        const std::string unit = of.unit.empty() ? "" : fmt::format(" [{}]", of.unit);
        addColumn(table,
                  {fmt::format("{}.{}{}", of.group, of.name, unit), output::Column::number, 0,
                   output::Column::everywhere, "", std::string(of.means)},
                  rows, [&](const Row* row) { return exactText(*row, measure); });
    }
    addPasses(table, rows, "pass ", " [ms]");
    text("judgement", [](const Row& row) { return row.judgement; });
    text("failed", [](const Row& row) { return row.failed; });
    text("warnings", [](const Row& row) { return fmt::format("{}", fmt::join(row.warnings, "; ")); });
    return table;
}

}  // namespace diptych::experiment
