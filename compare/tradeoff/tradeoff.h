// SPDX-License-Identifier: MIT
// A whole sweep, and the files and texts made of it.
#pragma once

#include "compare/picture/picture.h"
#include "compare/tradeoff/row.h"
#include "compare/tradeoff/sweep.h"
#include "compare/verdict/comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::tradeoff {

// Wall-clock time of this run of the command, ms; rows kept from an earlier run are not included.
struct SweepCost {
    double whole = 0;      // until the pages are written
    double reading = 0;    // the scene: read and upload
    double reference = 0;  // drawing the reference
    double drawing = 0;    // drawing and timing rows
    double beyond() const { return whole - reading - reference - drawing; }
};

struct Tradeoff {
    std::string scene;
    std::vector<std::string> cameras;  // as asked for
    Settings given, reference;
    ReportDevice device;
    int runs = 0;
    std::vector<TradeoffRow> rows;
    std::vector<SweepSkip> skips;
    std::vector<std::string> notes;
    std::string reference_picture;
    std::size_t kept = 0;  // rows that an earlier run measured
    SweepCost cost;
};

// What a row is, in words: its Settings that differ from the given ones, or another renderer.
std::string inWords(const TradeoffRow& row, const Settings& given);

// Indices of the rows of one path, or of all but those of other renderers; and of those on the Pareto front
// of time and one error.
std::vector<std::size_t> rowsOf(const Tradeoff& tradeoff, std::optional<Path> path);
std::vector<std::size_t> frontOf(const Tradeoff& tradeoff, std::size_t figure, std::optional<Path> path = {});
std::vector<Path> pathsOf(const Tradeoff& tradeoff);  // that have rows, in the enumeration's order

// The time of a row's second visit divided by that of its first: median, least and greatest over the rows.
// Shows how the device's speed changed during the sweep. Empty if rows were visited once.
std::optional<Spread> driftOf(const Tradeoff& tradeoff);

// Commands for a shell. The first measures the row again by itself, the second draws its picture, the third
// compares its errors with the other path's, channel by channel. The third is empty if the row's reference
// would differ from the sweep's, e.g. by its size, or if the other path cannot draw the Settings. Of another
// renderer the second is empty.
std::string measuringCommand(const Tradeoff& tradeoff, const TradeoffRow& row);
std::string renderingCommand(const Tradeoff& tradeoff, const TradeoffRow& row);
std::string comparingCommand(const Tradeoff& tradeoff, const TradeoffRow& row);

// The table on a terminal, which grows a line at a time, each no wider than `columns` where that holds a
// row's number, its time, its FLIP and some words: of the other numbers those that find room, and the
// Settings cut short where they do not ("..."). 0: as wide as it takes. `commands`: under each row what
// measures it again.
class TradeoffTable {
public:
    TradeoffTable(const Tradeoff& tradeoff, const std::vector<Settings>& rows, std::size_t columns,
                  bool commands);
    std::string head() const;
    std::string line(const Tradeoff& tradeoff, std::size_t row) const;

private:
    std::string joined(const std::vector<std::string>& cells, const std::string& words) const;

    std::size_t words_ = 0;           // of the Settings
    std::vector<std::size_t> shown_;  // numbers, in order
    bool commands_;
};
// Skips with their reasons, the front, notes, cost.
std::string tradeoffEnd(const Tradeoff& tradeoff);
// Sentences on how the speed of the device changed during the sweep, and what the sweep cost besides drawing.
std::vector<std::string> howItWent(const Tradeoff& tradeoff);

// RFC 4180, a line a row.
std::string tradeoffCsv(const Tradeoff& tradeoff);
// tradeoff.json, schema 1; `files`: all of the folder.
std::string tradeoffJson(const Tradeoff& tradeoff, const std::vector<std::string>& files);

// Writes the folder; pictures are read from `kept`. Returns tradeoff.json.
std::string writeTradeoff(const Tradeoff& tradeoff, const std::filesystem::path& folder,
                          const std::filesystem::path& kept, const Image8& reference, bool force);
inline constexpr const char* tradeoffManifest = "tradeoff.json";

}  // namespace diptych::tradeoff
