// SPDX-License-Identifier: MIT
#include "compare/tradeoff/tables.h"

#include "compare/experiment/pareto.h"
#include "compare/output/writers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace diptych::tradeoff {

using experiment::cellOf;
using experiment::columnOf;
using output::Cell;
using output::Column;
using output::Span;

namespace {

// Measures, and the widths of their columns in a terminal.
using MeasureColumns = std::span<const std::pair<Measure, std::size_t>>;

constexpr std::pair<Measure, std::size_t> sweepMeasures[] = {
    {Measure::ms, 8},     {Measure::ms_min, 8},         {Measure::ms_max, 8},
    {Measure::flip, 8},   {Measure::relative_rmse, 13}, {Measure::relative_p99, 12},
    {Measure::memory, 10}};

// Time, memory and the measures from `first` to `last`.
std::vector<std::pair<Measure, std::size_t>> metrics(Measure first, Measure last) {
    std::vector<std::pair<Measure, std::size_t>> shown{{Measure::ms, 8}, {Measure::memory, 10}};
    for (Measure measure = first; measure <= last; measure = measure + 1) shown.emplace_back(measure, 10);
    return shown;
}

output::Table headOf(MeasureColumns shown) {
    output::Table table{{{"row", Column::number, 4}, {"settings", Column::prose}}};
    for (const auto& [measure, width] : shown) table.columns.push_back(columnOf(measure, width));
    table.sortable = true;
    return table;
}

// `words`: its Settings.
output::Row rowOf(const Tradeoff& tradeoff, std::size_t index, const std::string& words,
                  MeasureColumns shown) {
    const TradeoffRow& row = tradeoff.rows[index];
    const output::Text settings{Span("", Span::swatch, nameOf(row.settings.path)), words};
    output::Row cells{{fmt::format("{}", index + 1), settings}, "", index + 1};
    for (const auto& [measure, width] : shown) cells.cells.push_back(cellOf(row, measure));
    return cells;
}

// A row's Settings with `option`, even at its given value.
std::string settingsText(const Tradeoff& tradeoff, std::size_t row, std::string_view option) {
    const Settings& settings = tradeoff.rows[row].settings;
    std::vector<Change> choices = changesOf(settings, tradeoff.requested);
    const auto named = [&](const Change& choice) { return choice.option == option; };
    if (std::ranges::none_of(choices, named))
        choices.insert(choices.begin() + 1, {std::string(option), settings.valueOf(option)});
    return describe(choices);
}

// Rows on the front of time and each error.
using Fronts = std::array<std::vector<std::size_t>, errorMetrics.size()>;

output::Table sweepHead() {
    output::Table table = headOf(sweepMeasures);
    table.columns.push_back({"front", Column::text, 0, Column::page});
    return table;
}

output::Row sweepRow(const Tradeoff& tradeoff, std::size_t index, const Fronts& fronts) {
    output::Row row =
        rowOf(tradeoff, index, describe(tradeoff.rows[index], tradeoff.requested), sweepMeasures);
    std::vector<std::string_view> on;
    for (std::size_t f = 0; f < errorMetrics.size(); ++f)
        if (std::ranges::count(fronts[f], index) > 0) on.push_back(errorMetrics[f].title);
    row.cells.emplace_back(fmt::format("{}", fmt::join(on, ", ")));
    return row;
}

// Marks rows that are not on the Pareto front of error and cost.
void markBeaten(const Tradeoff& tradeoff, std::vector<ShadowRow>& rows, Measure cost,
                bool ShadowRow::*beaten) {
    std::vector<experiment::TimeError> points;
    for (const ShadowRow& row : rows)
        points.push_back({tradeoff.rows[row.row][cost], tradeoff.rows[row.row][Measure::shadow_error]});
    for (ShadowRow& row : rows) row.*beaten = true;
    for (const std::size_t i : paretoFront(points)) rows[i].*beaten = false;
}

std::string beatenIn(const ShadowRow& row) {
    std::vector<std::string> words;
    if (row.dominated_in_time) words.emplace_back("time");
    if (row.dominated_in_memory) words.emplace_back("memory");
    return fmt::format("{}", fmt::join(words, ", "));
}

std::vector<output::Block> blocksOf(const char* title, const char* explanation, const output::Table& table) {
    if (table.rows.empty()) return {};
    return {output::Heading{2, title}, {output::Paragraph{explanation, "soft"}, output::Block::page}, table};
}

// Columns that a narrow terminal lacks; the first are dropped first.
constexpr std::string_view omittedFirst[] = {"max", "min", errorMetrics[2].title, "memory",
                                             errorMetrics[1].title};
constexpr std::size_t fewestWords = 24;

}  // namespace

