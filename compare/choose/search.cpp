// SPDX-License-Identifier: MIT
#include "compare/choose/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace diptych::choose {

namespace {

// Candidates timed together. They and the anchor keep their images allocated.
constexpr std::size_t timedTogether = 4;
// Smaller changes of the device's speed, in log time, are noise.
constexpr double worthShifting = 0.15;
// Candidates per step around the best, and unsuccessful ones after which the search stops.
constexpr std::size_t triedTogether = 3, maxInVain = 6;
// Predictions sum noisy effects: candidates predicted worse than needed by these factors are still tried.
constexpr double timeSlack = 1.2, budgetSlack = 1.1;
// Slower candidates, relative to the best, are not evaluated after their two frames.
constexpr double worthEvaluating = 1.05;
// Table rows slower than a fitting one by this factor are not evaluated.
constexpr double hopeless = 1.5;
// Smaller gains in log time do not count as improvements.
constexpr double worthNoticing = 0.02;
// The other path is improved only while its best is within this factor of the overall best.
constexpr double worthImproving = 3;
constexpr std::size_t finalists = 3;
constexpr double worthTimingAgain = 1.15;

// Effect of a change on its path's first candidate. An unknown effect is measured alone before it is
// combined.
struct Effect {
    double log_ms = 0, error = 0, bytes = 0;
    Effect operator+(const Effect& b) const { return {log_ms + b.log_ms, error + b.error, bytes + b.bytes}; }
    Effect operator-(const Effect& b) const { return {log_ms - b.log_ms, error - b.error, bytes - b.bytes}; }
};

class Search {
public:
    Search(std::span<const Settings> table, Evaluator& evaluator, const SearchOptions& options)
        : evaluator_(evaluator), options_(options), budget_(options.budget) {
        for (const Settings& settings : table) all_.push_back({{.settings = settings}});
        known_ = all_.size();
    }

    SettingsChoice run() {
        measureTable();
        if (options_.combine) {
            learnChanges();
            for (const auto& [path, first] : firsts_) improve(path);
        }
        for (Candidate& each : all_)
            each.status = !each.isEvaluated()                  ? CandidateStatus::slower
                          : missOf(each.measured, budget_) > 0 ? CandidateStatus::misses
                          : missBy(each) > 0                   ? CandidateStatus::too_slow
                                                               : CandidateStatus::fits;
        timeBestAgain();
        if (!found_.chosen) findNearest();
        for (Candidate& each : all_) each.measured[Measure::ms] = each.ms();
        found_.candidates = std::move(all_);
        for (const auto& shown : {found_.chosen, bestOfOtherPath(found_, budget_)})
            if (shown) {
                Candidate& candidate = found_.candidates[*shown];
                candidate.passes = evaluator_.profile(candidate.settings);
            }
        return std::move(found_);
    }

private:
    void reportProgress(double done, std::string_view what) const {
        if (options_.progress) options_.progress(done, what);
    }
    void evaluate(std::size_t i) {
        if (all_[i].isEvaluated()) return;
        all_[i].measured = evaluator_.evaluate(all_[i].settings);
        ++found_.evaluated;
    }
    // Times two frames per candidate, in an order and its reverse. A candidate with known time, if any,
    // goes between them as the anchor. Times are relative to it, which cancels a drift of the device's
    // speed.
    void time(std::vector<std::size_t> which, std::optional<std::size_t> anchor) {
        if (which.empty()) return;
        if (anchor && all_[*anchor].timings > 0 && std::ranges::count(which, *anchor) == 0)
            which.push_back(*anchor);
        else
            anchor.reset();
        std::vector<Settings> frames;
        std::vector<std::size_t> order;
        for (std::size_t k = 0; k < which.size(); ++k) {
            frames.push_back(all_[which[k]].settings);
            order.push_back(k);
        }
        for (std::size_t k = which.size(); k-- > 0;) order.push_back(k);
        const std::vector<double> times = evaluator_.time(frames, order);
        std::vector<double> logs(which.size(), 0.0);
        for (std::size_t at = 0; at < times.size(); ++at)
            logs[order[at]] += 0.5 * std::log(std::max(times[at], 1e-9));
        double shift = anchor ? all_[*anchor].log_ms - logs.back() : 0;
        if (std::abs(shift) < worthShifting) shift = 0;
        for (std::size_t k = 0; k < which.size(); ++k) {
            Candidate& candidate = all_[which[k]];
            const auto before = static_cast<double>(candidate.timings);
            candidate.log_ms = (candidate.log_ms * before + 2 * (logs[k] + shift)) / (before + 2);
            candidate.timings += 2;
        }
        found_.timings += times.size();
    }

