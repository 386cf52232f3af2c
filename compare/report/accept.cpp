// SPDX-License-Identifier: MIT
#include "compare/report/accept.h"

#include "compare/files/diptych_files.h"
#include "compare/files/linked_file.h"
#include "compare/verdict/rules.h"
#include "shared/image/atomic_file.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/json_text.h"
#include "shared/text/named.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using JsonValue = JsonAt<nlohmann::json>;

// The largest failing difference of a channel over a scene's cameras and pairs.
struct Failing {
    double max = 0;
    std::string pair;
};
using AllFailing = std::map<std::pair<std::string, std::string>, Failing>;  // keys: scene, channel

// Reads only the keys of a report that `accept` needs.
nlohmann::json reportIn(const fs::path& where) {
    static const std::set<std::string> wanted{"software", "comparisons", "scene",   "baseline", "test",
                                              "channels", "name",        "verdict", "max",      "failures"};
    return parseJson(textIn(reportFile(where), json_bytes),
                     [](int, const std::string& key) { return wanted.contains(key); });
}

AllFailing failingOf(const JsonValue& comparisons, const std::string& scene, const std::string& channel) {
    AllFailing all;
    bool met = scene.empty();
    for (const JsonValue& comparison : comparisons.each()) {
        const std::string name = comparison.textOr("scene", "");
        if (!scene.empty() && name != scene) continue;
        met = true;
        for (const JsonValue& of : comparison.at("channels").each()) {
            const std::string its = of.textOr("name", "");
            if (of.textOr("verdict", "") != "fail" || (!channel.empty() && its != channel)) continue;
            if (!of.has("max") || !of.at("max").json().is_number())
                fail(fmt::format("{}, {}: differs by NaN or infinity; no rule can accept that", name, its));
            Failing& failing = all[{name, its}];
            if (of.at("max").number() < failing.max) continue;
            failing = {of.at("max").number(), fmt::format("{} against {}", comparison.textOr("test", ""),
                                                          comparison.textOr("baseline", ""))};
        }
        if (!comparison.has("failures") || !channel.empty()) continue;
        if (const std::vector<std::string> failures = comparison.at("failures").texts(); !failures.empty())
            fail(fmt::format("{}: fails as a whole, not in one channel; no rule can accept that: {}", name,
                             failures.front()));
    }
    if (!met) fail(fmt::format("accept {}: the report has no such scene", scene));
    if (all.empty())
        fail(fmt::format("accept{}{}: nothing fails, so there is nothing to accept",
                         scene.empty() ? "" : " " + scene, channel.empty() ? "" : " --channel " + channel));
    return all;
}

AllFailing failingIn(const fs::path& where, const std::string& scene, const std::string& channel) {
    const nlohmann::json json = named("accept " + where.string(), [&] {
        nlohmann::json report = reportIn(where);
        const JsonValue top(report);
        if (top.textOr("software", "") != softwareName || !top.has("comparisons"))
            fail("is not a report written by compare; give its folder or its report.json");
        return report;
    });
    return failingOf(JsonValue(json).at("comparisons"), scene, channel);
}

// Rules of an existing file; none if there is no file.
Json acceptedRulesIn(const fs::path& file) {
    if (!fs::exists(file)) return {{"rules", Json::array()}};
    readRules(file);  // throws if the file is not a rules file
    return orderedJsonIn(file);
}

}  // namespace

std::size_t acceptDifferences(const Acceptance& accepted, const fs::path& out) {
    Json rules = acceptedRulesIn(out);
    const AllFailing failing = failingIn(accepted.report, accepted.scene, accepted.channel);
    for (const auto& [of, how] : failing) {
        const auto& [name, channel] = of;
        auto& all = rules["rules"];
        all.erase(std::remove_if(all.begin(), all.end(),
                                 [&, &n = name, &c = channel](const Json& rule) {
                                     return rule.value("scene", "") == n && rule.value("channel", "") == c;
                                 }),
                  all.end());
        const std::string because = fmt::format("accepted: {} as in {}", how.pair, accepted.report.string());
        all.push_back({{"scene", name},
                       {"channel", channel},
                       {"max", how.max},
                       {"because", accepted.because.empty() ? because : accepted.because}});
    }
    writeFile(linkedFile(out), jsonText(rules) + "\n");
    return failing.size();
}

}  // namespace diptych
