// SPDX-License-Identifier: MIT
// Recorded sweeps: every row was drawn and timed. They serve as an evaluator of choose.
#pragma once

#include "compare/choose/search.h"

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace diptych {

struct RecordedRow {
    Settings settings;
    double ms = 0, error = 0;
    std::uint64_t bytes = 0;
    std::vector<PassTime> passes{};
};
struct RecordedSweep {
    std::string scene;
    std::vector<RecordedRow> rows;
    const RecordedRow& find(const Settings& settings) const;  // throws if there is none
};

// All sweeps in sweeps/.
std::vector<RecordedSweep> recordedSweeps();

// Noise of the times: the deviation of a factor, and a drift. Over `drifts` timings the device slows down
// by `drift`, and has its recorded speed in the middle.
struct ReplayNoise {
    double deviation = 0, drift = 0;
    double drifts = 100;
};

class RecordedEvaluator final : public choose::Evaluator {
public:
    RecordedEvaluator(const RecordedSweep& sweep, const ReplayNoise& noise, std::uint64_t seed)
        : sweep_(sweep), noise_(noise), random_(seed) {}

    experiment::Measures evaluate(const Settings& settings) override;
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order) override;
    std::vector<PassTime> profile(const Settings& settings) override;

    // Slowdown of the device against its recorded speed, that many timings ago, without per-frame noise.
    double drift(double timings_ago = 0) const;

private:
    const RecordedSweep& sweep_;
    ReplayNoise noise_;
    std::mt19937_64 random_;
    double timed_ = 0;
};

}  // namespace diptych
