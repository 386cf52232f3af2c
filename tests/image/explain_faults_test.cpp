// SPDX-License-Identifier: MIT
// How often an explanation names an injected fault: over fifty single faults, each in several views that are
// sensitive to it (a campaign: twenty), and pairs of them.
#include "tests/image/injected_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace diptych::tests {
namespace {

// Number of views for each fault and each pair: a campaign's rates are statistics, the others find a cause
// that is no longer named.
const std::size_t minCases = isCampaign() ? 20 : 4, minPairCases = isCampaign() ? 10 : 3;

bool isAmong(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::count(names, name) > 0;
}

// The contributions and the unexplained part add up to the difference, also for FLIP, and so do their maps at
// every pixel.
bool addsUp(const Explanation& e, const Image& baseline, const Image& test) {
    double all = e.unexplained, flip = e.flip_unexplained;
    for (const Cause& cause : e.causes) all += cause.contribution, flip += cause.flip;
    if (std::abs(all - e.distance) > 1e-6 * e.distance) return false;
    if (std::abs(flip - e.flip) > 1e-6 * e.flip) return false;
    for (std::size_t p = 0; p < baseline.pixels(); ++p) {
        double difference = 0, sum = double{e.unexplained_map.pixel(p)[0]}, size = std::abs(sum);
        for (int c = 0; c < 3; ++c)
            difference += std::abs(double{baseline.pixel(p)[c]} - test.pixel(p)[c]) / 3;
        for (const Cause& cause : e.causes) {
            sum += double{cause.map.pixel(p)[0]};
            size += std::abs(double{cause.map.pixel(p)[0]});
        }
        // Float rounding, and exposure divided out of lit and reapplied.
        if (std::abs(sum - difference) > 1e-6 * (size + e.distance)) return false;
    }
    return true;
}

std::string listed(const Explanation& e) {
    std::string text;
    for (const Cause& cause : e.causes) {
        text += fmt::format("{} {:.1f} %, ", cause.name, 100 * e.fractionOf(cause.contribution));
        for (const CausePart& light : cause.lights)
            text += fmt::format("({} {:.1f} %) ", light.name, 100 * e.fractionOf(light.contribution));
    }
    return text + fmt::format("unexplained {:.1f} %", 100 * e.fractionOf(e.unexplained));
}

struct Tally {
    std::size_t cases = 0, named = 0;
    double fraction = 0;  // sum over the named ones
    std::string missed{};

