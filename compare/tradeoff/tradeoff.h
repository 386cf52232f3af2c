// SPDX-License-Identifier: MIT
// A whole sweep, and what is made of it.
#pragma once

#include "compare/picture/picture.h"
#include "compare/tradeoff/row.h"
#include "compare/tradeoff/sweep.h"
#include "compare/verdict/comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::tradeoff {

// Wall clock of this run of the command, ms; rows kept from an earlier one cost it nothing.
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

// Rows of one path, or of all, and of them the front in time and one error. Numbers of rows.
std::vector<std::size_t> rowsOf(const Tradeoff& tradeoff, std::optional<Path> path);
std::vector<std::size_t> frontOf(const Tradeoff& tradeoff, std::size_t figure, std::optional<Path> path = {});
std::vector<Path> pathsOf(const Tradeoff& tradeoff);  // that have rows, in the enumeration's order

// The time of the second visit of a row over that of the first: the median row's, the least and the greatest;
// what the device's speed did meanwhile. Nothing where there was one visit.
std::optional<Spread> driftOf(const Tradeoff& tradeoff);

// Commands for a shell: the row measured again by itself; its picture; its errors beside those of the other
// path, channel by channel: empty where its own reference would be another, for its size, or no other path
// knows it.
std::string measuringCommand(const Tradeoff& tradeoff, const TradeoffRow& row);
std::string renderingCommand(const Tradeoff& tradeoff, const TradeoffRow& row);
std::string comparingCommand(const Tradeoff& tradeoff, const TradeoffRow& row);

// The table on a terminal, which grows a line at a time.
class TradeoffTable {
public:
    explicit TradeoffTable(const Tradeoff& tradeoff, const std::vector<Settings>& rows);
    std::string head() const;
    std::string line(const Tradeoff& tradeoff, std::size_t row) const;

private:
    std::size_t words_ = 0;
};
// Skips with their reasons, the front, notes, cost.
std::string tradeoffEnd(const Tradeoff& tradeoff);
// What the speed of the device did during the sweep, and what it cost beside drawing: a sentence each.
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
