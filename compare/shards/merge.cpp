// SPDX-License-Identifier: MIT
#include "compare/shards/merge.h"

#include "shared/image/file_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace diptych::shards {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Found {
    fs::path folder;
    Manifest manifest;
    std::string identity;  // of the command: build and plan
};

std::string shortened(std::string text) {
    constexpr std::size_t max = 60;
    return text.size() <= max ? text : text.substr(0, max) + "...";
}

// Describes how another manifest differs from the first.
std::string differenceOf(const Manifest& other, const Manifest& first) {
    if (other.build != first.build)
        return fmt::format("is from another build ({}; the others are from {})", other.build, first.build);
    if (other.command != first.command)
        return fmt::format("is from {}, the others are from {}", other.command, first.command);
    if (other.shard.count != first.shard.count)
        return fmt::format("is one of {} shards, the others of {}", other.shard.count, first.shard.count);
    for (const auto& [key, value] : first.plan.items()) {
        const Json there = other.plan.contains(key) ? other.plan[key] : Json();
        if (there == value) continue;
        if (key == "scenes") {
            std::set<std::string> mine, theirs;
            for (const Item& item : first.items) mine.insert(item.scene);
            for (const Item& item : other.items) theirs.insert(item.scene);
            for (const std::string& scene : theirs)
                if (!mine.contains(scene)) return fmt::format("has another scene: {}", scene);
            for (const std::string& scene : mine)
                if (!theirs.contains(scene)) return fmt::format("lacks the scene {}", scene);
            return "has scene files of other sizes";
        }
        // For Settings: the first that differs.
        if (value.is_object() && there.is_object())
            for (const auto& [name, setting] : value.items())
                if (!there.contains(name) || there[name] != setting)
                    return fmt::format("has another {}: {} (the others: {})", name,
                                       shortened(there.value(name, Json()).dump()),
                                       shortened(setting.dump()));
        return fmt::format("has another {}: {} (the others: {})", key, shortened(there.dump()),
                           shortened(value.dump()));
    }
    return "is from another command";
}

// The most common identity; ties go to the first folder.
std::string chosenOf(const std::vector<Found>& all) {
    std::map<std::string, std::size_t> counts;
    for (const Found& found : all) ++counts[found.identity];
    const Found* best = &all.front();
    for (const Found& found : all)
        if (counts[found.identity] > counts[best->identity]) best = &found;
    return best->identity;
}

}  // namespace

std::optional<SceneError> Chosen::errorOf(const Item& item) const {
    if (!folders.contains(item.shard))
        return SceneError{item.scene, fmt::format("belongs to shard {}/{}, which is missing", item.shard,
                                                  manifest.shard.count)};
    const auto& all = errors.at(item.shard);
    const auto error = std::ranges::find(all, item.scene, &SceneError::scene);
    return error == all.end() ? std::nullopt : std::optional(*error);
}

Chosen choose(const std::vector<fs::path>& folders, const char* file) {
    Chosen chosen;
    std::vector<Found> all;
    for (const fs::path& folder : folders) {
        Found found{folder, {}, {}};
        try {
            found.manifest = readManifest(folder, file);
        } catch (const std::runtime_error& error) {
            chosen.problems.emplace_back(error.what());  // its scenes may be reported as missing too
            continue;
        }
        found.identity =
            found.manifest.build + "\n" + found.manifest.command + "\n" + planHash(found.manifest.plan);
        all.push_back(std::move(found));
    }
    if (all.empty()) throw std::runtime_error(chosen.problems.front());
    // Makes the result independent of the command line's order.
    std::ranges::stable_sort(all, {}, &Found::folder);
    const std::string identity = chosenOf(all);
    for (const Found& found : all) {
        if (found.identity != identity) continue;
        if (chosen.folders.empty()) chosen.manifest = found.manifest;
        const Shard& shard = found.manifest.shard;
        const auto [at, fresh] = chosen.folders.emplace(shard.index, found.folder);
        if (fresh)
            chosen.errors[shard.index] = found.manifest.errors;
        else
            chosen.problems.push_back(
                fmt::format("{}: shard {}/{} exists twice, also in {}; the first is used",
                            found.folder.string(), shard.index, shard.count, at->second.string()));
    }
    for (const Found& found : all)
        if (found.identity != identity)
            chosen.problems.push_back(fmt::format("{}: {}; it is ignored", found.folder.string(),
                                                  differenceOf(found.manifest, chosen.manifest)));
    const int count = chosen.manifest.shard.count;
    for (int index = 1; index <= count; ++index)
        if (!chosen.folders.contains(index))
            chosen.problems.push_back(fmt::format(
                "shard {}/{} is missing; give its folder, or run --shard {}/{}", index, count, index, count));
    chosen.manifest.errors.clear();
    return chosen;
}

Joined join(const std::vector<fs::path>& folders) {
    Joined joined;
    Chosen chosen = choose(folders, shardManifest);
    for (const Item& item : chosen.manifest.items) {
        if (const std::optional<SceneError> error = chosen.errorOf(item)) {
            joined.report.errors.push_back(*error);
            continue;
        }
        const fs::path& from = chosen.folders.at(item.shard);
        try {
            joined.report.parts.push_back({readPart(from, item.folder), from});
        } catch (const std::runtime_error& problem) {
            chosen.problems.push_back(
                fmt::format("{}: the report is incomplete: {}", from.string(), problem.what()));
            joined.report.errors.push_back({item.scene, problem.what()});
        }
    }
    joined.manifest = std::move(chosen.manifest);
    joined.problems = std::move(chosen.problems);
    return joined;
}

}  // namespace diptych::shards
