// SPDX-License-Identifier: MIT
// Sweeps whose every row was drawn and timed, kept as tables, as a laboratory of choose.
#pragma once

#include "compare/choose/search.h"

#include <cstdint>
#include <optional>
#include <random>
#include <set>
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

// Of each time: the deviation of what multiplies it; and how much slower the device is at the end of `drifts`
// timings than at their beginning, about its recorded speed in the middle.
struct ReplayNoise {
    double deviation = 0, drift = 0;
    double drifts = 150;
    // The share of Settings whose first frame takes longer, and by what part of its time in the mean
    // (exponentially distributed).
    double slow_firsts = 0, slower_first = 0;
    // Of the logarithm of an estimated error, which is another one for each Settings and the same each time;
    // 0: nothing is estimated, as of one camera.
    double estimate = 0;
    double camera = 1;  // how much larger the errors of its camera are than those of all
};

class RecordedLab final : public choose::Lab {
public:
    RecordedLab(const RecordedSweep& sweep, const ReplayNoise& noise, std::uint64_t seed)
        : sweep_(sweep), noise_(noise), seed_(seed), random_(seed) {}

    choose::Judged judge(const Settings& settings) override;
    std::optional<double> estimate(const Settings& settings) override;
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order) override;
    std::vector<std::vector<PassTime>> profile(const Settings& settings, int frames) override;

    // How much slower the device was so many timings ago than it was recorded, but for what differs from
    // frame to frame.
    double drift(double timings_ago = 0) const;

private:
    double slower();  // by what the next time is multiplied

    const RecordedSweep& sweep_;
    ReplayNoise noise_;
    std::uint64_t seed_;
    std::set<const RecordedRow*> profiled_;
    std::mt19937_64 random_;
    double timed_ = 0;
};

}  // namespace diptych
