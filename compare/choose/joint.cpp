// SPDX-License-Identifier: MIT
#include "compare/choose/joint.h"

#include "compare/experiment/intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace diptych::choose {

namespace {

constexpr std::size_t maxFinalists = 6;  // in the race, the fastest by earlier times
constexpr int raceRounds = 4;            // each renders every finalist twice in each scene

Settings withoutCamera(Settings settings) {
    settings.camera.clear();
    return settings;
}

class JointSearch {
public:
    JointSearch(std::span<const SettingsChoice* const> own,
                const std::function<Evaluator&(std::size_t)>& evaluatorOf, const JointOptions& options)
        : own_(own), evaluatorOf_(evaluatorOf), options_(options), budget_(options.budget) {}

    JointChoice run() {
        propose();
        inEachScene(0, 0.5, "errors for all scenes", [&](std::size_t scene) { evaluateIn(scene); });
        std::vector<std::size_t> fit;
        for (std::size_t i = 0; i < all().size(); ++i)
            if (worstMiss(i, false) <= 0) fit.push_back(i);
        if (budget_.ms && !fit.empty()) {
            timeAll(fit);
            std::erase_if(fit, [&](std::size_t i) { return worstMiss(i, true) > 0; });
        }
        while (!fit.empty()) {
            raceFor(finalistsOf(fit));
            // The race may show some to be slower than before.
            std::erase_if(fit, [&](std::size_t i) { return worstMiss(i, true) > 0; });
            if (std::ranges::count(fit, *found_.chosen) > 0) break;
            static_cast<Race&>(found_) = {};
            found_.slower.clear();
        }
        for (const std::size_t i : fit) all()[i].fits = true;
        if (!found_.chosen) findNearest();
        return std::move(found_);
    }

private:
    std::vector<JointCandidate>& all() { return found_.candidates; }

    // Visits every scene. Alternates the direction, so that the last scene is still loaded.
    template <class Do>
    void inEachScene(double from, double to, std::string_view what, const Do& act) {
        for (std::size_t k = 0; k < own_.size(); ++k) {
            const double part = static_cast<double>(k) / static_cast<double>(own_.size());
            if (options_.progress) options_.progress(from + (to - from) * part, what);
            act(backwards_ ? own_.size() - 1 - k : k);
        }
        backwards_ = !backwards_;
    }

    // A scene's proposals, most wanted first: each path's first candidate, the scene's choice, its most
    // accurate candidate, then other fitting ones, fastest first. Other scenes may need the accurate one.
    std::vector<std::vector<std::size_t>> tiersOf(const SettingsChoice& choice) const {
        std::vector<std::vector<std::size_t>> tiers(3);
        std::vector<Path> paths;
        std::optional<std::size_t> accurate;
        std::vector<std::pair<double, std::size_t>> others;
        for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
            const Candidate& candidate = choice.candidates[i];
            if (std::ranges::count(paths, candidate.settings.path) == 0) {
                paths.push_back(candidate.settings.path);
                tiers[0].push_back(i);
            }
            if (!candidate.isEvaluated()) continue;
            if (!accurate || candidate[budget_.metric] < choice.candidates[*accurate][budget_.metric])
                accurate = i;
            if (candidate.isFit() && i != choice.chosen) others.emplace_back(candidate.ms(), i);
        }
        if (choice.chosen) tiers[1].push_back(*choice.chosen);
        if (accurate) tiers[2].push_back(*accurate);
        std::ranges::sort(others);
        for (const auto& [time, i] : others) tiers.push_back({i});
        return tiers;
    }

    // Takes proposals tier by tier, so that no scene crowds out another. Within a tier, those of most
    // scenes come first.
    void propose() {
        struct Proposal {
            Settings settings;
            std::size_t tier = 0;
            std::set<std::size_t> scenes;
        };
        std::vector<Proposal> proposals;
        for (std::size_t scene = 0; scene < own_.size(); ++scene) {
            const std::vector<std::vector<std::size_t>> tiers = tiersOf(*own_[scene]);
            for (std::size_t tier = 0; tier < tiers.size(); ++tier)
                for (const std::size_t i : tiers[tier]) {
                    const Settings settings = withoutCamera(own_[scene]->candidates[i].settings);
                    auto there = std::ranges::find(proposals, settings, &Proposal::settings);
                    if (there == proposals.end())
                        there = proposals.insert(proposals.end(), {settings, tier, {}});
                    there->tier = std::min(there->tier, tier);
                    there->scenes.insert(scene);
                }
        }
        std::ranges::stable_sort(proposals, {}, [](const Proposal& proposal) {
            return std::pair(proposal.tier, std::numeric_limits<std::size_t>::max() - proposal.scenes.size());
        });
        const std::size_t taken = std::min(proposals.size(), options_.max_candidates);
        found_.omitted = proposals.size() - taken;
        for (std::size_t i = 0; i < taken; ++i)
            all().push_back({.settings = proposals[i].settings,
                             .proposed_by = proposals[i].scenes.size(),
                             .scenes = std::vector<experiment::Row>(own_.size())});
    }

