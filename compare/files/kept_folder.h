// SPDX-License-Identifier: MIT
#pragma once

#include "compare/files/open_folder.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace diptych {

// The finished parts of what a long command makes, in ".NAME.what" beside its output NAME, so that the next
// program can resume however this one ends. One program at a time may hold it.
class KeptFolder {
public:
    // `key`: everything that the parts depend on. Parts of another key are removed. Throws std::runtime_error
    // naming the folder where it cannot be made, is a link, is not ours, or is held by another program.
    KeptFolder(const std::filesystem::path& out, const std::string& what, const nlohmann::ordered_json& key);

    bool isRenewed() const { return renewed_; }  // whether parts of another key were removed
    // A part's JSON; null where there is none or it is incomplete.
    nlohmann::ordered_json find(const std::string& name) const;
    void keep(const std::string& name, const nlohmann::ordered_json& part) const;
    const std::filesystem::path& path() const { return folder_.path(); }
    // The path of a file of a part.
    std::filesystem::path operator/(const std::string& file) const { return path() / file; }
    void remove();  // all of it: the command has made its output

private:
    void clear();

    OpenFolder folder_;
    bool renewed_ = false;
};

}  // namespace diptych