output::Table frontTable(const Tradeoff& tradeoff, std::size_t metric) {
    const std::pair<Measure, std::size_t> shown[] = {{Measure::ms, 0}, {errorMeasure(metric), 0}};
    output::Table table = headOf(shown);
    table.sortable = false;
    table.box = "box scroll";
    for (const std::size_t i : frontOf(tradeoff, metric))
        table.rows.push_back(rowOf(tradeoff, i, describe(tradeoff.rows[i], tradeoff.requested), shown));
    return table;
}

output::Table sweepTable(const Tradeoff& tradeoff) {
    output::Table table = sweepHead();
    Fronts fronts;
    for (std::size_t f = 0; f < fronts.size(); ++f) fronts[f] = frontOf(tradeoff, f);
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        table.rows.push_back(sweepRow(tradeoff, i, fronts));
    return table;
}

std::vector<ShadowRow> shadowRowsOf(const Tradeoff& tradeoff) {
    std::vector<ShadowRow> rows;
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        if (tradeoff.rows[i].measured.has(Measure::shadow_error)) rows.push_back({i});
    const auto differs = [&](const ShadowRow& row) {
        for (std::size_t f = 0; f < shadowMetrics.size(); ++f)
            if (tradeoff.rows[row.row][Measure::shadow_error + f] !=
                tradeoff.rows[rows.front().row][Measure::shadow_error + f])
                return true;
        return false;
    };
    if (std::ranges::none_of(rows, differs)) return {};
    std::ranges::stable_sort(
        rows, {}, [&](const ShadowRow& row) { return tradeoff.rows[row.row][Measure::shadow_error]; });
    markBeaten(tradeoff, rows, Measure::ms, &ShadowRow::dominated_in_time);
    markBeaten(tradeoff, rows, Measure::memory, &ShadowRow::dominated_in_memory);
    return rows;
}

std::vector<output::Block> shadowBlocks(const Tradeoff& tradeoff) {
    const auto shown = metrics(Measure::shadow_error, Measure::gap);
    output::Table table = headOf(shown);
    table.columns.push_back({"dominated in", Column::text, 12});
    for (const ShadowRow& row : shadowRowsOf(tradeoff))
        table.rows.emplace_back(rowOf(tradeoff, row.row, settingsText(tradeoff, row.row, "shadows"), shown))
            .cells.emplace_back(beatenIn(row));
    return blocksOf(
        "Sun shadow, compared with traced rays",
        "V: fraction of the sun a pixel sees; R: the same in the reference; E: irradiance of the unshadowed "
        "sun. A pixel within the filter radius plus a texel of a traced edge counts as neither false lit nor "
        "false dark. A row is dominated if another has no more error and takes no more time, or memory.",
        table);
}

std::vector<output::Block> sampleBlocks(const Tradeoff& tradeoff) {
    const auto shown = metrics(Measure::shaded, Measure::differing);
    output::Table table = headOf(shown);
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        if (tradeoff.rows[i].measured.has(Measure::shaded))
            table.rows.push_back(rowOf(tradeoff, i, settingsText(tradeoff, i, "msaa-edges"), shown));
    return blocksOf("Samples that deferred lighting shades",
                    "With multisampling, --msaa-edges selects the samples of a pixel that are shaded "
                    "separately. Exact shades each sample that differs in any G-buffer bit, so its picture "
                    "is that of all samples. The other modes are compared with exact.",
                    table);
}

