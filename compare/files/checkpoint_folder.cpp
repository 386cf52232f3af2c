// SPDX-License-Identifier: MIT
#include "compare/files/checkpoint_folder.h"

#include "compare/files/diptych_files.h"
#include "compare/files/output.h"
#include "shared/image/atomic_file.h"
#include "shared/text/json.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* keyFile = "key.json";

std::string pageOfJson(const Json& json) {
    return jsonText(json) + "\n";
}

bool isOurs(const Json& key) {
    return key.is_object() && key.contains("software") && key["software"] == softwareName &&
           key.contains("schema") && key["schema"] == 1;
}

}  // namespace

CheckpointFolder::CheckpointFolder(const fs::path& out, const std::string& what, const Json& key)
    : folder_(OpenFolder::own(besideOutput(out, what))) {
    if (!folder_.lock())
        throw std::runtime_error(fmt::format(
            "{}: another diptych writes to the same -o; wait for it, or choose another -o", path().string()));
    // Nothing is changed before the folder is known to be ours.
    const Json there = partIn(keyFile);
    const bool holdsOthers = std::ranges::any_of(
        folder_.names(), [](const std::string& name) { return !isTemporaryOf(keyFile, name); });
    if (holdsOthers && !isOurs(there))
        throw std::runtime_error(path().string() + ": exists and was not written by diptych; move it away");
    folder_.pin();
    folder_.removeLinks();  // planted links must not lose results
    if (there == key) return;
    renewed_ = holdsOthers;
    clear();
    writeFile(path() / keyFile, pageOfJson(key));
}

// Removes the key last: it marks the other files as ours.
void CheckpointFolder::clear() {
    for (const std::string& name : folder_.names())
        if (name != keyFile) folder_.removeAll(name);
    folder_.removeFile(keyFile);
}

Json CheckpointFolder::partIn(const std::string& file) const {
    try {
        Json json = parseOrderedJson(folder_.read(file, json_bytes));
        return json.is_object() ? json : Json();
    } catch (const std::runtime_error&) {  // missing or incomplete
        return {};
    }
}

Json CheckpointFolder::find(const std::string& name) const {
    return partIn(name + ".json");
}

void CheckpointFolder::keep(const std::string& name, const Json& part) const {
    writeFile(path() / (name + ".json"), pageOfJson(part));
}

void CheckpointFolder::remove() {
    clear();
    // Another program that was given the name has files in it.
    OpenFolder::at(path().parent_path()).removeFolder(path().filename());
}

Json fileStamp(const fs::path& file) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error) return {file.string(), nullptr};
    return {file.string(), size, fs::last_write_time(file, error).time_since_epoch().count()};
}

}  // namespace diptych
