// SPDX-License-Identifier: MIT
#pragma once

#include "compare/files/output_folder.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// A command's output folder whose manifest, a JSON file, lists what is in it: an OutputFolder that replaces
// an earlier one of the same manifest and removes what that one listed.
class ListedFolder {
public:
    // Throws std::runtime_error naming -o where something else is there and `force` is not given.
    ListedFolder(const std::filesystem::path& folder, std::string manifest, bool force);

    // Writes a file of the folder.
    void put(const std::string& name, const std::string& text);
    // Lists a file that is written by other means, at operator/.
    void list(const std::string& name);
    std::filesystem::path operator/(const std::string& file) const { return folder_ / file; }
    // So far, with the manifest; sorted.
    std::vector<std::string> files() const;
    // Writes the manifest, with "software" and "files", and puts the folder in its place. Returns its text.
    std::string finish(nlohmann::ordered_json manifest);
    // The same of a manifest that has both already.
    void finish(const std::string& manifest);

private:
    const std::filesystem::path path_;
    const std::string manifest_;
    const bool force_;
    OutputFolder folder_;
    std::vector<std::string> files_;
};

}  // namespace diptych