output::Table csvTable(const Tradeoff& tradeoff) {
    const std::vector<const experiment::Row*> rows = experiment::pointersTo(tradeoff.rows);
    output::Table table;
    // `valueOf`: of a row and its index.
    const auto add = [&](std::string title, const auto& valueOf) {
        std::size_t index = 0;
        addColumn(table, {std::move(title)}, tradeoff.rows,
                  [&](const TradeoffRow& row) { return valueOf(row, index++); });
    };
    const auto addMeasure = [&](std::string title, Measure measure) {
        add(std::move(title), [=](const TradeoffRow& row, auto) { return exactText(row, measure); });
    };
    const auto addCommand = [&](const char* title, const auto& commandOf) {
        add(title, [&](const TradeoffRow& row, auto) { return commandOf(tradeoff, row); });
    };
    add("row", [](const auto&, std::size_t index) { return fmt::format("{}", index + 1); });
    add("path", [](const TradeoffRow& row, auto) { return pathOf(row); });
    addOptions(table, rows, false);
    addMeasure("ms", Measure::ms);
    addMeasure("ms_min", Measure::ms_min);
    addMeasure("ms_max", Measure::ms_max);
    add("runs", [&](const auto&, auto) { return fmt::format("{}", tradeoff.runs); });
    using Part = std::pair<const char*, double CameraRange::*>;
    for (std::size_t f = 0; f < errorMetrics.size(); ++f)
        for (const auto& [end, part] :
             {Part{"", &CameraRange::value}, {"_min", &CameraRange::low}, {"_max", &CameraRange::high}})
            add(fmt::format("{}{}", errorMetrics[f].name, end), [f, of = part](const TradeoffRow& row, auto) {
                return fmt::format("{}", cameraRangeOf(row, errorMeasure(f)).*of);
            });
    for (std::size_t f = 0; f < errorMetrics.size(); ++f)
        add(fmt::format("front_{}", errorMetrics[f].name),
            [front = frontOf(tradeoff, f)](const auto&, std::size_t index) {
                return std::ranges::count(front, index) > 0 ? "1" : "0";
            });
    for (std::size_t f = 0; f < shadowMetrics.size(); ++f)
        addMeasure(fmt::format("shadow_{}", shadowMetrics[f].name), Measure::shadow_error + f);
    for (std::size_t f = 0; f < sampleMetrics.size(); ++f)
        addMeasure(fmt::format("samples_{}", sampleMetrics[f].name), Measure::shaded + f);
    // 0 for another renderer, whose bytes are not known.
    for (const auto& [name, measure] : {std::pair{"image_bytes", Measure::image_bytes},
                                        {"buffer_bytes", Measure::buffer_bytes},
                                        {"gbuffer_bytes_per_pixel", Measure::gbuffer_bytes}})
        add(name, [of = measure](const TradeoffRow& row, auto) { return fmt::format("{}", row.whole(of)); });
    addPasses(table, rows, "ms: ");
    add("warnings",
        [](const TradeoffRow& row, auto) { return fmt::format("{}", fmt::join(row.warnings, "; ")); });
    add("picture", [](const TradeoffRow& row, auto) { return row.image; });
    addCommand("measure", measuringCommand);
    addCommand("render", renderingCommand);
    addCommand("compare", comparingCommand);
    return table;
}

TradeoffTable::TradeoffTable(const Tradeoff& tradeoff, const std::vector<Settings>& rows, std::size_t columns,
                             bool commands)
    : head_(sweepHead()), settings_width_(std::string_view("settings").size()), commands_(commands) {
    for (const Settings& row : rows)
        settings_width_ = std::max(settings_width_, describe(changesOf(row, tradeoff.requested)).size());
    std::size_t width = 0;
    for (const Column& column : head_.columns)
        if (column.kind == Column::number) width += column.width + head_.gap;
    for (const std::string_view title : omittedFirst) {
        if (columns == 0 || width + std::min(settings_width_, fewestWords) <= columns) break;
        Column& column = *std::ranges::find(head_.columns, title, &Column::title);
        column.where = Column::page;
        width -= column.width + head_.gap;
    }
    if (columns > 0)
        settings_width_ =
            std::min(settings_width_, std::max(columns - std::min(columns, width), fewestWords));
}

std::string TradeoffTable::head() const {
    return inText(head_);
}

std::string TradeoffTable::line(const Tradeoff& tradeoff, std::size_t index) const {
    const TradeoffRow& row = tradeoff.rows[index];
    output::Table table = head_;
    table.rows = {sweepRow(tradeoff, index, {})};
    if (const std::string words = describe(row, tradeoff.requested); words.size() > settings_width_)
        table.rows[0].cells[1] = words.substr(0, settings_width_ - 3) + "...";
    std::string line = inText(table, 1);
    if (commands_)
        line += fmt::format("{:>{}}{}\n", "", table.columns[0].width + table.gap,
                            measuringCommand(tradeoff, row));
    return line;
}

}  // namespace diptych::tradeoff
