// SPDX-License-Identifier: MIT
#pragma once

#include "compare/files/output_folder.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// An output folder with a manifest, a JSON file that lists its contents. Replaces a folder with the same
// manifest and removes the files listed there.
class ListedFolder {
public:
    // Throws std::runtime_error naming -o if the folder has other contents and `force` is false.
    ListedFolder(const std::filesystem::path& folder, std::string manifest, bool force);

    // Writes a file in the folder.
    void put(const std::string& name, const std::string& text);
    // Lists a file that the caller writes to operator/.
    void list(const std::string& name);
    std::filesystem::path operator/(const std::string& file) const { return folder_ / file; }
    // All files so far, with the manifest; sorted.
    std::vector<std::string> files() const;
    // Writes the manifest, adding "software" and "files", and puts the folder in place. Returns the
    // manifest's text.
    std::string finish(nlohmann::ordered_json manifest);
    // The same for a complete manifest.
    void finish(const std::string& manifest);

private:
    const std::filesystem::path path_;
    const std::string manifest_;
    const bool force_;
    OutputFolder folder_;
    std::vector<std::string> files_;
};

}  // namespace diptych
