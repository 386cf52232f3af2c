// SPDX-License-Identifier: MIT
#include "compare/choose/cost_model.h"

#include <algorithm>
#include <cmath>

namespace diptych::choose {

namespace {

// In logarithms. What the passes of a path take, nobody knows before; an effect may double a pass or halve
// it; effects combine to within some percent; the speed of a shared machine wanders by some percent over a
// hundred timings.
constexpr double unknownTime = 10, unknownEffect = 0.4, unknownBeyond = 0.3, ownDeviation = 0.06,
                 speedStep = 0.002;
// Two changes together may differ from the sum of both by this part of the geometric mean of their effects.
constexpr double pairShare = 0.3;
// What is so many deviations off was not foreseen.
constexpr double surprise = 3;
// A change of size is work in proportion for most passes, and none for some.
constexpr double perPixel = 0.7, unknownScale = 0.5;
// A pass that a frame does not have takes so little of it; and one pass timed by itself is off by more than a
// frame, by so much.
constexpr double absent = 1e-3, passDeviation = 0.05, absentDeviation = 0.05;

double pixels(const Settings& settings) {
    return static_cast<double>(settings.size.width) * settings.size.height;
}

}  // namespace

double Prediction::ms(double deviations) const {
    return std::exp(log_ms + deviations * deviation);
}

CostModel::CostModel(const Calibration& calibration)
    : calibration_(calibration), speed_(addTerm(0, speedStep)) {}

std::size_t CostModel::addTerm(double mean, double deviation) {
    for (auto& row : covariance_) row.push_back(0);
    mean_.push_back(mean);
    prior_.push_back(deviation);
    covariance_.emplace_back(mean_.size(), 0.0).back() = deviation * deviation;
    return mean_.size() - 1;
}

std::size_t CostModel::add(const Settings& settings) {
    const auto path = paths_.find(settings.path);
    if (path == paths_.end()) paths_[settings.path] = {settings, addTerm(0, unknownBeyond), {}, {}};
    const Settings& first = paths_.at(settings.path).first;
    Candidate candidate{settings, {}, {}};
    for (const Field& field : settingFields())
        if (std::string from = first.valueOf(field.option), to = settings.valueOf(field.option); from != to)
            candidate.changes.push_back(
                {settings.path, std::string(field.option), std::move(from), std::move(to)});
    for (const auto& [pass, term] : paths_.at(settings.path).passes)
        for (const Change& change : candidate.changes) effectOf(pass, change, settings);
    candidates_.push_back(std::move(candidate));
    return candidates_.size() - 1;
}

std::optional<std::size_t> CostModel::knownEffectOf(const std::string& pass, const Change& change) const {
    const auto effect = effects_.find({pass, change});
    return effect == effects_.end() ? std::optional<std::size_t>() : effect->second;
}

std::size_t CostModel::effectOf(const std::string& pass, const Change& change, const Settings& to) {
    if (const auto there = knownEffectOf(pass, change)) return *there;
    double mean = 0, deviation = unknownEffect;
    if (const std::optional<Effect> known = calibration_.find({pass, change})) {
        mean = known->mean();
        deviation = known->spread();
    } else if (change.option == "size") {
        mean = perPixel * std::log(pixels(to) / pixels(paths_.at(change.path).first));
        deviation = unknownScale;
    }
    return effects_.emplace(PassChange{pass, change}, addTerm(mean, deviation)).first->second;
}

// With the effects of all changes that candidates have.
void CostModel::addPass(const std::string& pass, PathTerms& path) {
    if (!path.passes.try_emplace(pass, 0).second) return;
    path.passes[pass] = addTerm(0, unknownTime);
    for (const Candidate& candidate : candidates_)
        if (candidate.settings.path == path.first.path)
            for (const Change& change : candidate.changes) effectOf(pass, change, candidate.settings);
}

CostModel::Terms CostModel::termsOf(const Candidate& candidate, const std::string& pass) const {
    Terms terms{{paths_.at(candidate.settings.path).passes.at(pass), 1.0}};
    for (const Change& change : candidate.changes) terms.emplace_back(effects_.at({pass, change}), 1.0);
    return terms;
}

double CostModel::valueOf(const Terms& terms) const {
    double value = 0;
    for (const auto& [term, factor] : terms) value += factor * mean_[term];
    return value;
}

std::pair<double, CostModel::Terms> CostModel::wholeOf(const Candidate& candidate) const {
    const PathTerms& path = paths_.at(candidate.settings.path);
    Terms whole{{path.beyond, 1.0}};
    if (candidate.own) whole.emplace_back(*candidate.own, 1.0);
    const std::vector<Change>& changes = candidate.changes;
    for (std::size_t i = 0; i < changes.size() && !pairs_.empty(); ++i)
        for (std::size_t j = i + 1; j < changes.size(); ++j)
            if (const auto pair = pairs_.find({changes[i], changes[j]}); pair != pairs_.end())
                whole.emplace_back(pair->second, 1.0);
    const double besides = valueOf(whole);
    if (path.passes.empty()) return {besides, whole};
    std::vector<Terms> passes;
    std::vector<double> times;
    double sum = 0;
    for (const auto& [pass, term] : path.passes) {
        passes.push_back(termsOf(candidate, pass));
        times.push_back(std::exp(std::min(valueOf(passes.back()), 50.0)));
        sum += times.back();
    }
    for (std::size_t i = 0; i < passes.size(); ++i)
        for (const auto& [term, factor] : passes[i]) whole.emplace_back(term, factor * times[i] / sum);
    return {std::log(sum) + besides, std::move(whole)};
}

double CostModel::wholeEffectOf(const Change& change) const {
    double before = 0, after = 0;
    for (const auto& [pass, term] : paths_.at(change.path).passes) {
        const double ms = std::exp(std::min(mean_[term], 50.0));
        before += ms;
        after += ms * std::exp(std::min(mean_[effects_.at({pass, change})], 50.0));
    }
    return before > 0 ? std::log(after / before) : 0;
}

double CostModel::unknownPair(const Change& a, const Change& b) const {
    return pairShare * std::sqrt(std::abs(wholeEffectOf(a) * wholeEffectOf(b)));
}

void CostModel::update(const Terms& terms, double left, double deviation,
                       const std::vector<std::size_t>& blamed) {
    double variance = deviation * deviation;
    for (const auto& [a, x] : terms)
        for (const auto& [b, y] : terms) variance += x * y * covariance_[a][b];
    // Else one effect of twenty times its deviation would drag along all that is correlated with it.
    if (left * left > surprise * surprise * variance)
        for (const std::size_t term : blamed) {
            const double more = (left * left - variance) / static_cast<double>(blamed.size());
            covariance_[term][term] += more;
        }
    std::vector<double> gain(mean_.size(), 0.0);
    for (const auto& [term, factor] : terms)
        for (std::size_t i = 0; i < mean_.size(); ++i) gain[i] += factor * covariance_[i][term];
    variance = deviation * deviation;
    for (const auto& [term, factor] : terms) variance += factor * gain[term];
    for (std::size_t i = 0; i < mean_.size(); ++i) {
        if (gain[i] == 0) continue;
        const double share = gain[i] / variance;
        mean_[i] += share * left;
        for (std::size_t j = 0; j < mean_.size(); ++j) covariance_[i][j] -= share * gain[j];
    }
}

void CostModel::observe(std::size_t candidate, double ms) {
    Candidate& timed = candidates_.at(candidate);
    // Of a path's first candidate what its frames take beyond their passes is its deviation.
    if (!timed.own && !timed.changes.empty()) {
        timed.own = addTerm(0, ownDeviation);
        for (std::size_t i = 0; i < timed.changes.size(); ++i)
            for (std::size_t j = i + 1; j < timed.changes.size(); ++j)
                if (const ChangePair pair{timed.changes[i], timed.changes[j]}; pairs_.count(pair) == 0)
                    pairs_[pair] = addTerm(0, unknownPair(pair.first, pair.second));
    }
    covariance_[speed_][speed_] += speedStep * speedStep;
    auto [whole, terms] = wholeOf(timed);
    terms.emplace_back(speed_, 1.0);
    std::vector<std::size_t> blamed;
    if (timed.own) blamed.push_back(*timed.own);
    update(terms, std::log(std::max(ms, 1e-9)) - whole - mean_[speed_], noise_, blamed);
}

void CostModel::observe(std::size_t candidate, std::span<const PassTime> passes) {
    const Candidate& timed = candidates_.at(candidate);
    PathTerms& path = paths_.at(timed.settings.path);
    std::map<std::string, double> times;
    double sum = 1e-9;
    for (const PassTime& pass : passes) {
        times[pass.name] += pass.ms;
        sum += pass.ms;
    }
    for (const auto& [pass, ms] : times)
        if (path.passes.count(pass) == 0) {
            addPass(pass, path);
            // Those that were profiled before do not have it.
            for (const std::size_t before : path.profiled) observe(candidates_[before], pass, 0, sum);
        }
    covariance_[speed_][speed_] += speedStep * speedStep;
    for (const auto& [pass, term] : path.passes) {
        const auto time = times.find(pass);
        observe(timed, pass, time == times.end() ? 0.0 : time->second, sum);
    }
    path.profiled.push_back(candidate);
}

void CostModel::observe(const Candidate& candidate, const std::string& pass, double ms, double sum) {
    const bool is_absent = ms <= absent * sum;
    Terms terms = termsOf(candidate, pass);
    terms.emplace_back(speed_, 1.0);
    // A short pass is timed less well, and matters less.
    const double deviation =
        is_absent ? absentDeviation : std::hypot(noise_, passDeviation) / std::sqrt(std::max(ms / sum, 1e-2));
    std::vector<std::size_t> blamed;
    for (const Change& change : candidate.changes) blamed.push_back(effects_.at({pass, change}));
    update(terms, std::log(std::max(ms, absent * sum)) - valueOf(terms), deviation, blamed);
}

Prediction CostModel::predict(std::size_t candidate) const {
    const Candidate& of = candidates_.at(candidate);
    const auto [whole, terms] = wholeOf(of);
    double variance = of.own || of.changes.empty() ? 0 : ownDeviation * ownDeviation;
    for (std::size_t i = 0; i < of.changes.size(); ++i)
        for (std::size_t j = i + 1; j < of.changes.size(); ++j)
            if (pairs_.count({of.changes[i], of.changes[j]}) == 0)
                variance += std::pow(unknownPair(of.changes[i], of.changes[j]), 2);
    for (const auto& [a, x] : terms)
        for (const auto& [b, y] : terms) variance += x * y * covariance_[a][b];
    return {whole + mean_[speed_], std::sqrt(std::max(variance, 0.0))};
}

std::vector<PassTime> CostModel::passesOf(std::size_t candidate) const {
    const Candidate& of = candidates_.at(candidate);
    std::vector<PassTime> passes;
    for (const auto& [pass, term] : paths_.at(of.settings.path).passes)
        passes.push_back({pass, std::exp(std::min(valueOf(termsOf(of, pass)), 50.0))});
    return passes;
}

const std::vector<Change>& CostModel::changesOf(std::size_t candidate) const {
    return candidates_.at(candidate).changes;
}

bool CostModel::knows(const Change& change, double deviation) const {
    const PathTerms& path = paths_.at(change.path);
    double sum = 0, variance = 0;
    for (const auto& [pass, term] : path.passes) {
        const double ms = std::exp(std::min(mean_[term], 50.0));
        const auto effect = knownEffectOf(pass, change);
        sum += ms;
        variance += ms * ms * (effect ? covariance_[*effect][*effect] : unknownEffect * unknownEffect);
    }
    return !path.passes.empty() && variance <= deviation * deviation * sum * sum;
}

void CostModel::teach(Calibration& calibration, const std::string& scene) const {
    for (const auto& [key, term] : effects_)
        if (std::sqrt(covariance_[term][term]) < 0.5 * prior_[term])
            calibration.learn(key, scene, mean_[term]);
}

}  // namespace diptych::choose
