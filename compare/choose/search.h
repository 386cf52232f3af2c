// SPDX-License-Identifier: MIT
// Finds the fastest Settings within an error, or the most accurate within a time or a memory: a table of
// candidates is drawn, judged and timed; then single changes and pairs around each path's best, while they
// help; then the best few are timed again until they are told apart.
#pragma once

#include "compare/choose/table.h"
#include "compare/choose/told_apart.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::choose {

struct Budget {
    std::optional<double> error;         // by the metric that judges
    std::optional<double> ms;            // of a frame
    std::optional<std::uint64_t> bytes;  // of a frame: images and buffers
    // The fastest is wanted; else the most accurate, and the fastest of those.
    bool isForSpeed() const { return error.has_value(); }
};

// Errors within this ratio are alike to whoever sets a budget.
inline constexpr double alikeErrors = 1.01;

// Both repeat exactly.
struct Judged {
    double error = 0;
    std::uint64_t bytes = 0;
};

// Where candidates are measured: a device, or recorded times.
class Lab {
public:
    Lab() = default;
    Lab(const Lab&) = delete;
    Lab& operator=(const Lab&) = delete;
    virtual ~Lab() = default;
    virtual Judged judge(const Settings& settings) = 0;
    // Draws `frames` in an order, one frame for each of its entries: their times, ms.
    virtual std::vector<double> time(std::span<const Settings> frames,
                                     std::span<const std::size_t> order) = 0;
    // The passes of one frame, each timed by itself, ms.
    virtual std::vector<PassTime> profile(const Settings& settings) = 0;
};

// Settings with some changes; nothing where that has no meaning.
using Combine = std::function<std::optional<Settings>(const Settings&, std::span<const Change>)>;

struct SearchOptions {
    Budget budget;
    // Tried around the best beside the changes that the table shows.
    std::vector<Change> changes = {};
    // Without it the table is all there is.
    Combine combine = {};
    // Called before each step with a word on it and the share that is done, about.
    std::function<void(double, std::string_view)> progress = {};
};

enum class Fate {
    slower,    // timed, slower than the best; not judged
    misses,    // exceeds the error or the memory
    too_slow,  // exceeds the time
    fits,
    raced,  // fits, and was timed again with the best
};

struct Candidate {
    Settings settings;
    Fate fate = Fate::slower;
    std::optional<Judged> judged{};
    double log_ms = 0;                   // mean of its timings
    std::size_t timings = 0;             // 0: log_ms means nothing
    std::vector<PassTime> passes{};      // the chosen one's and the other path's best
    std::optional<Standing> standing{};  // where it was timed with the best
    double ms() const;                   // not a number without timings
    bool isFit() const { return fate == Fate::fits || fate == Fate::raced; }
};

// By how much a candidate exceeds the budget where it does so most, relative; 0: it is within. `ms`: nothing
// where that does not count.
double missOf(const Judged& judged, std::optional<double> ms, const Budget& budget);

struct Choice {
    std::vector<Candidate> candidates;
    std::optional<std::size_t> chosen;
    std::optional<std::size_t> runner_up;  // second fastest of those timed with the chosen one
    std::vector<std::size_t> ties;         // not told apart from the chosen one
    bool sure = false;                     // the chosen one is faster than each of those
    std::optional<std::size_t> nearest;    // where nothing fits
    std::size_t judged = 0, timings = 0;
    double ms = 0;  // of the chosen, or of the nearest
};

// `table`: at least one candidate; the first of each path is the one whose changes the others show. Throws
// what the laboratory throws.
Choice search(std::span<const Settings> table, Lab& lab, const SearchOptions& options);

// The best fitting candidate of the path that was not chosen: the fastest, or without an error in the budget
// the most accurate.
std::optional<std::size_t> bestOfOtherPath(const Choice& choice, const Budget& budget);

}  // namespace diptych::choose
