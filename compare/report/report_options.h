// SPDX-License-Identifier: MIT
// What a report holds.
#pragma once

#include "compare/picture/picture.h"
#include "compare/run/progress.h"

#include <memory>
#include <optional>
#include <string>

namespace diptych {

struct Trends;  // trends.h

// The comparisons whose pictures, values and EXRs a report keeps.
enum class Keep { all, failing, none };

struct ReportOptions {
    PictureChoice picture;
    bool single_file = false;  // index.html holds its pictures, at half size; no EXR
    Keep keep = Keep::all;
    bool force = false;  // also into a folder that is not a report of ours
    Stage progress{};    // of writing it
    // Of one scene among many: the folder of its files, with a slash at the end, or "" where the report's own
    // is (sceneFolders() in folders.h). Nothing: the report is whole.
    std::optional<std::string> scene_folder{};
    std::shared_ptr<const Trends> since{};  // what has changed since an earlier report; nullptr: none
};

}  // namespace diptych