    double rate() const { return cases > 0 ? static_cast<double>(named) / static_cast<double>(cases) : 0.0; }
    void count(const InjectedView& view, const Explanation& e, bool is_named, double of) {
        ++cases;
        named += is_named ? 1 : 0;
        fraction += is_named ? of : 0;
        if (!is_named) missed += fmt::format("\n  {}: {}", view.name, listed(e));
    }
    std::string row(const std::string& name) const {
        return fmt::format("{:<62} {:>3} {:>5.0f} % {:>7.1f} %\n", name, cases, 100 * rate(),
                           named > 0 ? 100 * fraction / static_cast<double>(named) : 0.0);
    }
};

// Each single fault is named first in 95 % of the views that are sensitive to it.
TEST(ExplainFaults, ASingleFaultIsNamedFirst) {
    const std::vector<InjectedFault>& faults = injectedFaults();
    ASSERT_GE(faults.size(), 50u);
    std::string table = fmt::format("{:<62} {:>3} {:>7} {:>9}\n", "fault", "in", "named", "its share");
    for (const InjectedFault& fault : faults) {
        Tally tally;
        for (std::size_t i = 0; InjectedView* const view = injectedView(fault.kind, i); ++i) {
            if (tally.cases == minCases) break;
            const Frame test = view->with(fault);
            const Image &a = view->right.channels.at(Channel::lit), &b = test.channels.at(Channel::lit);
            if (!differsVisibly(a, b)) continue;
            const Explanation e = view->explained(test);
            const bool named = !e.causes.empty() && isAmong(fault.named, e.causes.front().name);
            tally.count(*view, e, named, named ? e.fractionOf(e.causes.front().contribution) : 0.0);
            EXPECT_TRUE(addsUp(e, a, b)) << fault.means << " in " << view->name << ": " << listed(e);
        }
        table += tally.row(fault.means);
        EXPECT_GE(tally.cases, minCases) << fault.means;
        EXPECT_GE(tally.rate(), 0.95) << fault.means << tally.missed;
    }
    fmt::print("{}", table);
    EXPECT_EQ(device().validationMessages(), 0u) << device().firstValidationMessage();
}

// The light with the fault has the largest part of its causes' contributions.
TEST(ExplainFaults, TheLightIsNamedToo) {
    for (const InjectedFault& fault : injectedFaults()) {
        if (!fault.of_first_light) continue;
        Tally tally;
        for (std::size_t i = 0; InjectedView* const view = injectedView(fault.kind, i); ++i) {
            if (tally.cases == minCases) break;
            if (!view->feels(fault)) continue;
            const Explanation e = view->explained(view->with(fault));
            std::map<std::string, double> parts;
            for (const Cause& cause : e.causes)
                for (const CausePart& light : cause.lights)
                    parts[light.name + std::to_string(light.index)] += light.contribution;
            const auto max =
                std::ranges::max_element(parts, {}, [](const auto& part) { return part.second; });
            const bool named = max != parts.end() && max->first.starts_with(firstLight);
            tally.count(*view, e, named, named ? e.fractionOf(max->second) : 0.0);
        }
        fmt::print("{}", tally.row(fault.means + ": which light"));
        EXPECT_GE(tally.cases, minCases) << fault.means;
        EXPECT_GE(tally.rate(), 0.9) << fault.means << tally.missed;
    }
}

// Two faults, each visible alone. `sign`: of their interaction, if known: -1 if one makes the other
// redundant, 1 if each hides the other.
struct InjectedPair {
    const char *first, *second;
    int sign = 0;
};

constexpr InjectedPair injectedPairs[] = {
    {"normals of 5 bits", "albedo of 4 bits"},
    {"normals with y and z swapped", "roughness inverted: glossiness"},
    {"normals flattened", "the specular lobe lacks its 4"},
    {"roughness squared twice", "occlusion left out"},
    {"roughness squared twice", "ambient light is doubled"},
    {"roughness at least 0.6", "haze is left out"},
    {"metallic of plastic", "emission left out"},
    {"albedo sRGB taken for linear", "haze takes no light"},
    {"albedo as BGR", "emission clamped at 1"},
    {"albedo decoded twice", "shadow bias is tripled"},
    {"emission doubled", "a light is dropped"},
    {"emission as BGR", "there are no shadows"},
    {"occlusion inverted", "points and spots cast no shadows"},
    {"position 5 cm off", "lit is BGR"},
    {"ambient light is left out", "the specular lobe is left out"},
    {"a light is dropped from one tile", "exposure is doubled"},
    {"exposure is doubled", "roughness squared twice"},
    {"exposure is halved", "ambient light is left out"},
    {"exposure is a third of a stop off", "a light is dropped"},
    {"emission is missing from the sum", "albedo of 4 bits"},
    {"an environment is turned by 90 degrees", "albedo as BGR"},
    {"an environment is turned by 180 degrees", "blended surfaces are left out"},
    // Both brighten lit by a factor: correcting either removes most of it.
    {"albedo sRGB taken for linear", "exposure is doubled", -1},
    {"emission doubled", "exposure is doubled", -1},
    {"occlusion left out", "ambient light is doubled", -1},
    {"the diffuse lobe lacks its pi", "exposure is doubled", -1},
    // One restores what the other removes.
    {"albedo decoded twice", "the diffuse lobe lacks its pi", 1},
    {"the diffuse lobe lacks its pi", "exposure is halved", 1},
    {"albedo decoded twice", "exposure is doubled", 1},
    {"occlusion squared", "ambient light is doubled", 1},
    {"emission doubled", "emission is missing from the sum", 1},
};

// The two causes with the largest absolute contributions.
std::vector<std::string> largestTwo(const Explanation& e) {
    std::vector<std::pair<double, std::string>> fractions;
    for (const Cause& cause : e.causes) fractions.emplace_back(std::abs(cause.contribution), cause.name);
    std::ranges::stable_sort(fractions, [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min<std::size_t>(2, fractions.size()); ++i)
        names.push_back(fractions[i].second);
    return names;
}

// One of the two names belongs to each fault.
bool areBoth(const std::vector<std::string>& two, const InjectedFault& first, const InjectedFault& second) {
    return two.size() == 2 && ((isAmong(first.named, two[0]) && isAmong(second.named, two[1])) ||
                               (isAmong(first.named, two[1]) && isAmong(second.named, two[0])));
}

double interactionOf(const Explanation& e, const InjectedFault& first, const InjectedFault& second) {
    for (const CausePair& pair : e.pairs)
        if (areBoth({e.causes[pair.first].name, e.causes[pair.second].name}, first, second))
            return pair.interaction;
    return 0;
}

// Both of two faults are named by the two largest contributions or as an interacting pair; including
// redundant and cancelling faults.
TEST(ExplainFaults, BothOfTwoFaultsAreNamed) {
    ASSERT_GE(std::size(injectedPairs), 20u);
    std::string table = fmt::format("{:<92} {:>3} {:>6}   {}\n", "pair", "in", "named", "interaction");
    for (const InjectedPair& pair : injectedPairs) {
        const InjectedFault &first = injectedFault(pair.first), &second = injectedFault(pair.second);
        const ViewKind kind = first.kind == ViewKind::blended ? first.kind : second.kind;
        Tally tally;
        std::size_t redundant = 0, hiding = 0;
        for (std::size_t i = 0; InjectedView* const view = injectedView(kind, i); ++i) {
            if (tally.cases == minPairCases) break;
            if (!view->feels(first) || !view->feels(second)) continue;
            const std::array<const InjectedFault*, 2> both{&first, &second};
            const Explanation e = view->explained(view->with(both));
            const double interaction = interactionOf(e, first, second);
            redundant += interaction < 0 ? 1 : 0;
            hiding += interaction > 0 ? 1 : 0;
            tally.count(*view, e, areBoth(largestTwo(e), first, second) || interaction != 0, 0);
        }
        table += fmt::format("{:<92} {:>3} {:>4.0f} %   {} redundant, {} hide each other\n",
                             fmt::format("{} + {}", pair.first, pair.second), tally.cases, 100 * tally.rate(),
                             redundant, hiding);
        EXPECT_GE(tally.cases, minPairCases) << pair.first << " + " << pair.second;
        EXPECT_GE(tally.rate(), 0.9) << pair.first << " + " << pair.second << tally.missed;
        if (pair.sign != 0) {
            EXPECT_GE(10 * (pair.sign < 0 ? redundant : hiding), 9 * tally.cases)
                << pair.first << " + " << pair.second;
        }
    }
    fmt::print("{}", table);
}

TEST(ExplainFaults, IdenticalFramesHaveNoCause) {
    for (const ViewKind kind : {ViewKind::opaque, ViewKind::blended})
        for (std::size_t i = 0; i < minCases; ++i) {
            InjectedView* const view = injectedView(kind, i);
            const Explanation e = view->explained(view->right);
            EXPECT_EQ(e.distance, 0) << view->name;
            EXPECT_TRUE(e.causes.empty()) << view->name;
        }
}

}  // namespace
}  // namespace diptych::tests
