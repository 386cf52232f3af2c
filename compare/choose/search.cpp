// SPDX-License-Identifier: MIT
#include "compare/choose/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

namespace diptych::choose {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);
constexpr double infinity = std::numeric_limits<double>::infinity();
// An effect on time that is known so well is not measured anew; errors are of a scene and are.
constexpr double knownEffect = 0.15;
// So many standard deviations of its prediction a candidate may be better than predicted.
constexpr double benefit = 2;
// An error that two changes make together may be smaller than the larger of both by so much.
constexpr double together = 0.8;
// By so much, in logarithms, the error of several changes is taken to differ from the sum of what each does,
// until so many were seen.
constexpr double spreadAtFirst = 0.4, seenAtFirst = 4;
// By so much, in logarithms, an estimated error is taken to differ from the judged one, until so many of both
// are known. One camera's of the gallery's two: 0.22 over what forward+ changes, 0.10 over what deferred
// does.
constexpr double estimateAtFirst = 0.2, estimatesAtFirst = 4;
// A change is worth combining if it takes off so much of the time, in logarithms.
constexpr double worthTime = -0.02;
// What is by so much slower than its path's first candidate, in logarithms, no other change makes up for; and
// what is slower by so much is not looked at.
constexpr double hopeless = 0.5, worthJudging = 0.1;
// After so many that fit and were not faster by as much as matters, in logarithms, no more are
// judged.
constexpr double worthNoticing = 0.01;
constexpr std::size_t mostInVain = 16;
constexpr std::size_t changesAtOnce = 3;
// A time this near to its budget, in standard deviations, is timed again, up to so many frames.
constexpr double doubtful = 1;
constexpr std::size_t mostAgain = 8;
// Where nothing fits, so many are judged to find the nearest.
constexpr std::size_t mostForNearest = 8;

// Of two frames of the same passes: what disturbs a frame only lengthens it.
std::vector<PassTime> least(std::vector<PassTime> a, const std::vector<PassTime>& b) {
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) a[i].ms = std::min(a[i].ms, b[i].ms);
    return a;
}

// How far values are from what they were taken for, in logarithms: a deviation that is assumed and counts as
// much as some values do, and those that were seen.
class LearnedSpread {
public:
    LearnedSpread(double deviation, double counts)
        : squares_(deviation * deviation * counts), seen_(counts) {}
    void add(double value, double taken_for) {
        if (!(taken_for > 0) || !std::isfinite(value) || !std::isfinite(taken_for)) return;
        const double off = std::log(std::max(value, 1e-12) / taken_for);
        squares_ += off * off;
        ++seen_;
    }
    double deviation() const { return std::sqrt(squares_ / seen_); }

private:
    double squares_, seen_;
};

class Search {
public:
    Search(std::span<const Settings> settings, Lab& lab, CostModel& model, const SearchOptions& options)
        : lab_(lab), model_(model), options_(options), budget_(options.budget), random_(options.seed) {
        for (const Settings& each : settings) add(each);
    }

    Choice run() {
        measureEffects();
        if (options_.combine) addCombinations();
        if (!budget_.isForSpeed()) {
            findMostAccurate();
        } else {
            findFastest();
            while (isNoneAccurate() && judgeNearest()) findFastest();
        }
        for (std::size_t i = 0; i < all_.size(); ++i) {
            all_[i].predicted = model_.predict(i);
            all_[i].passes = model_.passesOf(i);
            if (all_[i].fate == Fate::fits && all_[i].predicted.log_ms > limit())
                all_[i].fate = Fate::too_slow;
        }
        if (!found_.chosen) findNearest();
        found_.candidates = std::move(all_);
        return std::move(found_);
    }

private:
    void add(const Settings& settings) {
        model_.add(settings);
        all_.push_back({.settings = settings});
    }

    void say(double done, std::string_view what) const {
        if (options_.progress) options_.progress(done, what);
    }

