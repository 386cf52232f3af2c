// SPDX-License-Identifier: MIT
#include "compare/files/listed_folder.h"

#include "compare/files/diptych_files.h"
#include "compare/files/output.h"
#include "shared/image/atomic_file.h"
#include "shared/text/json_text.h"

#include <algorithm>
#include <utility>

namespace diptych {

namespace {

// Checks before anything is created.
const std::filesystem::path& checked(const std::filesystem::path& path, const std::string& manifest,
                                     bool force) {
    replaceable(path, manifest, force);
    return path;
}

}  // namespace

ListedFolder::ListedFolder(const std::filesystem::path& folder, std::string manifest, bool force)
    : path_(checked(folder, manifest, force)),
      manifest_(std::move(manifest)),
      force_(force),
      folder_(path_),
      files_{manifest_} {}

void ListedFolder::put(const std::string& name, const std::string& text) {
    writeFile(folder_ / name, text);
    list(name);
}

void ListedFolder::list(const std::string& name) {
    if (std::ranges::count(files_, name) == 0) files_.push_back(name);
}

std::vector<std::string> ListedFolder::files() const {
    std::vector<std::string> sorted = files_;
    std::ranges::sort(sorted);
    return sorted;
}

std::string ListedFolder::finish(nlohmann::ordered_json manifest) {
    manifest["software"] = softwareName;
    manifest["files"] = files();
    std::string text = jsonText(manifest) + "\n";
    finish(text);
    return text;
}

void ListedFolder::finish(const std::string& manifest) {
    writeFile(folder_ / manifest_, manifest);
    folder_.put(files_, [&] { return replaceable(path_, manifest_, force_); });
}

}  // namespace diptych
