// SPDX-License-Identifier: MIT
// What one value of a Setting instead of another does to the time of a frame on a device, as scenes chosen
// for before have shown: where a cost model begins.
#pragma once

#include "shared/frame/settings.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>

namespace diptych::choose {

// A path, an option, its value before and after, in the words of Settings::set().
struct Change {
    Path path = Path::deferred;
    std::string option, from, to;
    auto operator<=>(const Change&) const = default;
};
// And the pass whose time it changes.
struct PassChange {
    std::string pass;
    Change change;
    auto operator<=>(const PassChange&) const = default;
};

// The logarithm of the ratio of a pass's times after and before, as each scene has it.
struct Effect {
    std::map<std::string, double> scenes;  // at least one
    double mean() const;
    // How far a scene's own is from the mean, standard deviation. One scene says nothing of that: half of it,
    // and a quarter at least.
    double spread() const;
};

// On one device, with one driver, by one build of the program.
struct Calibration {
    std::string device, driver, program;
    std::map<PassChange, Effect> effects;

    std::optional<Effect> find(const PassChange& change) const;
    // What a scene taught before is forgotten.
    void learn(const PassChange& change, const std::string& scene, double logRatio);
};

// The file of a device in the cache folder (userCacheFolder()).
std::filesystem::path calibrationFile(const std::filesystem::path& folder, const std::string& device);

// What was kept for this device, driver and program; without effects where the file is not there, damaged or
// of another driver or program.
Calibration readCalibration(const std::filesystem::path& file, const std::string& device,
                            const std::string& driver, const std::string& program);
// Whole or the old one; returns whether it could be written.
bool writeCalibration(const std::filesystem::path& file, const Calibration& calibration);

}  // namespace diptych::choose