    void evaluateIn(std::size_t scene) {
        Evaluator* evaluator = nullptr;
        for (JointCandidate& candidate : all()) {
            const Candidate* known = nullptr;
            for (const Candidate& own : own_[scene]->candidates)
                if (own.isEvaluated() && withoutCamera(own.settings) == candidate.settings) known = &own;
            experiment::Row& in = candidate.scenes[scene];
            in.settings = candidate.settings;
            if (known) {
                in.measured = known->measured;
                continue;
            }
            if (!evaluator) evaluator = &evaluatorOf_(scene);
            in.measured = evaluator->evaluate(candidate.settings);
            ++found_.evaluated;
        }
    }

    double missIn(std::size_t i, std::size_t scene, bool timed) const {
        Measures measured = found_.candidates[i].scenes[scene].measured;
        if (!timed) measured[Measure::ms] = std::numeric_limits<double>::quiet_NaN();
        return missOf(measured, budget_);
    }
    double worstMiss(std::size_t i, bool timed) const {
        double worst = 0;
        for (std::size_t scene = 0; scene < own_.size(); ++scene)
            worst = std::max(worst, missIn(i, scene, timed));
        return worst;
    }
    double worstError(std::size_t i) const {
        double worst = 0;
        for (const experiment::Row& in : found_.candidates[i].scenes)
            worst = std::max(worst, in[budget_.metric]);
        return worst;
    }
    double sumOfLogs(std::size_t i) const {
        double sum = 0;
        for (const experiment::Row& in : found_.candidates[i].scenes)
            sum += std::log(std::fmax(in[Measure::ms], 1e-9));
        return sum;
    }

    // Times four frames per candidate and scene, in alternating order.
    void timeAll(const std::vector<std::size_t>& which) {
        std::vector<Settings> frames;
        std::vector<std::size_t> order;
        for (const std::size_t i : which) frames.push_back(all()[i].settings);
        for (int round = 0; round < 2; ++round) {
            for (std::size_t k = 0; k < which.size(); ++k) order.push_back(k);
            for (std::size_t k = which.size(); k-- > 0;) order.push_back(k);
        }
        inEachScene(0.5, 0.7, "times for all scenes", [&](std::size_t scene) {
            const std::vector<double> times = evaluatorOf_(scene).time(frames, order);
            found_.timings += times.size();
            std::vector<std::vector<double>> logs(which.size());
            for (std::size_t at = 0; at < order.size(); ++at)
                logs[order[at]].push_back(std::log(std::max(times[at], 1e-9)));
            for (std::size_t k = 0; k < which.size(); ++k)
                all()[which[k]].scenes[scene].measured[Measure::ms] = std::exp(experiment::meanOf(logs[k]));
        });
        timed_ = true;
    }

    // Candidates to race. Without an error budget, only those with the least worst error. The fastest, if
    // there are too many.
    std::vector<std::size_t> finalistsOf(std::vector<std::size_t> fit) {
        if (!budget_.isForSpeed()) {
            double min = std::numeric_limits<double>::infinity();
            for (const std::size_t i : fit) min = std::min(min, worstError(i));
            std::erase_if(fit, [&](std::size_t i) { return worstError(i) > min * alikeErrors; });
        }
        if (fit.size() > maxFinalists && !timed_) timeAll(fit);
        std::ranges::stable_sort(fit, {}, [&](std::size_t i) { return sumOfLogs(i); });
        if (fit.size() > maxFinalists) fit.erase(fit.begin() + maxFinalists, fit.end());
        return fit;
    }

    // By scene, finalist, round: log times. Behind the finalists: the scene's own choice.
    using Rounds = std::vector<std::vector<std::vector<double>>>;

