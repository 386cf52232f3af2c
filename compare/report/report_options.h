// SPDX-License-Identifier: MIT
// Contents of a report.
#pragma once

#include "compare/image/channel_image.h"
#include "compare/run/progress.h"

#include <memory>
#include <optional>
#include <string>

namespace diptych {

struct Trends;  // trends.h

// The comparisons whose images, values and EXRs a report keeps.
enum class Keep { all, failing, none };

struct ReportOptions {
    ImageChoice image;
    bool single_file = false;  // index.html contains its images, at half size; no EXR
    Keep keep = Keep::all;
    bool force = false;  // also overwrite a folder that is not a report of ours
    Stage progress{};    // of writing
    // For one scene among many: the folder of its files, ending in a slash, or "" for the report's own
    // folder (sceneFolders() in folders.h). Unset: the report is complete.
    std::optional<std::string> scene_folder{};
    std::shared_ptr<const Trends> since{};  // changes since an earlier report; nullptr: none
};

}  // namespace diptych
