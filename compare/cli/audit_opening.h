// SPDX-License-Identifier: MIT
// The start of both forms of `audit`: opens the output folder, the device and the scene.
#pragma once

#include "compare/audit/case.h"
#include "compare/cli/options.h"
#include "compare/run/progress.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device.h"

#include <filesystem>
#include <string>

namespace diptych::cli {

class AuditOpening {
public:
    // `folder`, `what` and `manifest` go to outputFolder(). Loads the command line's only scene. `options`
    // and `settings` must outlive the object. Throws std::runtime_error, one line.
    AuditOpening(const Options& options, const Settings& settings, const char* folder, const char* what,
                 const char* manifest);

    const std::filesystem::path& folder() const { return folder_; }
    Progress& progress() { return progress_; }
    Device& device() { return device_; }
    const Stage& stage() const { return stage_; }
    const audit::Subject& subject() const { return subject_; }
    // Includes the scene's notes.
    const audit::Audited& audited() const { return audited_; }

    // Prints on stdout, above the progress line. Does nothing with --json or --quiet.
    void print(const std::string& words);

private:
    const Options& options_;
    const std::filesystem::path folder_;
    Progress progress_;
    Device device_;
    const Stage stage_;
    const Scene scene_;
    const audit::Subject subject_;
    audit::Audited audited_;
};

}  // namespace diptych::cli