    const Judged& judge(std::size_t i) {
        Candidate& candidate = all_[i];
        if (candidate.judged) return *candidate.judged;
        candidate.judged = lab_.judge(candidate.settings);
        ++found_.judged;
        const bool fits = !(budget_.error && !(candidate.judged->error <= *budget_.error)) &&
                          !(budget_.bytes && candidate.judged->bytes > *budget_.bytes);
        candidate.fate = fits ? Fate::fits : Fate::misses;
        const double error = candidate.judged->error;
        const Path path = candidate.settings.path;
        const std::vector<Change>& changes = model_.changesOf(i);
        if (changes.empty()) {
            first_errors_[path] = error;
        } else if (changes.size() == 1) {
            if (candidate.estimated) estimate_off_.add(error, scaled(path, *candidate.estimated));
            errors_[changes.front()] = error;
            estimated_.erase(changes.front());
        } else if (const std::optional<double> sum = sumOfErrors(i)) {
            sum_off_.add(error, *sum);
        }
        return *candidate.judged;
    }

    // What an estimate of the path's would be in all, if it grew as that of the first candidate does.
    double scaled(Path path, double estimate) const {
        const auto first = first_estimates_.find(path);
        if (first == first_estimates_.end()) return estimate;
        const double factor = first_errors_.at(path) / first->second;
        // Without one where the first candidate's pictures are right or hold no numbers.
        return std::isfinite(factor) && factor > 0 ? estimate * factor : estimate;
    }
    // The error of a candidate with one change at most, about, where that takes less than judging it.
    void estimate(std::size_t i) {
        Candidate& candidate = all_[i];
        const std::vector<Change>& changes = model_.changesOf(i);
        if (candidate.judged && !changes.empty()) return;
        if (changes.size() <= 1) candidate.estimated = lab_.estimate(candidate.settings);
        if (!candidate.estimated) {
            judge(i);
            return;
        }
        ++found_.estimated;
        const Path path = candidate.settings.path;
        if (changes.empty()) {
            first_estimates_[path] = *candidate.estimated;
            return;
        }
        errors_[changes.front()] = scaled(path, *candidate.estimated);
        estimated_.insert(changes.front());
    }

    // Times each twice, in an order and back.
    void time(std::vector<std::size_t> which, std::size_t rounds = 1) {
        std::vector<Settings> frames;
        for (const std::size_t i : which) frames.push_back(all_[i].settings);
        std::vector<std::size_t> order;
        for (std::size_t round = 0; round < rounds; ++round) {
            for (std::size_t k = 0; k < which.size(); ++k) order.push_back(k);
            for (std::size_t k = which.size(); k-- > 0;) order.push_back(k);
        }
        const std::vector<double> times = lab_.time(frames, order);
        for (std::size_t at = 0; at + 1 < times.size(); at += 2 * which.size())
            for (std::size_t k = 0; k < which.size(); ++k) {
                const double forth = times[at + k], back = times[at + 2 * which.size() - 1 - k];
                repeats_.push_back(std::abs(std::log(forth / back)));
            }
        if (repeats_.size() >= 5) {
            std::vector<double> sorted = repeats_;
            const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
            std::ranges::nth_element(sorted, middle);
            // The median of |x - y| of two normal values is 0.954 of one's deviation.
            model_.setNoise(std::clamp(*middle / 0.954, 0.005, 0.5));
        }
        for (std::size_t at = 0; at < times.size(); ++at) {
            model_.observe(which[order[at]], times[at]);
            ++all_[which[order[at]]].timings;
        }
        found_.timings += times.size();
    }

