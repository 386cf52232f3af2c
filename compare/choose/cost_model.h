// SPDX-License-Identifier: MIT
// The time of a frame by its Settings, before and while they are timed.
//
// A frame takes the sum of its passes. The logarithm of a pass's time is that of its path's first candidate,
// plus an effect for each Setting in which a candidate differs from that one. The logarithm of a frame's is
// that of the sum, plus what the path's frames take beyond their passes, plus what two changes do beyond what
// each does alone, plus what no such model says (a deviation of the candidate's own), plus the device's
// speed, which walks at random from one timing to the next. All are unknown and normally distributed, and
// each timing narrows them: an extended Kalman filter with these as its state (Kalman 1960). So a few timings
// predict many Settings, and how far off that may be.
#pragma once

#include "compare/choose/calibration.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace diptych::choose {

// In logarithms, about relative.
struct Prediction {
    double log_ms = 0, deviation = 0;
    double ms(double deviations = 0) const;  // so many standard deviations away
};

class CostModel {
public:
    explicit CostModel(const Calibration& calibration);

    // The first one of a path is what the path's others are told by. Returns the candidate's number, from 0.
    std::size_t add(const Settings& settings);

    // A frame of a candidate took so long, or its passes did, each by itself; in the order of the timings.
    void observe(std::size_t candidate, double ms);
    void observe(std::size_t candidate, std::span<const PassTime> passes);
    // The standard deviation of a single timing, relative; until it is told, 0.05.
    void setNoise(double deviation) { noise_ = deviation; }

    Prediction predict(std::size_t candidate) const;
    // Its passes as predicted, ms.
    std::vector<PassTime> passesOf(std::size_t candidate) const;
    // What the candidate changes of its path's first one.
    const std::vector<Change>& changesOf(std::size_t candidate) const;
    // Whether a change's effect on every pass is known to within `deviation`, relative to the whole frame.
    bool knows(const Change& change, double deviation) const;
    // The effects that timings narrowed: into `calibration`.
    void teach(Calibration& calibration, const std::string& scene) const;

private:
    struct Candidate {
        Settings settings;
        std::vector<Change> changes;
        std::optional<std::size_t> own;  // its deviation's, once it was timed
    };
    using ChangePair = std::pair<Change, Change>;
    struct PathTerms {
        Settings first;
        std::size_t beyond;                         // passes
        std::map<std::string, std::size_t> passes;  // of the first candidate
        std::vector<std::size_t> profiled;          // candidates whose passes were observed
    };
    // Terms of the state, each with its factor.
    using Terms = std::vector<std::pair<std::size_t, double>>;

    std::size_t addTerm(double mean, double deviation);
    std::size_t effectOf(const std::string& pass, const Change& change, const Settings& to);
    std::optional<std::size_t> knownEffectOf(const std::string& pass, const Change& change) const;
    void addPass(const std::string& pass, PathTerms& path);
    // What a candidate's pass took, of a frame that took `sum`, ms.
    void observe(const Candidate& candidate, const std::string& pass, double ms, double sum);
    // The state of a pass of a candidate; of the whole frame: the logarithm, and the terms about it.
    Terms termsOf(const Candidate& candidate, const std::string& pass) const;
    std::pair<double, Terms> wholeOf(const Candidate& candidate) const;
    // The logarithm by which a change alone makes its path's first candidate slower.
    double wholeEffectOf(const Change& change) const;
    // How far two changes may be from what each does alone.
    double unknownPair(const Change& a, const Change& b) const;
    // An observation of the sum of some terms was `left` above what they say. Where that is far beyond what
    // they are known to, it is `blamed` terms that were thought too well of.
    void update(const Terms& terms, double left, double deviation, const std::vector<std::size_t>& blamed);
    double valueOf(const Terms& terms) const;

    const Calibration& calibration_;
    std::vector<Candidate> candidates_;
    std::map<Path, PathTerms> paths_;
    std::map<PassChange, std::size_t> effects_;
    std::map<ChangePair, std::size_t> pairs_;  // that were timed together
    std::vector<double> prior_;                // deviations
    std::vector<double> mean_;
    std::vector<std::vector<double>> covariance_;
    std::size_t speed_;
    double noise_ = 0.05;
};

}  // namespace diptych::choose
