// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/run/print.h"
#include "compare/verdict/rules.h"
#include "shared/image/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A channel of a scene that fails, in whichever camera and pair most.
struct Failing {
    double max = 0;
    std::string pair;
};
using AllFailing = std::map<std::pair<std::string, std::string>, Failing>;  // by scene and channel

// The comparisons of a report, without what is large and says nothing here.
nlohmann::json comparisonsOf(const fs::path& where) {
    std::error_code ignored;
    const fs::path file = fs::is_directory(where, ignored) ? where / "report.json" : where;
    std::ifstream stream(file, std::ios::binary);
    static const std::set<std::string> left_out{"frames", "explanation", "marks", "figures",
                                                "notes",  "truth",       "files"};
    const nlohmann::json json = nlohmann::json::parse(
        stream,
        [](int, nlohmann::json::parse_event_t event, nlohmann::json& value) {
            return event != nlohmann::json::parse_event_t::key ||
                   !left_out.contains(value.get<std::string>());
        },
        false);
    if (!json.is_object() || json.value("software", "") != softwareName || !json.contains("comparisons"))
        throw std::runtime_error(fmt::format(
            "accept {}: is no report that compare wrote; give its folder or report.json", where.string()));
    return json["comparisons"];
}

AllFailing failingOf(const nlohmann::json& comparisons, const std::string& scene,
                     const std::string& channel) {
    AllFailing all;
    bool met = scene.empty();
    for (const nlohmann::json& comparison : comparisons) {
        const std::string name = comparison.value("scene", "");
        if (!scene.empty() && name != scene) continue;
        met = true;
        for (const nlohmann::json& of : comparison.value("channels", nlohmann::json::array())) {
            const std::string its = of.value("name", "");
            if (of.value("verdict", "") != "fail" || (!channel.empty() && its != channel)) continue;
            if (!of.contains("max") || !of["max"].is_number())
                throw std::runtime_error(
                    fmt::format("{}, {}: differs by NaN or infinity, which no rule can grant", name, its));
            Failing& failing = all[{name, its}];
            if (of["max"] < failing.max) continue;
            failing = {of["max"], fmt::format("{} against {}", comparison.value("test", ""),
                                              comparison.value("baseline", ""))};
        }
        if (const auto failures = comparison.value("failures", nlohmann::json::array());
            !failures.empty() && channel.empty())
            throw std::runtime_error(
                fmt::format("{}: fails by what is no channel's and cannot be accepted: {}", name,
                            failures.front().get<std::string>()));
    }
    if (!met) throw std::runtime_error(fmt::format("accept {}: the report has no such scene", scene));
    if (all.empty())
        throw std::runtime_error(fmt::format("accept{}{}: nothing fails there",
                                             scene.empty() ? "" : " " + scene,
                                             channel.empty() ? "" : " --channel " + channel));
    return all;
}

// An earlier file's rules stay, but for one that was accepted for the same before.
Json rulesIn(const fs::path& file) {
    if (!fs::exists(file)) return {{"rules", Json::array()}};
    readRules(file);  // throws where they are none
    std::ifstream stream(file, std::ios::binary);
    return Json::parse(stream);
}

}  // namespace

int runAccept(const Options& options) {
    if (!options.scene_given || options.scenes.size() > 2)
        throw std::runtime_error(
            "accept: give a report, and one of its scenes or none for all, as accept report Box.glb");
    const fs::path report = options.scenes.front();
    const std::string scene = options.scenes.size() > 1 ? options.scenes[1] : "";
    const fs::path out = options.out.empty() ? "accepted.json" : options.out;
    if (out.extension() != ".json")
        throw std::runtime_error(fmt::format("-o {}: rules are a .json file", out.string()));
    Json rules = rulesIn(out);
    const AllFailing failing = failingOf(comparisonsOf(report), scene, options.accept.channel);
    for (const auto& [of, how] : failing) {
        const auto& [name, channel] = of;
        auto& all = rules["rules"];
        all.erase(std::remove_if(all.begin(), all.end(),
                                 [&, &n = name, &c = channel](const Json& rule) {
                                     return rule.value("scene", "") == n && rule.value("channel", "") == c;
                                 }),
                  all.end());
        all.push_back({{"scene", name},
                       {"channel", channel},
                       {"max", how.max},
                       {"because", options.accept.because.empty()
                                       ? fmt::format("accepted as {} was in {}", how.pair, report.string())
                                       : options.accept.because}});
    }
    writeFile(linkedFile(out), rules.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    if (!options.quiet)
        printOut("{}: {} rule{} written; compare --tolerances {} holds to {}\n", out.string(), failing.size(),
                 failing.size() == 1 ? "" : "s", out.string(), failing.size() == 1 ? "it" : "them");
    return 0;
}

}  // namespace diptych::cli
