// SPDX-License-Identifier: MIT
// Finds the fastest Settings within an error, or the most accurate within a time or a memory, and measures
// few of the candidates for it: what a cost model says is slower for sure is not drawn, what is drawn and
// exceeds the error is not timed, and only those that may be the best are raced.
#pragma once

#include "compare/choose/cost_model.h"
#include "compare/choose/race.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace diptych::choose {

struct Budget {
    std::optional<double> error;         // of the figure that is judged by
    std::optional<double> ms;            // of a frame
    std::optional<std::uint64_t> bytes;  // of a frame: images and buffers
    // The fastest is wanted; else the most accurate, and the fastest of those.
    bool isForSpeed() const { return error.has_value(); }
};

// Errors of one picture are equal; those within this ratio are alike to whoever sets a budget.
inline constexpr double alikeErrors = 1.01;

// What repeats exactly.
struct Judged {
    double error = 0;
    std::uint64_t bytes = 0;
};

// Where candidates are measured: a device, or times that were recorded.
class Lab {
public:
    Lab() = default;
    Lab(const Lab&) = delete;
    Lab& operator=(const Lab&) = delete;
    virtual ~Lab() = default;
    virtual Judged judge(const Settings& settings) = 0;
    // An error that repeats as exactly and takes less to find, as that of one camera of several: how it
    // differs from candidate to candidate tells how that of judge() does, about. Nothing where nothing takes
    // less.
    virtual std::optional<double> estimate(const Settings&) { return {}; }
    // Draws `frames` in an order, one frame for each of its entries: their times, ms.
    virtual std::vector<double> time(std::span<const Settings> frames,
                                     std::span<const std::size_t> order) = 0;
    // The passes of some frames of one candidate, each pass by itself, ms: for effects, so that one camera
    // may stand for all. The first may be the first of all, which may take longer.
    virtual std::vector<std::vector<PassTime>> profile(const Settings& settings, int frames) = 0;
};

// Settings with some changes of one path's first candidate; nothing where that has no meaning.
using Combine = std::function<std::optional<Settings>(const Settings&, std::span<const Change>)>;

struct SearchOptions {
    Budget budget;
    std::uint64_t seed = 1;
    // Candidates that combine up to three changes which each help by itself are tried as well.
    Combine combine = {};
    std::size_t most_contenders = 6;
    // Called before each thing that takes time with a word on it and the share that is done, about.
    std::function<void(double, std::string_view)> progress = {};
};

enum class Fate {
    unseen,    // the model says that it is no better
    spoilt,    // one of its changes exceeds the error by itself
    misses,    // judged: exceeds the error or the memory
    too_slow,  // judged: exceeds the time, as timed or as the model says
    fits,      // judged, and not better by the model
    raced,
};

struct Candidate {
    Settings settings;
    Fate fate = Fate::unseen;
    std::optional<Judged> judged{};
    std::optional<double> estimated{};  // by one camera, as Lab::estimate() says
    std::size_t timings = 0;
    Prediction predicted{};              // by all that was timed
    std::vector<PassTime> passes{};      // likewise
    std::optional<Standing> standing{};  // of the race
    // As raced, or else as predicted.
    double ms() const { return standing ? standing->ms : predicted.ms(); }
    bool isFit() const { return fate == Fate::fits || fate == Fate::raced; }
};

// By how much a candidate exceeds the budget where it does so most, relative; 0: it is within. `ms`: nothing
// where that does not count.
double missOf(const Judged& judged, std::optional<double> ms, const Budget& budget);

struct Choice {
    std::vector<Candidate> candidates;
    std::optional<std::size_t> chosen;
    std::optional<std::size_t> runner_up;  // the second of the race
    std::vector<std::size_t> ties;         // as fast as the chosen one, as far as can be told
    bool sure = false;                     // the chosen one is faster than every other contender
    // Where nothing fits: what comes nearest.
    std::optional<std::size_t> nearest;
    std::size_t judged = 0, estimated = 0, timings = 0;
    double ms = 0;  // of the chosen, or of the nearest
};

// At least one candidate, those without changes first of their paths. Throws what the laboratory throws.
Choice search(std::span<const Settings> candidates, Lab& lab, CostModel& model, const SearchOptions& options);

}  // namespace diptych::choose
