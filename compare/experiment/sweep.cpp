// SPDX-License-Identifier: MIT
#include "compare/experiment/sweep.h"

#include "compare/verdict/baseline.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace diptych::experiment {
namespace {

constexpr std::string_view each = "*";

std::vector<std::string> sweptOptions() {
    std::vector<std::string> options;
    for (const Field& field : settingFields())
        if (!field.sweep.empty()) options.emplace_back(field.option);
    return options;
}

std::pair<std::string, std::vector<std::string>> axis(const Settings& requested, std::string_view option) {
    return {std::string(option), sweptValues(requested, option)};
}

// Adds a start for every combination of the Settings that sweepPairs() crosses with all others. The other
// Settings are varied from every start.
void addStarts(const Settings& requested, std::vector<Settings>& starts) {
    starts.push_back(requested);
    for (const SweepPair& pair : sweepPairs()) {
        if (pair.b != each) continue;
        const std::vector<Settings> before = starts;
        for (const Settings& start : before)
            for (const std::string& value : sweptValues(requested, pair.a)) {
                Settings other = start;
                other.set(pair.a, value);
                if (std::ranges::count(starts, other) == 0 && !isReference(other.path) &&
                    !effectiveSettings(other).problem())
                    starts.push_back(other);
            }
    }
}

bool isCrossedWithEach(std::string_view option) {
    return std::ranges::any_of(sweepPairs(),
                               [&](const SweepPair& pair) { return pair.b == each && pair.a == option; });
}

// Inputs of specular anti-aliasing.
auto filterOf(const Settings& s) {
    return std::tuple(s.spec_aa, s.spec_aa_variance, s.spec_aa_limit, s.spec_aa_normals, s.spec_aa_kernel);
}

class SweepBuilder {
public:
    explicit SweepBuilder(const Settings& requested) : requested_(requested) {}

    void add(const std::vector<Change>& choices) {
        Settings requested = requested_;
        for (const auto& [option, value] : choices) requested.set(option, value);
        const std::vector<Change> tried = changed(requested);
        if (isReference(requested.path))
            return skip({{"path", "reference"}}, "is the reference that all rows are compared with");
        for (const auto& [option, value] : tried)
            if (const std::string_view why = ignoredBecause(requested, option); !why.empty())
                skip({{"path", std::string(nameOf(requested.path))}, {option, value}}, std::string(why));
        // Without multiple scattering the reference uses another model.
        if (requested_.multiscatter == Multiscatter::off && requested.multiscatter != Multiscatter::off)
            return skip(tried, "needs a reference with multiple scattering: add --multiscatter energy");
        // A reference with one sample per pixel cannot show a benefit of filtering.
        if (requested_.reference_mode == ReferenceMode::surface &&
            filterOf(requested) != filterOf(requested_))
            return skip(tried,
                        "needs a reference that samples the scene: add --reference-mode scene and --spp");
        const Settings row = effectiveSettings(requested);
        if (row.msaa > 1 && row.resolve != requested_.resolve)
            return skip(tried, fmt::format("needs a reference with the same resolve: add --resolve {}",
                                           nameOf(row.resolve)));
        if (const std::string why = samplesProblem(referenceSettings(requested_), row); !why.empty())
            return skip({{"path", std::string(nameOf(row.path))}, {"msaa", row.valueOf("msaa")}}, why);
        if (const auto problem = row.problem()) return skip(tried, *problem);
        if (std::ranges::count(sweep_.rows, row) == 0) sweep_.rows.push_back(row);
    }
    SweepRows done() { return std::move(sweep_); }

private:
    std::vector<Change> changed(const Settings& requested) const {
        std::vector<Change> choices;
        for (const Field& field : settingFields()) {
            const std::string value = requested.valueOf(field.option);
            if (field.option == "path" || value != requested_.valueOf(field.option))
                choices.push_back({std::string(field.option), value});
        }
        return choices;
    }
    // Omits skips whose combination extends one with the same reason.
    void skip(const std::vector<Change>& tried, const std::string& reason) {
        const auto covers = [&](const SweepSkip& skip) {
            return skip.reason == reason && std::ranges::all_of(skip.tried, [&](const Change& choice) {
                       return std::ranges::count(tried, choice) > 0;
                   });
        };
        if (std::ranges::none_of(sweep_.skips, covers)) sweep_.skips.push_back({tried, reason});
    }

    const Settings& requested_;
    SweepRows sweep_;
};

// Adds the product of the grid; the last Setting varies fastest.
void addProduct(const Grid& grid, SweepBuilder& builder) {
    std::vector<std::size_t> at(grid.size(), 0);
    for (std::size_t digit = 1; digit > 0;) {
        std::vector<Change> choices;
        for (std::size_t i = 0; i < grid.size(); ++i)
            choices.push_back({grid[i].first, grid[i].second[at[i]]});
        builder.add(choices);
        for (digit = grid.size(); digit > 0; at[--digit] = 0)
            if (++at[digit - 1] < grid[digit - 1].second.size()) break;
    }
}

// A skip's reason without the tried value and the suggestion, so that it is equal for all values.
// "--msaa-edges all has no effect without --msaa 4; use exact" becomes "has no effect without --msaa 4".
struct Cause {
    std::string reason, option, value;  // no option: the whole combination
};

Cause causeOf(const SweepSkip& skip) {
    for (const auto& [option, value] : skip.tried) {
        const std::string named = fmt::format("--{} {}", option, value);
        if (!skip.reason.starts_with(named + " ")) continue;
        const std::string rest = skip.reason.substr(named.size() + 1);
        return {rest.substr(0, rest.rfind("; use ")), option, value};
    }
    const bool single = skip.tried.size() == 2 && skip.tried.front().option == "path";
    return single ? Cause{skip.reason, skip.tried.back().option, skip.tried.back().value}
                  : Cause{skip.reason, "", describe(skip.tried)};
}

}  // namespace

