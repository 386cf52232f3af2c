// SPDX-License-Identifier: MIT
// Races of times that are known, under noise and drift; the cost model and what it keeps.
#include "compare/choose/race.h"
#include "compare/choose/cost_model.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

namespace diptych::choose {

namespace {

// Frames that take `ms`, each off by noise, on a device that slows down by a part of its speed a frame.
class SlowingDevice {
public:
    SlowingDevice(std::vector<double> ms, double deviation, double drift, std::uint64_t seed)
        : ms_(std::move(ms)), deviation_(deviation), drift_(drift), random_(seed) {}
    std::vector<double> operator()(std::span<const std::size_t> order) {
        std::vector<double> times;
        for (const std::size_t i : order)
            times.push_back(ms_[i] * std::exp(std::normal_distribution<double>(0, deviation_)(random_)) *
                            (1 + drift_ * frames_++));
        return times;
    }

private:
    std::vector<double> ms_;
    double deviation_, drift_;
    std::mt19937_64 random_;
    double frames_ = 0;
};

Race raced(const std::vector<double>& ms, double deviation, double drift, std::uint64_t seed) {
    SlowingDevice device(ms, deviation, drift, seed);
    return race(
        ms.size(), [&](std::span<const std::size_t> order) { return device(order); }, {}, seed);
}

TEST(ChooseRace, StudentsQuantilesAreThoseOfTheTables) {
    EXPECT_NEAR(studentT(0.05, 1), 12.706, 1e-3);
    EXPECT_NEAR(studentT(0.05, 2), 4.303, 1e-3);
    EXPECT_NEAR(studentT(0.01, 5), 4.032, 1e-3);
    EXPECT_NEAR(studentT(0.05, 10), 2.228, 1e-3);
    EXPECT_NEAR(studentT(0.001, 30), 3.646, 1e-3);
}

// 400 races of two copies: a winner in no more of them than may be, and no winner by the order of the draws.
TEST(ChooseRace, TwoCopiesAreATie) {
    for (const double drift : {0.0, 0.01}) {
        std::size_t winners = 0, first = 0;
        for (std::uint64_t seed = 1; seed <= 400; ++seed) {
            const Race result = raced({10, 10}, 0.1, drift, seed);
            winners += result.sure;
            first += result.winner == 0;
        }
        EXPECT_LE(winners, 400 * 0.05) << drift;
        EXPECT_NEAR(static_cast<double>(first), 200.0, 50.0) << "five deviations of a fair coin's 400 throws";
    }
}

// Without noise a drift alone makes no difference: each order is drawn back.
TEST(ChooseRace, ADriftIsNoDifference) {
    const Race result = raced({10, 10, 10}, 0, 0.02, 3);
    for (const Standing& standing : result.standings) EXPECT_NEAR(standing.ratio, 1, 2e-3);
}

TEST(ChooseRace, EveryDrawIsCounted) {
    std::size_t drawn = 0;
    const auto draw = [&](std::span<const std::size_t> order) {
        drawn += order.size();
        return std::vector<double>(order.size(), 10.0);
    };
    EXPECT_EQ(race(3, draw, {}, 1).draws, drawn);
    EXPECT_GT(drawn, 0u);
}

TEST(ChooseRace, TheFastestWinsAndIsSure) {
    std::size_t right = 0, sure = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Race result = raced({12, 10, 13, 11.5, 20}, 0.05, 0.002, seed);
        right += result.winner == 1;
        sure += result.sure;
        EXPECT_LE(result.standings[4].rounds, result.standings[1].rounds)
            << "the slowest does not run to the end";
    }
    EXPECT_GE(right, 196u);
    EXPECT_GE(sure, 180u);
}

Settings withChanges(Path path, const char* gbuffer, const char* size) {
    Settings settings;
    settings.path = path;
    settings.set("gbuffer", gbuffer);
    settings.set("size", size);
    return settings;
}

// Two changes that scale two passes: their combination is predicted from each alone.
TEST(ChooseModel, PredictsACombinationFromItsChanges) {
    const Calibration none;
    CostModel model(none);
    const std::size_t first = model.add(withChanges(Path::deferred, "standard", "640x360")),
                      full = model.add(withChanges(Path::deferred, "full", "640x360")),
                      small = model.add(withChanges(Path::deferred, "standard", "320x180")),
                      both = model.add(withChanges(Path::deferred, "full", "320x180"));
    const auto observe = [&](std::size_t i, double shadow, double gbuffer, double shade) {
        const std::vector<PassTime> passes{{"shadow maps", shadow}, {"G-buffer", gbuffer}, {"shade", shade}};
        for (int k = 0; k < 3; ++k) model.observe(i, passes);
        model.observe(i, shadow + gbuffer + shade);
    };
    observe(first, 8, 4, 8);
    observe(full, 8, 8, 8);
    observe(small, 8, 1, 2);
    const Prediction prediction = model.predict(both);
    EXPECT_NEAR(prediction.ms(), 12, 1.2) << "8 + 2 + 2";
    EXPECT_LT(prediction.deviation, 0.15);
    EXPECT_NEAR(model.predict(small).ms(), 11, 0.4);
}

TEST(ChooseModel, WhatItLearnedIsKeptForTheSameDeviceDriverAndProgram) {
    const std::filesystem::path file = calibrationFile(folder(), "a device (x)");
    Calibration calibration{"a device (x)", "driver 1", "program 1", {}};
    const PassChange change{"shade", {Path::deferred, "gbuffer", "standard", "full"}};
    calibration.learn(change, "a", 5);
    calibration.learn(change, "a", 0.2);
    calibration.learn(change, "b", 0.4);
    ASSERT_TRUE(writeCalibration(file, calibration));
    const Calibration read = readCalibration(file, "a device (x)", "driver 1", "program 1");
    ASSERT_TRUE(read.find(change));
    EXPECT_NEAR(read.find(change)->mean(), 0.3, 1e-12);
    EXPECT_EQ(read.find(change)->scenes.size(), 2u) << "a scene that is chosen for again counts once";
    EXPECT_NEAR(read.find(change)->spread(), std::sqrt(0.02), 1e-9);
    EXPECT_TRUE(readCalibration(file, "a device (x)", "driver 2", "program 1").effects.empty());
    EXPECT_TRUE(readCalibration(file, "a device (x)", "driver 1", "program 2").effects.empty());
    std::ofstream(file) << "{ \"schema\": 1, \"device\": \"a device (x)\"";
    EXPECT_TRUE(readCalibration(file, "a device (x)", "driver 1", "program 1").effects.empty());
}

}  // namespace

}  // namespace diptych::choose
