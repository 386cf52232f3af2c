// SPDX-License-Identifier: MIT
#include "compare/shards/manifest.h"

#include "compare/files/diptych_files.h"
#include "compare/report/folders.h"
#include "compare/run/version.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/json_text.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <cstdint>
#include <set>
#include <stdexcept>
#include <string_view>

namespace diptych::shards {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Size limit of the program file, which is hashed whole.
constexpr std::uint64_t max_program_bytes = std::uint64_t(4) << 30;

// Folder of a scene's files: "" or a name that diptych gives.
std::string folderFrom(const JsonAt<Json>& json) {
    const std::string& folder = json.text();
    if (!folder.empty() && (!folder.ends_with('/') || !isDiptychFileName(folder + "part.json")))
        json.fail(fmt::format("\"{}\" is not a folder name of diptych", oneLine(folder)));
    return folder;
}

Manifest manifestFrom(const JsonAt<Json>& json) {
    Manifest manifest;
    manifest.build = json.at("build").text();
    manifest.command = json.at("command").text();
    manifest.plan = json.at("plan").json();
    const int count = json.at("shard").at("count").whole(1, max_shards);
    manifest.shard = {json.at("shard").at("index").whole(1, count), count};
    std::set<std::string> folders;
    for (const auto& item : json.at("items").each()) {
        manifest.items.push_back({item[0].text(), folderFrom(item[1]), item[2].whole(1, count)});
        if (!folders.insert(manifest.items.back().folder).second)
            item.fail("uses the folder of another scene");
    }
    for (const auto& error : json.at("errors").each())
        manifest.errors.push_back({error[0].text(), error[1].text()});
    return manifest;
}

}  // namespace

std::string planHash(const Json& plan) {
    return hashOf(jsonText(plan, -1));
}

std::string buildName() {
    static const std::string name = [] {
        const std::string commit = commitName();
        return commit != "unknown" ? fmt::format("{}, commit {}", versionName(), commit)
                                   : fmt::format("{}, program {}", versionName(),
                                                 hashOf(textIn("/proc/self/exe", max_program_bytes)));
    }();
    return name;
}

std::string programStamp() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const auto time = fs::last_write_time(program, error).time_since_epoch().count();
    return fmt::format("{} {} {}", buildName(), fs::file_size(program, error), time);
}

std::string textOf(const Manifest& manifest) {
    Json items = Json::array(), errors = Json::array();
    for (const Item& item : manifest.items) items.push_back({item.scene, item.folder, item.shard});
    for (const SceneError& error : manifest.errors) errors.push_back({error.scene, error.message});
    const Json json{{"schema", 1},
                    {"software", softwareName},
                    {"build", manifest.build},
                    {"command", manifest.command},
                    {"plan_hash", planHash(manifest.plan)},
                    {"shard", {{"index", manifest.shard.index}, {"count", manifest.shard.count}}},
                    {"items", items},
                    {"errors", errors},
                    {"plan", manifest.plan}};
    return jsonText(json, 1) + "\n";
}

Manifest readManifest(const fs::path& folder, const char* file) {
    return named(folder.string(), [&] {
        Json json;
        try {
            json = parseOrderedJson(textBelow(folder, file, json_bytes));
        } catch (const std::runtime_error& error) {
            fail(fmt::format("is not the report of a shard ({} {}); give the folders that --shard I/N wrote",
                             file, error.what()));
        }
        const JsonAt top(json, file);
        if (top.textOr("software", "") != softwareName || top.numberOr("schema", 0) != 1)
            fail(
                fmt::format("is not the report of a shard ({} is not from diptych); give the folders that "
                            "--shard I/N wrote",
                            file));
        return manifestFrom(top);
    });
}

}  // namespace diptych::shards
