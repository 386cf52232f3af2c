// SPDX-License-Identifier: MIT
// A complete sweep and its outputs.
#pragma once

#include "compare/experiment/row.h"
#include "compare/experiment/sweep.h"
#include "compare/image/channel_image.h"
#include "compare/output/document.h"
#include "compare/verdict/comparison.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::tradeoff {

using experiment::CameraRange;
using experiment::Change;
using experiment::changesOf;
using experiment::describe;
using experiment::errorMetrics;
using experiment::Errors;
using experiment::groupsOf;
using experiment::Measure;
using experiment::SampleFractions;
using experiment::sampleMetrics;
using experiment::ShadowErrors;
using experiment::shadowMetrics;
using experiment::SkipGroup;
using experiment::SweepSkip;

// The measure of an error metric. `metric`: index in errorMetrics.
constexpr Measure errorMeasure(std::size_t metric) {
    return Measure::flip + metric;
}

// One Settings of a sweep, with the first camera. Times of another renderer are those of its whole command,
// so fronts and plots skip its rows.
struct TradeoffRow : experiment::Row {
    double drawing_ms = 0;     // wall-clock time of rendering and timing
    std::string image{};       // file name
    std::string errors_map{};  // file name of the FLIP image
};

// Wall-clock time of this run, ms; excludes rows of an earlier run.
struct SweepCost {
    double whole = 0;      // until the pages are written
    double reading = 0;    // reading and uploading the scene
    double reference = 0;  // rendering the reference
    double drawing = 0;    // rendering and timing rows
    double beyond() const { return whole - reading - reference - drawing; }
};

struct Tradeoff {
    std::string scene;
    std::vector<std::string> cameras;  // as on the command line
    Settings requested, reference;
    ReportDevice device;
    int runs = 0;
    std::vector<TradeoffRow> rows;
    std::vector<SweepSkip> skips;
    std::vector<std::string> notes;
    std::string reference_image;
    std::size_t resumed_rows = 0;  // rows from an earlier run
    SweepCost cost;
};

// A row as text: Settings that differ from the given ones, or the external renderer.
std::string describe(const TradeoffRow& row, const Settings& requested);

// Indices of one path's rows, or of all rows but external ones; frontOf(): those on the Pareto front of
// time and one error.
std::vector<std::size_t> rowsOf(const Tradeoff& tradeoff, std::optional<Path> path);
std::vector<std::size_t> frontOf(const Tradeoff& tradeoff, std::size_t metric, std::optional<Path> path = {});
std::vector<Path> pathsOf(const Tradeoff& tradeoff);  // with rows, in enumeration order

// Time of a row's second timing block over its first: median, least and greatest over the rows. Shows
// drift of the device's speed. Empty with a single block.
std::optional<CameraRange> driftOf(const Tradeoff& tradeoff);

// Shell commands: measures the row again, renders its image, compares its errors with the other path's per
// channel. The last is empty if the row's reference differs from the sweep's, for example in size. It is
// also empty if the other path does not support the Settings. The second is empty for external renderers.
std::string measuringCommand(const Tradeoff& tradeoff, const TradeoffRow& row);
std::string renderingCommand(const Tradeoff& tradeoff, const TradeoffRow& row);
std::string comparingCommand(const Tradeoff& tradeoff, const TradeoffRow& row);

// A line for each error: its front among the rows so far.
std::string frontsText(const Tradeoff& tradeoff);
// Terminal text after the rows: fronts, tables, warnings, skips with reasons, notes, cost.
std::string tradeoffEnd(const Tradeoff& tradeoff);
// index.html: one page without external resources, works from file://.
std::string tradeoffHtml(const Tradeoff& tradeoff);
// Throws std::runtime_error unless tradeoffHtml() may have written the page.
void checkTradeoffHtml(std::string_view page);

nlohmann::ordered_json jsonOf(const TradeoffRow& row);
// Reads the output of jsonOf(). Throws std::runtime_error naming the place of an error.
TradeoffRow tradeoffRowFrom(const nlohmann::ordered_json& json);
// tradeoff.json, schema 1, without the list of files.
nlohmann::ordered_json tradeoffJson(const Tradeoff& tradeoff);

// Writes the folder; images come from `kept`. Returns tradeoff.json.
std::string writeTradeoff(const Tradeoff& tradeoff, const std::filesystem::path& folder,
                          const std::filesystem::path& kept, const Image8& reference, bool force);
inline constexpr const char* tradeoffManifest = "tradeoff.json";

}  // namespace diptych::tradeoff
