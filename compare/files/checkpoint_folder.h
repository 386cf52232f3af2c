// SPDX-License-Identifier: MIT
#pragma once

#include "shared/text/open_folder.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace diptych {

// Checkpoint of a long command: finished parts in ".NAME.what" beside its output NAME. The next run can
// resume however this one ends. Only one program at a time can open it. All paths below it are held
// (OpenFolder::pin).
class CheckpointFolder {
public:
    // `key`: all inputs of the parts. Removes parts of another key. Throws std::runtime_error naming the
    // folder, and changes nothing in it, if it cannot be created, is a link, is not ours alone, or is in use.
    CheckpointFolder(const std::filesystem::path& out, const std::string& what,
                     const nlohmann::ordered_json& key);

    bool isRenewed() const { return renewed_; }  // parts of another key were removed
    // A part's JSON; null if missing or incomplete.
    nlohmann::ordered_json find(const std::string& name) const;
    void keep(const std::string& name, const nlohmann::ordered_json& part) const;
    const std::filesystem::path& path() const { return folder_.path(); }
    // Path of a part's file.
    std::filesystem::path operator/(const std::string& file) const { return path() / file; }
    void remove();  // call when the output is complete

private:
    void clear();
    nlohmann::ordered_json partIn(const std::string& file) const;

    OpenFolder folder_;
    bool renewed_ = false;
};

// Name, size and time of a file; null for a missing one's. In a key, detects a changed file.
nlohmann::ordered_json fileStamp(const std::filesystem::path& file);

}  // namespace diptych
