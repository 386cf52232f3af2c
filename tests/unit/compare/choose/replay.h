// SPDX-License-Identifier: MIT
// Sweeps whose every row was drawn and timed, kept as tables, as a laboratory of choose.
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
    const RecordedRow& find(const Settings& settings) const;  // throws where there is none
};

// All of sweeps/.
std::vector<RecordedSweep> recordedSweeps();

// What multiplies each time: its deviation; and how much slower the device is at the end of `drifts` timings
// than at their beginning, about its recorded speed in the middle.
struct ReplayNoise {
    double deviation = 0, drift = 0;
    double drifts = 100;
};

class RecordedEvaluator final : public choose::Evaluator {
public:
    RecordedEvaluator(const RecordedSweep& sweep, const ReplayNoise& noise, std::uint64_t seed)
        : sweep_(sweep), noise_(noise), random_(seed) {}

    choose::Judged judge(const Settings& settings) override;
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order) override;
    std::vector<PassTime> profile(const Settings& settings) override;

    // How much slower the device was so many timings ago than it was recorded, but for what differs from
    // frame to frame.
    double drift(double timings_ago = 0) const;

private:
    const RecordedSweep& sweep_;
    ReplayNoise noise_;
    std::mt19937_64 random_;
    double timed_ = 0;
};

}  // namespace diptych