    void measureTable() {
        for (std::size_t from = 0; from < all_.size(); from += timedTogether) {
            reportProgress(0.7 * static_cast<double>(from) / static_cast<double>(all_.size()), "table");
            std::vector<std::size_t> together;
            for (std::size_t i = from; i < std::min(from + timedTogether, all_.size()); ++i)
                together.push_back(i);
            time(together, 0);
            for (const std::size_t i : together) {
                const bool is_first = firsts_.emplace(all_[i].settings.path, i).second;
                if (!is_first && budget_.isForSpeed() && all_[i].ms() > hopeless * minFitting()) continue;
                evaluate(i);
            }
        }
        // If nothing fits yet, evaluate slow candidates as well.
        for (std::size_t i = 0; i < all_.size() && !std::isfinite(minFitting()); ++i) evaluate(i);
    }
    double minFitting() const {
        double min = std::numeric_limits<double>::infinity();
        for (const Candidate& each : all_)
            if (each.isEvaluated() && missOf(each.measured, budget_) <= 0) min = std::min(min, each.ms());
        return min;
    }

    Effect measured(std::size_t i) const {
        // A row that was not evaluated borrows its first candidate's error: it is too slow anyway.
        const Candidate& candidate = all_[i];
        const Candidate& evaluated =
            candidate.isEvaluated() ? candidate : all_[firsts_.at(candidate.settings.path)];
        return {candidate.log_ms, evaluated[budget_.metric], evaluated[Measure::memory]};
    }
    void learnChanges() {
        const auto add = [&](const Change& change, std::optional<Effect> effect) {
            // Also allow a return to the first candidate's value.
            const Change back{change.path, change.option,
                              all_[firsts_.at(change.path)].settings.valueOf(change.option)};
            effects_.try_emplace(back, Effect{});
            if (effect)
                effects_.insert_or_assign(change, effect);
            else
                effects_.try_emplace(change, std::nullopt);
        };
        for (std::size_t i = 0; i < known_; ++i) {
            const std::vector<Change> changes =
                changesBetween(all_[firsts_.at(all_[i].settings.path)].settings, all_[i].settings);
            for (const Change& change : changes)
                add(change, changes.size() == 1
                                ? std::optional(measured(i) - measured(firsts_.at(change.path)))
                                : std::nullopt);
        }
        for (const Change& change : options_.changes)
            if (firsts_.count(change.path) > 0) add(change, {});
    }
    // Derives an unknown effect from two candidates that differ in this change.
    void learnFrom(std::size_t from, std::size_t to) {
        if (!all_[from].isEvaluated() || !all_[to].isEvaluated() || all_[to].timings == 0) return;
        for (auto& [change, effect] : effects_)
            if (!effect && change.path == all_[to].settings.path &&
                all_[to].settings.valueOf(change.option) == change.value)
                if (const auto before = effects_.find(
                        {change.path, change.option, all_[from].settings.valueOf(change.option)});
                    before != effects_.end() && before->second)
                    effect = *before->second + measured(to) - measured(from);
    }

    double missBy(const Candidate& candidate) const {
        Measures timed = candidate.measured;
        timed[Measure::ms] = candidate.ms();
        return missOf(timed, budget_);
    }
    // Less is better: the miss of the budget, then the objective.
    std::tuple<double, double, double> rank(std::size_t i) const {
        const Candidate& candidate = all_[i];
        if (!candidate.isEvaluated()) return {std::numeric_limits<double>::infinity(), 0, 0};
        if (const double miss = missBy(candidate); miss > 0) return {miss, 0, 0};
        const double error = candidate[budget_.metric];
        if (budget_.isForSpeed()) return {0, candidate.log_ms, error};
        return {0, std::round(std::log(std::max(error, 1e-9)) / std::log(alikeErrors)), candidate.log_ms};
    }
    std::size_t bestOf(Path path) const {
        std::size_t best = firsts_.at(path);
        for (std::size_t i = 0; i < all_.size(); ++i)
            if (all_[i].settings.path == path && rank(i) < rank(best)) best = i;
        return best;
    }

