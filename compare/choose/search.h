// SPDX-License-Identifier: MIT
// Finds the fastest Settings within an error, or the most accurate within a time or memory budget. First
// measures a table of candidates. Then tries single changes and pairs around each path's best while they
// help. Last, times the best few until the fastest is significantly faster.
#pragma once

#include "compare/choose/ranking.h"
#include "compare/experiment/evaluator.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::choose {

using experiment::Evaluator;
using experiment::Measure;
using experiment::Measures;

// One Setting of a path: option and value as words of Settings::set().
struct Change {
    Path path = Path::deferred;
    std::string option, value;
    auto operator<=>(const Change&) const = default;
};
// Options in which `to` differs from `from`, with the values of `to`.
std::vector<Change> changesBetween(const Settings& from, const Settings& to);

// What a choice measures first (table.cpp): each path's first candidate and those that differ from it in one
// usual change; all candidates if they are few. `candidates`: each path's first comes before its others.
std::vector<Settings> tableOf(std::span<const Settings> candidates);
inline constexpr std::size_t maxInTable = 24;

struct Budget {
    Measure metric = Measure::flip;  // of `error`
    std::optional<double> error;
    std::optional<double> ms;            // per frame
    std::optional<std::uint64_t> bytes;  // images and buffers of a frame
    // Whether the fastest is wanted. Else the most accurate, and the fastest among equals.
    bool isForSpeed() const { return error.has_value(); }
};

// Errors within this ratio count as equal.
inline constexpr double alikeErrors = 1.01;

struct SearchOptions {
    Budget budget;
    // Changes to try besides those of the table.
    std::vector<Change> changes = {};
    // Settings with further changes; empty if the combination is invalid. Without it, only the table is
    // measured.
    std::function<std::optional<Settings>(const Settings&, std::span<const Change>)> combine = {};
    // Called before each step with the fraction done, approximate, and its description.
    std::function<void(double, std::string_view)> progress = {};
};

enum class CandidateStatus {
    slower,    // timed, slower than the best; not evaluated
    misses,    // exceeds the error or memory
    too_slow,  // exceeds the time
    fits,
    raced,  // fits, and was timed against the best
};
struct StatusName {
    const char *word, *text;
};
inline constexpr std::array<StatusName, 5> statusNames{{{"slower", "slower, error not measured"},
                                                        {"misses", "over the error or memory budget"},
                                                        {"too slow", "too slow"},
                                                        {"fits", "no better"},
                                                        {"raced", "timed against each other"}}};

// Row::passes: of the chosen one and the other path's best.
struct Candidate : experiment::Row {
    CandidateStatus status = CandidateStatus::slower;
    double log_ms = 0;        // mean of its log times, ms
    std::size_t timings = 0;  // 0: log_ms is not valid
    // If raced: its time over the winner's.
    std::optional<TimeRatio> race{};
    StatusName statusName() const { return statusNames[static_cast<std::size_t>(status)]; }
    double ms() const;  // NaN without timings
    bool isEvaluated() const { return measured.has(Measure::memory); }
    bool isFit() const { return status == CandidateStatus::fits || status == CandidateStatus::raced; }
};

// Largest relative excess over the budget; 0: within it, as far as it was measured.
double missOf(const Measures& measured, const Budget& budget);

// The result of a choice for one scene or of a joint choice.
struct Outcome : Race {
    std::optional<std::size_t> nearest;  // if nothing fits
    std::size_t evaluated = 0, timings = 0;
    std::optional<std::size_t> shown() const { return chosen ? chosen : nearest; }
};

struct SettingsChoice : Outcome {
    std::vector<Candidate> candidates;
    double ms = 0;  // of the chosen or nearest one
};

// `table`: at least one candidate. The first of each path is the base of its changes. Throws what the
// evaluator throws.
SettingsChoice search(std::span<const Settings> table, Evaluator& evaluator, const SearchOptions& options);

// Best fitting candidate of the other path: the fastest, or the most accurate without an error budget.
std::optional<std::size_t> bestOfOtherPath(const SettingsChoice& choice, const Budget& budget);

}  // namespace diptych::choose
