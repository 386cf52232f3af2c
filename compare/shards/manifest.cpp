// SPDX-License-Identifier: MIT
#include "compare/shards/manifest.h"

#include "compare/files/our_files.h"
#include "compare/run/version.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace diptych::shards {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string contents(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

std::string hashOf(const std::string& text) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return fmt::format("{:016x}", hash);
}

std::string planHash(const Json& plan) {
    return hashOf(plan.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string buildName() {
    static const std::string name = [] {
        const std::string commit = commitName();
        return commit != "unknown"
                   ? fmt::format("{}, commit {}", versionName(), commit)
                   : fmt::format("{}, program {}", versionName(), hashOf(contents("/proc/self/exe")));
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
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Manifest readManifest(const fs::path& folder, const char* file) {
    const std::string none = fmt::format(
        "{}: is no report of a shard ({} is missing or not ours); give the folders that --shard I/N wrote",
        folder.string(), file);
    const Json json = Json::parse(contents(folder / file), nullptr, false);
    if (!json.is_object() || json.value("software", "") != softwareName || json.value("schema", 0) != 1)
        throw std::runtime_error(none);
    try {
        Manifest manifest;
        manifest.build = json.at("build");
        manifest.command = json.at("command");
        manifest.plan = json.at("plan");
        manifest.shard = {json.at("shard").at("index"), json.at("shard").at("count")};
        for (const Json& item : json.at("items"))
            manifest.items.push_back({item.at(0), item.at(1), item.at(2)});
        for (const Json& error : json.at("errors")) manifest.errors.push_back({error.at(0), error.at(1)});
        return manifest;
    } catch (const Json::exception&) {
        throw std::runtime_error(none);
    }
}

}  // namespace diptych::shards