    // What a candidate's changes do to the error if each does the same beside the others; nothing where one's
    // is not known.
    std::optional<double> sumOfErrors(std::size_t i) const {
        const auto first = first_errors_.find(all_[i].settings.path);
        if (first == first_errors_.end()) return {};
        double sum = first->second;
        for (const Change& change : model_.changesOf(i)) {
            const auto error = errors_.find(change);
            if (error == errors_.end()) return {};
            sum += error->second - first->second;
        }
        return std::max(sum, 0.0);
    }
    // The least that this sum leaves open, by how far off it was for others.
    double leastOfSum(std::size_t i) const {
        if (model_.changesOf(i).size() < 2) return 0;
        return sumOfErrors(i).value_or(0) * std::exp(-benefit * sum_off_.deviation());
    }
    // The least and the likely error of a candidate by those of its single changes.
    struct ErrorGuess {
        double least = 0, likely = 0;
    };
    ErrorGuess guess(std::size_t i) const {
        const auto first = first_errors_.find(all_[i].settings.path);
        if (first == first_errors_.end()) return {};
        double most = first->second, down = 0, sum = first->second;
        for (const Change& change : model_.changesOf(i)) {
            const auto error = errors_.find(change);
            if (error == errors_.end()) continue;
            most = std::max(most, error->second);
            down += std::min(error->second - first->second, 0.0);
            sum += error->second - first->second;
        }
        return {std::max(leftOpen(i) * std::max(most + down, 0.0), leastOfSum(i)), std::max(sum, 0.0)};
    }
    // By which the largest error of a candidate's changes may be too large for it.
    double leftOpen(std::size_t i) const {
        const bool is_estimated = std::ranges::any_of(
            model_.changesOf(i), [&](const Change& change) { return estimated_.count(change) > 0; });
        return is_estimated ? std::min(together, std::exp(-benefit * estimate_off_.deviation())) : together;
    }
    bool isSpoilt(std::size_t i) const { return budget_.error && guess(i).least > *budget_.error; }

    // Times the passes of a candidate.
    void profile(std::size_t i, int frames) {
        auto times = lab_.profile(all_[i].settings, frames);
        for (std::size_t repeat = 1; repeat < times.size(); ++repeat)
            times.front() = least(std::move(times.front()), times[repeat]);
        model_.observe(i, times.front());
        all_[i].timings += times.size();
        found_.timings += times.size();
    }

    // How much slower than its path's first candidate, a logarithm.
    double slower(std::size_t i) const {
        return model_.predict(i).log_ms - model_.predict(firsts_.at(all_[i].settings.path)).log_ms;
    }

    // Draws candidates that have a new change each in a random order, so that a drift of the device is no
    // effect of a change; left out is what a known change rules out. Where the fastest is wanted and the
    // first candidate is within the error, passes are timed first, and what makes a frame slower is not
    // looked at; else what is not timed is what exceeds the error by itself.
    void measure(std::vector<std::size_t> which, double from, double to) {
        std::ranges::shuffle(which, random_);
        for (std::size_t k = 0; k < which.size(); ++k) {
            const std::size_t i = which[k];
            say(from + (to - from) * static_cast<double>(k) / static_cast<double>(which.size()), "effects");
            // Where the first candidate exceeds the error, what makes it smaller is wanted at any time.
            const bool is_first_fit = all_[firsts_.at(all_[i].settings.path)].isFit();
            const bool is_for_time = budget_.isForSpeed() && is_first_fit;
            if (is_first_fit && (isSpoilt(i) || (is_for_time && slower(i) > hopeless))) continue;
            if (!is_for_time) estimate(i);
            const bool has_error = all_[i].judged || all_[i].estimated;
            if (has_error && isSpoilt(i)) continue;
            const bool is_known = std::ranges::all_of(
                model_.changesOf(i), [&](const Change& change) { return model_.knows(change, knownEffect); });
            if (!is_known) profile(i, 1);
            if (is_for_time && slower(i) < worthJudging) estimate(i);
        }
    }

