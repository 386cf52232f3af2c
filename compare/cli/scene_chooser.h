// SPDX-License-Identifier: MIT
// Runs `choose` on one device: reads scenes, renders references, measures candidates.
#pragma once

#include "compare/choose/common.h"
#include "compare/choose/report.h"
#include "compare/cli/options.h"
#include "compare/experiment/references.h"
#include "compare/run/progress.h"
#include "shared/vulkan/device.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::cli {

class SceneChooser {
public:
    // `options` must outlive the object. Throws if --figure names no metric.
    explicit SceneChooser(const Options& options);
    ~SceneChooser();

    choose::ChoiceReport choose(const std::string& scene);
    // One Settings for all scenes; call choose() for each first. Only one scene is in memory: others are
    // read again, but their references are kept.
    choose::CommonReport chooseForAll(const std::vector<choose::ChoiceReport>& reports);

private:
    struct LoadedScene;  // a scene, read and uploaded
    LoadedScene& load(const std::string& scene, const Stage& progress);
    choose::HeldOutCamera atHeldOut(LoadedScene& loaded, const Settings& truth,
                                    const choose::ChoiceReport& report, const std::string& camera);
    std::optional<choose::SensitivityReport> sensitivityOf(LoadedScene& loaded,
                                                           const choose::ChoiceReport& report,
                                                           const Stage& progress);

    const Options& options_;
    const std::size_t figure_;
    Progress progress_;
    Device device_;
    std::shared_ptr<PipelineSet> pipelines_;
    std::map<std::string, experiment::ReferenceFrames> references_;  // key: scene
    std::unique_ptr<LoadedScene> loaded_;
};

}  // namespace diptych::cli
