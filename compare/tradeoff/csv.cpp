// SPDX-License-Identifier: MIT
#include "compare/output/writers.h"
#include "compare/tradeoff/tradeoff.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::tradeoff {
namespace {

// All digits; infinity is "inf".
std::string digits(double value) {
    return fmt::format("{}", value);
}

std::vector<std::string> passNames(const Tradeoff& tradeoff) {
    std::vector<std::string> names;
    for (const TradeoffRow& row : tradeoff.rows)
        for (const PassTime& pass : row.passes)
            if (std::ranges::count(names, pass.name) == 0) names.push_back(pass.name);
    return names;
}

}  // namespace

std::string tradeoffCsv(const Tradeoff& tradeoff) {
    output::Table table;
    const auto add = [&](std::string_view before, std::string_view title, const auto& valueOf) {
        addColumn(table, {fmt::format("{}{}", before, title)}, tradeoff.rows, valueOf);
    };
    using Row = TradeoffRow;
    const auto placeOf = [&](const Row& row) {
        return static_cast<std::size_t>(&row - tradeoff.rows.data());
    };
    add("", "row", [&](const Row& row) { return fmt::format("{}", placeOf(row) + 1); });
    add("", "path", [](const Row& row) {
        return row.renderer.empty() ? std::string(nameOf(row.settings.path)) : row.renderer;
    });
    // Options that a sweep can vary. The path has its own column.
    for (const Field& field : settingFields())
        if (!field.sweep.empty() && field.option != "path")
            add("", field.option, [&](const Row& row) {
                return ignoredBecause(row.settings, field.option).empty() ? row.settings.valueOf(field.option)
                                                                          : "";
            });
    const auto addMeasure = [&](std::string_view before, std::string_view title, Measure measure) {
        add(before, title,
            [=](const Row& row) { return row.measured.has(measure) ? digits(row[measure]) : std::string(); });
    };
    addMeasure("", "ms", Measure::ms);
    addMeasure("", "ms_min", Measure::ms_min);
    addMeasure("", "ms_max", Measure::ms_max);
    add("", "runs", [&](const Row&) { return fmt::format("{}", tradeoff.runs); });
    using Part = std::pair<const char*, double Spread::*>;
    for (std::size_t f = 0; f < errorFigures.size(); ++f)
        for (const auto& [end, part] :
             {Part{"", &Spread::value}, {"_min", &Spread::low}, {"_max", &Spread::high}})
            add(errorFigures[f].name, end,
                [f, of = part](const Row& row) { return digits(spreadOf(row, errorMeasure(f)).*of); });
    for (std::size_t f = 0; f < errorFigures.size(); ++f)
        add("front_", errorFigures[f].name, [&, front = frontOf(tradeoff, f)](const Row& row) {
            return std::ranges::count(front, placeOf(row)) > 0 ? "1" : "0";
        });
    for (std::size_t f = 0; f < shadowFigures.size(); ++f)
        addMeasure("shadow_", shadowFigures[f].name, Measure::shadow_error + f);
    for (std::size_t f = 0; f < sampleFigures.size(); ++f)
        addMeasure("samples_", sampleFigures[f].name, Measure::shaded + f);
    // 0 for another renderer, whose bytes are not known.
    for (const auto& [name, measure] : {std::pair{"image_bytes", Measure::image_bytes},
                                        {"buffer_bytes", Measure::buffer_bytes},
                                        {"gbuffer_bytes_per_pixel", Measure::gbuffer_bytes}})
        add("", name, [of = measure](const Row& row) { return fmt::format("{}", row.whole(of)); });
    for (const std::string& pass : passNames(tradeoff))
        add("ms: ", pass, [&](const Row& row) {
            const auto found = std::ranges::find(row.passes, pass, &PassTime::name);
            return found == row.passes.end() ? "" : digits(found->ms);
        });
    add("", "warnings", [](const Row& row) { return fmt::format("{}", fmt::join(row.warnings, "; ")); });
    add("", "picture", [](const Row& row) { return row.picture; });
    add("", "measure", [&](const Row& row) { return measuringCommand(tradeoff, row); });
    add("", "render", [&](const Row& row) { return renderingCommand(tradeoff, row); });
    add("", "compare", [&](const Row& row) { return comparingCommand(tradeoff, row); });
    return inCsv(table);
}

}  // namespace diptych::tradeoff