    struct Trial {
        std::tuple<double, double, double> rank;  // predicted
        std::vector<Change> changes;
    };
    // Changes that may improve `from` by their effects, most promising first.
    std::vector<Trial> trialsFrom(std::size_t from) const {
        const Candidate& best = all_[from];
        const double miss = missBy(best);
        std::vector<std::pair<Change, std::optional<Effect>>> singles;
        for (const auto& [change, effect] : effects_) {
            if (change.path != best.settings.path) continue;
            const std::string value = best.settings.valueOf(change.option);
            if (value == change.value) continue;
            const auto before = effects_.find({change.path, change.option, value});
            const bool known = effect && before != effects_.end() && before->second;
            singles.emplace_back(change, known ? std::optional(*effect - *before->second) : std::nullopt);
        }
        std::vector<Trial> trials;
        const auto consider = [&](const Effect& effect, std::vector<Change> changes) {
            const Effect sum = measured(from) + effect;
            const double ms = std::exp(sum.log_ms), error = std::max(sum.error, 0.0);
            Measures expected;
            expected[budget_.metric] = error / budgetSlack;
            expected[Measure::memory] = sum.bytes / budgetSlack;
            expected[Measure::ms] = ms / budgetSlack;
            const double predicted = missOf(expected, budget_);
            if (miss > 0 ? predicted >= miss : predicted > 0) return;
            const auto count = static_cast<double>(changes.size());
            if (miss > 0)
                trials.push_back({{predicted, ms, count}, std::move(changes)});
            else if (budget_.isForSpeed() && ms < timeSlack * best.ms())
                trials.push_back({{0, ms, count}, std::move(changes)});
            else if (!budget_.isForSpeed() && error < best[budget_.metric])
                trials.push_back({{0, error, ms}, std::move(changes)});
        };
        for (std::size_t a = 0; a < singles.size(); ++a) {
            if (!singles[a].second) {
                // Unknown effect: assume slightly better than the best, so that it is tried.
                consider({0, -1e-3 * best[budget_.metric], 0}, {singles[a].first});
                continue;
            }
            consider(*singles[a].second, {singles[a].first});
            for (std::size_t b = a + 1; b < singles.size(); ++b)
                if (singles[b].second && singles[a].first.option != singles[b].first.option)
                    consider(*singles[a].second + *singles[b].second, {singles[a].first, singles[b].first});
        }
        std::ranges::stable_sort(trials, {}, &Trial::rank);
        return trials;
    }

    void improve(Path path) {
        std::size_t in_vain = 0;
        while (in_vain < maxInVain) {
            const std::size_t best = bestOf(path);
            std::size_t of_all = best;
            for (const auto& [other, first] : firsts_)
                if (const std::size_t i = bestOf(other); rank(i) < rank(of_all)) of_all = i;
            if (budget_.isForSpeed() && missBy(all_[best]) <= 0 &&
                all_[best].ms() > worthImproving * all_[of_all].ms())
                return;
            std::vector<std::size_t> tried;
            for (const Trial& trial : trialsFrom(best)) {
                if (tried.size() == triedTogether) break;
                const std::optional<Settings> made = options_.combine(all_[best].settings, trial.changes);
                if (!made || std::ranges::find(all_, *made, &Candidate::settings) != all_.end()) continue;
                tried.push_back(all_.size());
                all_.push_back({{.settings = *made}});
            }
            if (tried.empty()) return;
            reportProgress(0.7 + 0.2 * (1 - std::exp(-0.05 * static_cast<double>(all_.size() - known_))),
                           "changes");
            measureTried(tried, best);
            for (const std::size_t i : tried) learnFrom(best, i);
            const std::size_t now = bestOf(path);
            const bool helps = now != best && (!budget_.isForSpeed() || missBy(all_[best]) > 0 ||
                                               all_[now].log_ms < all_[best].log_ms - worthNoticing);
            in_vain = helps ? 0 : in_vain + tried.size();
        }
    }
    // Measures cheaply first: times if the best fits and speed is wanted, else errors. A candidate that
    // fails the first test skips the second.
    void measureTried(const std::vector<std::size_t>& tried, std::size_t best) {
        const double miss = missBy(all_[best]);
        const bool times_first = budget_.isForSpeed() && miss <= 0;
        if (times_first) time(tried, best);
        std::vector<std::size_t> left;
        for (const std::size_t i : tried) {
            if (times_first && all_[i].ms() > worthEvaluating * all_[best].ms()) continue;
            evaluate(i);
            const double error_miss = missOf(all_[i].measured, budget_);
            if (miss > 0 ? error_miss < miss : error_miss <= 0) left.push_back(i);
        }
        if (!times_first) time(left, best);
    }

