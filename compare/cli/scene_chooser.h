// SPDX-License-Identifier: MIT
// Chooses for scenes on one device: reads them, draws their references, and measures what a choice asks for.
#pragma once

#include "compare/choose/common.h"
#include "compare/choose/report.h"
#include "compare/cli/options.h"
#include "compare/run/progress.h"
#include "compare/tradeoff/measure.h"
#include "shared/vulkan/device.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::cli {

class SceneChooser {
public:
    // `options` must outlive it. Throws where --figure is none.
    explicit SceneChooser(const Options& options);
    ~SceneChooser();

    choose::ChoiceReport choose(const std::string& scene);
    // One Settings for all of these, which choose() chose for. Of the scenes one at a time is held; another
    // is read again, but its reference is kept.
    choose::CommonReport chooseForAll(const std::vector<choose::ChoiceReport>& reports);

private:
    struct Held;  // a scene, read and uploaded
    Held& hold(const std::string& scene, const Stage& progress);
    choose::UnseenCamera fromUnseen(Held& held, const Settings& truth, const choose::ChoiceReport& report,
                                    const std::string& camera);
    std::optional<choose::DecidersReport> decidersOf(Held& held, const choose::ChoiceReport& report,
                                                     const Stage& progress);

    const Options& options_;
    const std::size_t figure_;
    Progress progress_;
    Device device_;
    std::shared_ptr<PipelineSet> pipelines_;
    std::map<std::string, tradeoff::ReferenceFrames> references_;  // by scene
    std::unique_ptr<Held> held_;
};

}  // namespace diptych::cli