std::vector<Grid> defaultGrids(const Settings& requested) {
    std::vector<Settings> starts;
    addStarts(requested, starts);
    // A grid with the start's values.
    const auto from = [&](const Settings& start) {
        Grid grid;
        for (const SweepPair& pair : sweepPairs())
            if (pair.b == each) grid.push_back({std::string(pair.a), {start.valueOf(pair.a)}});
        return grid;
    };
    std::vector<Grid> grids;
    for (const Settings& start : starts) grids.push_back(from(start));
    for (const std::string& option : sweptOptions())
        if (isCrossedWithEach(option)) grids.push_back({axis(requested, option)});
    for (const Settings& start : starts)
        for (const std::string& option : sweptOptions()) {
            if (isCrossedWithEach(option)) continue;
            grids.push_back(from(start));
            grids.back().push_back(axis(requested, option));
        }
    for (const Settings& start : starts)
        for (const SweepPair& pair : sweepPairs()) {
            if (pair.b == each || !ignoredBecause(start, pair.a).empty() ||
                !ignoredBecause(start, pair.b).empty())
                continue;
            grids.push_back(from(start));
            for (const std::string_view option : {pair.a, pair.b})
                grids.back().push_back(axis(requested, option));
        }
    return grids;
}

SweepRows makeSweepRows(const Settings& requested, const std::vector<Grid>& grids) {
    double combinations = 0;
    for (const Grid& grid : grids) {
        double product = 1;
        for (const auto& [option, values] : grid) product *= static_cast<double>(values.size());
        combinations += product;
    }
    if (combinations > static_cast<double>(maxCombinations))
        throw std::runtime_error(fmt::format(
            "--grid: {:.4g} combinations, more than the {} of one sweep; split it into several sweeps",
            combinations, maxCombinations));
    SweepBuilder builder(requested);
    for (const Grid& grid : grids) addProduct(grid, builder);
    SweepRows sweep = builder.done();
    if (sweep.rows.empty())
        throw std::runtime_error(sweep.skips.empty() ? "--grid: holds no combination of settings"
                                                     : fmt::format("nothing to sweep: {}: {}",
                                                                   describe(sweep.skips.front().tried),
                                                                   sweep.skips.front().reason));
    return sweep;
}

SweepRows withoutRefused(SweepRows sweep, const Settings& requested,
                         const std::function<std::optional<std::string>(const Settings&)>& problem) {
    std::vector<Settings> drawn;
    for (Settings& row : sweep.rows)
        if (const auto why = problem(row))
            sweep.skips.push_back({changesOf(row, requested), *why});
        else
            drawn.push_back(std::move(row));
    sweep.rows = std::move(drawn);
    if (sweep.rows.empty()) throw std::runtime_error("nothing to sweep: " + sweep.skips.back().reason);
    return sweep;
}

std::vector<Change> changesOf(const Settings& row, const Settings& requested) {
    std::vector<Change> choices{{"path", std::string(nameOf(row.path))}};
    for (const Field& field : settingFields()) {
        const std::string value = row.valueOf(field.option);
        if (field.option != "path" && value != requested.valueOf(field.option) &&
            ignoredBecause(row, field.option).empty())
            choices.push_back({std::string(field.option), value});
    }
    return choices;
}

std::string describe(const std::vector<Change>& choices) {
    std::string text;
    for (const auto& [option, value] : choices)
        text += (text.empty() ? "" : ", ") + (option == "path" ? value : option + " " + value);
    return text;
}

Settings referenceFor(const Settings& requested, const std::vector<Settings>& rows) {
    const auto shadowed = [](const Settings& row) { return row.shadows != Shadows::off; };
    Settings truth = requested;
    if (const auto row = std::ranges::find_if(rows, shadowed); !shadowed(requested) && row != rows.end())
        truth.shadows = row->shadows;
    if (std::ranges::any_of(rows, [](const Settings& row) { return row.multiscatter != Multiscatter::off; }))
        truth.multiscatter = Multiscatter::walk;
    // Ray marching has two scale heights and attenuates the sun; the closed form simplifies both.
    const auto marched = [](const Settings& row) { return row.haze_march_steps > 0; };
    if (const auto row = std::ranges::find_if(rows, marched); row != rows.end())
        truth.haze_march_steps = row->haze_march_steps;
    return truth;
}

std::vector<SkipGroup> groupsOf(const std::vector<SweepSkip>& skips) {
    std::vector<Cause> causes;
    for (const SweepSkip& skip : skips) causes.push_back(causeOf(skip));
    std::vector<SkipGroup> groups;
    for (const Cause& cause : causes) {
        if (std::ranges::count(groups, cause.reason, &SkipGroup::reason) > 0) continue;
        SkipGroup group{cause.reason, {}};
        std::vector<std::pair<std::string, std::vector<std::string>>> values;  // key: option
        for (const Cause& other : causes) {
            if (other.reason != cause.reason) continue;
            auto known = std::ranges::find(values, other.option, [](const auto& v) { return v.first; });
            if (known == values.end()) known = values.insert(values.end(), {other.option, {}});
            if (std::ranges::count(known->second, other.value) == 0) known->second.push_back(other.value);
        }
        for (const auto& [option, tried] : values)
            if (option.empty())
                group.tried.insert(group.tried.end(), tried.begin(), tried.end());
            else
                group.tried.push_back(fmt::format("{} {}", option, fmt::join(tried, "|")));
        groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace diptych::experiment