    // Of each path its first candidate, and for each change whose effect is not known the candidate with the
    // fewest others.
    void measureEffects() {
        std::vector<std::size_t> order(all_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return model_.changesOf(i).size(); });
        std::vector<std::size_t> firsts;
        for (const std::size_t i : order)
            if (model_.changesOf(i).empty()) firsts.push_back(i);
        for (const std::size_t i : firsts) {
            say(0, "effects");
            firsts_[all_[i].settings.path] = i;
            judge(i);
            estimate(i);
            profile(i, 3);
        }
        time(firsts);
        // By the number of changes, so that what needs another change is left out where that one is hopeless.
        std::map<std::size_t, std::vector<std::size_t>> picks;
        std::set<Change> covered;
        for (const std::size_t i : order) {
            const std::vector<Change>& changes = model_.changesOf(i);
            const bool isNew = std::ranges::any_of(
                changes, [&](const Change& change) { return covered.count(change) == 0; });
            if (!isNew) continue;
            covered.insert(changes.begin(), changes.end());
            picks[changes.size()].push_back(i);
        }
        double from = 0.1;
        for (auto& [changes, level] : picks) {
            const double to = from + 0.5 * (0.6 - from);
            measure(std::move(level), from, to);
            from = to;
        }
    }

    // Combinations of changes that help by themselves, per path.
    void addCombinations() {
        const std::size_t singles = all_.size();
        std::map<Path, std::size_t> firsts;
        std::map<Path, std::vector<Change>> helpful;
        for (std::size_t i = 0; i < singles; ++i) {
            const std::vector<Change>& changes = model_.changesOf(i);
            if (changes.empty()) firsts[all_[i].settings.path] = i;
            if (changes.size() != 1 || isSpoilt(i)) continue;
            const std::size_t first = firsts.at(all_[i].settings.path);
            const double faster = model_.predict(i).log_ms - model_.predict(first).log_ms;
            const auto error = errors_.find(changes.front());
            const auto before = first_errors_.find(all_[i].settings.path);
            const bool better = error != errors_.end() && before != first_errors_.end() &&
                                error->second < before->second / alikeErrors;
            if (faster < worthTime || better) helpful[all_[i].settings.path].push_back(changes.front());
        }
        for (const auto& [path, changes] : helpful) {
            std::vector<Change> taken;
            const Settings first = all_[firsts.at(path)].settings;  // all_ grows
            addCombinations(first, changes, 0, taken);
        }
    }
    void addCombinations(const Settings& first, const std::vector<Change>& changes, std::size_t from,
                         std::vector<Change>& taken) {
        if (taken.size() > 1) {
            const std::optional<Settings> made = options_.combine(first, taken);
            if (!made) return;
            if (std::ranges::find(all_, *made, &Candidate::settings) == all_.end()) add(*made);
        }
        if (taken.size() == changesAtOnce) return;
        for (std::size_t i = from; i < changes.size(); ++i) {
            if (std::ranges::find(taken, changes[i].option, &Change::option) != taken.end()) continue;
            taken.push_back(changes[i]);
            addCombinations(first, changes, i + 1, taken);
            taken.pop_back();
        }
    }

    // Whether no candidate that was judged is within the error and the memory, whatever time it takes.
    bool isNoneAccurate() const {
        return std::ranges::none_of(all_, [](const Candidate& candidate) {
            return candidate.isFit() || candidate.fate == Fate::too_slow;
        });
    }

    // The candidates that are judged and fit, but for their time, the fastest by the model first.
    std::vector<std::size_t> fitting() const {
        std::vector<std::size_t> fit;
        for (std::size_t i = 0; i < all_.size(); ++i)
            if (all_[i].isFit()) fit.push_back(i);
        return fastestFirst(std::move(fit));
    }
    std::vector<std::size_t> fastestFirst(const std::vector<std::size_t>& which) const {
        std::vector<std::pair<double, std::size_t>> times;
        for (const std::size_t i : which) times.emplace_back(model_.predict(i).log_ms, i);
        std::ranges::sort(times);
        std::vector<std::size_t> sorted;
        for (const auto& [time, i] : times) sorted.push_back(i);
        return sorted;
    }
    double leastTime(std::size_t i) const {
        const Prediction prediction = model_.predict(i);
        return prediction.log_ms - benefit * prediction.deviation;
    }

    // Of those that were not judged and may fit, the one that may be the fastest, if that is faster than
    // `best`, a logarithm; `none` where there is none.
    std::size_t mostPromising(double best) {
        std::size_t next = none;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            if (all_[i].judged) continue;
            if (isSpoilt(i)) {
                all_[i].fate = Fate::spoilt;
                continue;
            }
            const double time = leastTime(i);
            if (time >= best) continue;
            best = time;
            next = i;
        }
        return next;
    }

    void findFastest() {
        std::size_t in_vain = 0;  // judged since the last one that was faster
        for (std::size_t seen = 0;; ++seen) {
            std::vector<std::size_t> fit = fitting();
            if (!fit.empty() && all_[fit.front()].timings == 0) {
                time({fit.front()});
                continue;
            }
            const double best = fit.empty() ? infinity : model_.predict(fit.front()).log_ms;
            const std::size_t next = in_vain < mostInVain || fit.empty() ? mostPromising(best) : none;
            if (next == none) break;
            say(0.6 + 0.2 * (1 - 1 / (1 + 0.1 * static_cast<double>(seen))), "candidates");
            judge(next);
            if (all_[next].isFit()) time({next});
            if (!all_[next].isFit()) continue;
            in_vain = model_.predict(next).log_ms < best - worthNoticing ? 0 : in_vain + 1;
        }
        const std::vector<std::size_t> fit = fitting();
        if (fit.empty()) return;
        raceFor(fit);
        tooSlowIfOver();
    }

    // Races those of some that may be the fastest.
    void raceFor(const std::vector<std::size_t>& some) {
        const std::vector<std::size_t> fit = fastestFirst(some);
        const double best = model_.predict(fit.front()).log_ms;
        std::vector<std::size_t> contenders;
        for (const std::size_t i : fit)
            if (contenders.size() < 2 || leastTime(i) - benefit * model_.predict(i).deviation < best)
                contenders.push_back(i);
        contenders.resize(std::min(contenders.size(), std::max<std::size_t>(options_.most_contenders, 1)));
        std::vector<Settings> frames;
        for (const std::size_t i : contenders) frames.push_back(all_[i].settings);
        say(0.8, "race");
        const Race result = race(
            contenders.size(),
            [&](std::span<const std::size_t> order) {
                const std::vector<double> times = lab_.time(frames, order);
                for (std::size_t at = 0; at < order.size(); ++at) {
                    ++all_[contenders[order[at]]].timings;
                    model_.observe(contenders[order[at]], times[at]);
                }
                return times;
            },
            {}, options_.seed + 1);
        found_.timings += result.draws;
        found_.sure = result.sure;
        found_.ties.clear();
        found_.chosen = contenders[result.winner];
        found_.ms = result.standings[result.winner].ms;
        std::optional<std::size_t> second;
        for (std::size_t k = 0; k < contenders.size(); ++k) {
            const Standing& standing = result.standings[k];
            all_[contenders[k]].fate = Fate::raced;
            all_[contenders[k]].standing = standing;
            if (k == result.winner) continue;
            if (!standing.isSlower()) found_.ties.push_back(contenders[k]);
            if (!second || standing.ratio < result.standings[*second].ratio) second = k;
        }
        found_.runner_up = second ? std::optional(contenders[*second]) : std::nullopt;
    }

    // Nothing is chosen where the fastest takes too long.
    void tooSlowIfOver() {
        if (!budget_.ms || found_.ms <= *budget_.ms) return;
        all_[*found_.chosen].fate = Fate::too_slow;
        found_.chosen.reset();
        found_.runner_up.reset();
        found_.ties.clear();
        found_.sure = false;
    }

    double limit() const { return budget_.ms ? std::log(*budget_.ms) : infinity; }
    // Times a candidate until it is known to be within the time or beyond it, or enough.
    bool isInTime(std::size_t i) {
        if (!budget_.ms) return true;
        while (all_[i].timings < mostAgain) {
            const Prediction prediction = model_.predict(i);
            if (all_[i].timings >= 2 &&
                std::abs(prediction.log_ms - limit()) > doubtful * prediction.deviation)
                break;
            time({i}, all_[i].timings < 2 ? 1 : 2);
        }
        const bool isFast = model_.predict(i).log_ms <= limit();
        if (!isFast) all_[i].fate = Fate::too_slow;
        return isFast;
    }

    // Takes a candidate's place where it has a smaller error and is in time. `best`: `none` or one's number.
    void consider(std::size_t i, std::size_t& best) {
        if (!all_[i].isFit() || leastTime(i) > limit()) return;
        if (best != none && all_[i].judged->error >= all_[best].judged->error) return;
        if (isInTime(i)) best = i;
    }

    // Draws candidates for as long as one may be more accurate than the best that is in time, which is
    // returned; `none` where nothing is.
    std::size_t mostAccurateInTime() {
        std::size_t best = none;
        for (std::size_t i = 0; i < all_.size(); ++i) consider(i, best);
        for (std::size_t seen = 0;; ++seen) {
            std::size_t next = none;
            double likely = infinity;
            for (std::size_t i = 0; i < all_.size(); ++i) {
                if (all_[i].judged || leastTime(i) > limit()) continue;
                const ErrorGuess error = guess(i);
                if (best != none && error.least >= all_[best].judged->error) continue;
                if (next != none && error.likely >= likely) continue;
                likely = error.likely;
                next = i;
            }
            if (next == none) return best;
            say(0.6 + 0.2 * (1 - 1 / (1 + 0.1 * static_cast<double>(seen))), "candidates");
            judge(next);
            consider(next, best);
        }
    }

    void findMostAccurate() {
        for (std::size_t best = mostAccurateInTime(); best != none; best = mostAccurateInTime()) {
            std::vector<std::size_t> equals;
            for (std::size_t i = 0; i < all_.size(); ++i)
                if (all_[i].isFit() && (i == best || model_.predict(i).log_ms <= limit()) &&
                    all_[i].judged->error <= all_[best].judged->error * alikeErrors)
                    equals.push_back(i);
            raceFor(equals);
            if (!budget_.ms || found_.ms <= *budget_.ms) return;
            // The fastest of the race is too slow, and so are the others.
            for (const std::size_t i : equals)
                if (all_[i].fate == Fate::raced) all_[i].fate = Fate::too_slow;
            tooSlowIfOver();
        }
    }

    double missBy(const Candidate& candidate) const {
        return missOf(*candidate.judged, candidate.ms(), budget_);
    }
    // Where nothing fits: judges what was estimated alone and may come nearer than all that was judged.
    // Returns whether any of it fits, as an estimate may be farther off than it was taken to be.
    bool judgeNearest() {
        for (std::size_t more = 0; more < mostForNearest; ++more) {
            double nearest = infinity;
            std::size_t next = none;
            for (std::size_t i = 0; i < all_.size(); ++i) {
                if (all_[i].judged) nearest = std::min(nearest, all_[i].judged->error);
                if (!all_[i].judged && all_[i].estimated &&
                    (next == none || guess(i).likely < guess(next).likely))
                    next = i;
            }
            if (next == none || guess(next).likely >= nearest) return false;
            judge(next);
            if (all_[next].isFit()) return true;
        }
        return false;
    }
    void findNearest() {
        for (std::size_t i = 0; i < all_.size(); ++i)
            if (all_[i].judged && (!found_.nearest || missBy(all_[i]) < missBy(all_[*found_.nearest])))
                found_.nearest = i;
        if (found_.nearest) found_.ms = all_[*found_.nearest].ms();
    }

    Lab& lab_;
    CostModel& model_;
    const SearchOptions& options_;
    const Budget& budget_;
    std::mt19937_64 random_;
    std::vector<Candidate> all_;
    std::map<Path, std::size_t> firsts_;
    std::map<Path, double> first_errors_;
    std::map<Change, double> errors_;
    std::map<Path, double> first_estimates_;
    std::set<Change> estimated_;  // of errors_
    LearnedSpread sum_off_{spreadAtFirst, seenAtFirst}, estimate_off_{estimateAtFirst, estimatesAtFirst};
    std::vector<double> repeats_;
    Choice found_;
};

}  // namespace

double missOf(const Judged& judged, std::optional<double> ms, const Budget& budget) {
    double miss = 0;
    const auto add = [&](double value, double limit) {
        if (value > limit) miss = std::max(miss, value / std::max(limit, 1e-12) - 1);
    };
    if (budget.error) add(judged.error, *budget.error);
    if (budget.bytes) add(static_cast<double>(judged.bytes), static_cast<double>(*budget.bytes));
    if (budget.ms && ms) add(*ms, *budget.ms);
    return miss;
}

Choice search(std::span<const Settings> candidates, Lab& lab, CostModel& model,
              const SearchOptions& options) {
    return Search(candidates, lab, model, options).run();
}

}  // namespace diptych::choose
