// SPDX-License-Identifier: MIT
#include "tests/unit/compare/choose/replay.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace diptych {

namespace {

using Json = nlohmann::json;

RecordedSweep readSweep(const std::filesystem::path& file) {
    std::ifstream stream(file);
    const Json json = Json::parse(stream);
    RecordedSweep sweep{json.at("scene"), {}};
    const std::vector<std::string> options = json.at("options");
    const std::vector<std::string> passes = json.at("passes");
    for (const Json& row : json.at("rows")) {
        RecordedRow read;
        for (std::size_t i = 0; i < options.size(); ++i)
            read.settings.set(options[i], row[i].get<std::string>());
        read.ms = row[options.size()];
        read.error = row[options.size() + 1];
        read.bytes = row[options.size() + 2];
        for (std::size_t i = 0; i < passes.size(); ++i)
            if (const double ms = row[options.size() + 3 + i]; ms > 0) read.passes.push_back({passes[i], ms});
        sweep.rows.push_back(std::move(read));
    }
    return sweep;
}

}  // namespace

const RecordedRow& RecordedSweep::find(const Settings& settings) const {
    const auto row = std::ranges::find(rows, settings, &RecordedRow::settings);
    if (row == rows.end()) throw std::runtime_error(scene + ": has no row of these Settings");
    return *row;
}

std::vector<RecordedSweep> recordedSweeps() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(DIPTYCH_SOURCE_DIR "/tests/unit/compare/choose/sweeps"))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<RecordedSweep> sweeps;
    for (const auto& file : files) sweeps.push_back(readSweep(file));
    return sweeps;
}

experiment::Measures RecordedEvaluator::evaluate(const Settings& settings) {
    const RecordedRow& row = sweep_.find(settings);
    experiment::Measures measured;
    measured[experiment::Measure::flip] = row.error;
    measured[experiment::Measure::memory] = static_cast<double>(row.bytes);
    return measured;
}

double RecordedEvaluator::drift(double timings_ago) const {
    return 1 + noise_.drift * (std::clamp((timed_ - timings_ago) / noise_.drifts, 0.0, 1.0) - 0.5);
}

std::vector<double> RecordedEvaluator::time(std::span<const Settings> frames,
                                            std::span<const std::size_t> order) {
    std::vector<double> recorded, times;
    for (const Settings& settings : frames) recorded.push_back(sweep_.find(settings).ms);
    std::normal_distribution<double> noise(0, noise_.deviation);
    for (const std::size_t i : order) {
        times.push_back(recorded[i] * drift() * std::exp(noise(random_)));
        ++timed_;
    }
    return times;
}

std::vector<PassTime> RecordedEvaluator::profile(const Settings& settings) {
    return sweep_.find(settings).passes;
}

}  // namespace diptych
