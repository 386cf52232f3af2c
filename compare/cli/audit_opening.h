// SPDX-License-Identifier: MIT
// What `audit` begins with, whether it pushes quantities or asks relations: the folder, the device and the
// scene.
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
    // `folder`, `what`, `manifest`: of outputFolder(). Loads the scene, of which there is one. Throws
    // std::runtime_error, one line. `options` and `settings` outlive it.
    AuditOpening(const Options& options, const Settings& settings, const char* folder, const char* what,
                 const char* manifest);

    const std::filesystem::path& folder() const { return folder_; }
    Progress& progress() { return progress_; }
    Device& device() { return device_; }
    const Stage& stage() const { return stage_; }
    const audit::Subject& subject() const { return subject_; }
    // With the scene's notes.
    const audit::Audited& audited() const { return audited_; }

    // On stdout, above the progress line; nothing with --json and --quiet.
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