    void timeBestAgain() {
        while (true) {
            std::vector<std::size_t> fit;
            for (std::size_t i = 0; i < all_.size(); ++i)
                if (all_[i].status == CandidateStatus::fits) fit.push_back(i);
            if (fit.empty()) return;
            std::ranges::stable_sort(fit, {}, [&](std::size_t i) { return rank(i); });
            const Candidate& best = all_[fit.front()];
            std::erase_if(fit, [&](std::size_t i) {
                return budget_.isForSpeed() ? all_[i].ms() > worthTimingAgain * best.ms()
                                            : all_[i][budget_.metric] > alikeErrors * best[budget_.metric];
            });
            fit.resize(std::min(fit.size(), finalists));
            timeAgain(fit);
            if (!budget_.ms || found_.ms <= *budget_.ms) return;
            // The fastest finalist exceeds the time budget, so all do.
            for (const std::size_t i : fit) all_[i].status = CandidateStatus::too_slow;
            static_cast<Race&>(found_) = {};
        }
    }
    void timeAgain(const std::vector<std::size_t>& which) {
        std::vector<Settings> frames;
        for (const std::size_t i : which) frames.push_back(all_[i].settings);
        reportProgress(0.9, "the finalists again");
        const Ranking result = rankByTime(which.size(), [&](std::span<const std::size_t> order) {
            for (const std::size_t k : order) ++all_[which[k]].timings;
            return evaluator_.time(frames, order);
        });
        found_.timings += result.draws;
        static_cast<Race&>(found_) = raceOf(result, which);
        found_.ms = result.ms[result.winner];
        // Shift earlier times to the device's current speed.
        const double shift = std::log(found_.ms) - all_[*found_.chosen].log_ms;
        if (std::abs(shift) >= worthShifting)
            for (Candidate& each : all_) each.log_ms += shift;
        for (std::size_t k = 0; k < which.size(); ++k) {
            const std::size_t i = which[k];
            all_[i].status = CandidateStatus::raced;
            all_[i].measured[Measure::ms] = result.ms[k];
            all_[i].race = result.ratios[k];
        }
    }

    void findNearest() {
        for (std::size_t i = 0; i < all_.size(); ++i)
            if (all_[i].isEvaluated() && (!found_.nearest || missBy(all_[i]) < missBy(all_[*found_.nearest])))
                found_.nearest = i;
        if (found_.nearest) found_.ms = all_[*found_.nearest].ms();
    }

    Evaluator& evaluator_;
    const SearchOptions& options_;
    const Budget& budget_;
    std::vector<Candidate> all_;
    std::size_t known_ = 0;  // candidates of the table
    std::map<Path, std::size_t> firsts_;
    std::map<Change, std::optional<Effect>> effects_;
    SettingsChoice found_;
};

}  // namespace

double Candidate::ms() const {
    if (measured.has(Measure::ms)) return (*this)[Measure::ms];
    return timings > 0 ? std::exp(log_ms) : std::numeric_limits<double>::quiet_NaN();
}

double missOf(const Measures& measured, const Budget& budget) {
    double miss = 0;
    const auto add = [&](double value, double limit) {
        if (value > limit) miss = std::max(miss, value / std::max(limit, 1e-12) - 1);
    };
    if (budget.error) add(measured[budget.metric], *budget.error);
    if (budget.bytes) add(measured[Measure::memory], static_cast<double>(*budget.bytes));
    if (budget.ms) add(measured[Measure::ms], *budget.ms);
    return miss;
}

SettingsChoice search(std::span<const Settings> table, Evaluator& evaluator, const SearchOptions& options) {
    return Search(table, evaluator, options).run();
}

std::optional<std::size_t> bestOfOtherPath(const SettingsChoice& choice, const Budget& budget) {
    if (!choice.chosen) return {};
    const auto value = [&](std::size_t i) {
        const Candidate& candidate = choice.candidates[i];
        return budget.isForSpeed() ? candidate.ms() : candidate[budget.metric];
    };
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < choice.candidates.size(); ++i)
        if (choice.candidates[i].settings.path != choice.candidates[*choice.chosen].settings.path &&
            choice.candidates[i].isFit() && (!best || value(i) < value(*best)))
            best = i;
    return best;
}

}  // namespace diptych::choose