    void raceFor(const std::vector<std::size_t>& finalists) {
        const std::size_t n = finalists.size();
        std::vector<Settings> frames;
        for (const std::size_t i : finalists) frames.push_back(all()[i].settings);
        Rounds rounds(own_.size());
        const auto draw = [&](std::span<const std::size_t> order) {
            std::vector<double> logs(order.size(), 0.0);
            inEachScene(0.7, 1, "finalists of all scenes", [&](std::size_t scene) {
                std::vector<Settings> drawn = frames;
                // Each round starts and ends with the scene's own choice, unless it is a finalist.
                const bool chose = own_[scene]->chosen && ownRank(scene, finalists) == n;
                if (chose)
                    drawn.push_back(withoutCamera(own_[scene]->candidates[*own_[scene]->chosen].settings));
                std::vector<std::size_t> with;
                const std::size_t around = chose ? 1 : 0, one = 2 * n + 2 * around;
                for (std::size_t at = 0; at < order.size(); at += 2 * n) {
                    if (chose) with.push_back(n);
                    with.insert(with.end(), order.begin() + static_cast<std::ptrdiff_t>(at),
                                order.begin() + static_cast<std::ptrdiff_t>(at + 2 * n));
                    if (chose) with.push_back(n);
                }
                const std::vector<double> times = evaluatorOf_(scene).time(drawn, with);
                found_.timings += times.size();
                rounds[scene].resize(n + 1);
                for (std::size_t round = 0; round < with.size() / one; ++round) {
                    std::vector<double> sums(n + 1, 0.0);
                    for (std::size_t k = 0; k < one; ++k) {
                        const double log = std::log(std::max(times[round * one + k], 1e-9));
                        sums[with[round * one + k]] += 0.5 * log;
                        if (k >= around && k - around < 2 * n)
                            logs[round * 2 * n + k - around] += log / static_cast<double>(own_.size());
                    }
                    for (std::size_t k = 0; k < n + around; ++k) rounds[scene][k].push_back(sums[k]);
                }
            });
            for (double& log : logs) log = std::exp(log);
            return logs;
        };
        setWinner(finalists, rankByTime(n, draw, raceRounds, raceRounds), rounds);
    }
    void setWinner(const std::vector<std::size_t>& finalists, const Ranking& result, const Rounds& rounds) {
        static_cast<Race&>(found_) = raceOf(result, finalists);
        for (std::size_t k = 0; k < finalists.size(); ++k) {
            JointCandidate& candidate = all()[finalists[k]];
            candidate.race = result.ratios[k];
            for (std::size_t scene = 0; scene < own_.size(); ++scene)
                candidate.scenes[scene].measured[Measure::ms] =
                    std::exp(experiment::meanOf(rounds[scene][k]));
        }
        found_.slower.assign(own_.size(), std::nullopt);
        for (std::size_t scene = 0; scene < own_.size(); ++scene) {
            if (!own_[scene]->chosen) continue;
            const std::size_t index = ownRank(scene, finalists);
            found_.slower[scene] = TimeRatio{};
            if (index == result.winner) continue;
            found_.slower[scene] =
                experiment::meanRatio(rounds[scene][result.winner], rounds[scene][index], 0.05);
        }
    }
    // Index of the scene's own choice in `finalists`; their count if it is not there.
    std::size_t ownRank(std::size_t scene, const std::vector<std::size_t>& finalists) const {
        const Settings own = withoutCamera(own_[scene]->candidates[*own_[scene]->chosen].settings);
        const auto found = std::ranges::find_if(
            finalists, [&](std::size_t i) { return found_.candidates[i].settings == own; });
        return static_cast<std::size_t>(found - finalists.begin());
    }

    void findNearest() {
        for (std::size_t i = 0; i < all().size(); ++i)
            if (!found_.nearest || worstMiss(i, timed_) < worstMiss(*found_.nearest, timed_))
                found_.nearest = i;
        if (!found_.nearest) return;
        for (std::size_t scene = 0; scene < own_.size(); ++scene)
            if (missIn(*found_.nearest, scene, timed_) >
                missIn(*found_.nearest, found_.nearest_scene, timed_))
                found_.nearest_scene = scene;
    }

    std::span<const SettingsChoice* const> own_;
    const std::function<Evaluator&(std::size_t)>& evaluatorOf_;
    const JointOptions& options_;
    const Budget& budget_;
    bool backwards_ = false, timed_ = false;
    JointChoice found_;
};

}  // namespace

JointChoice chooseJointly(std::span<const SettingsChoice* const> own,
                          const std::function<Evaluator&(std::size_t)>& evaluatorOf,
                          const JointOptions& options) {
    return JointSearch(own, evaluatorOf, options).run();
}

}  // namespace diptych::choose
