// SPDX-License-Identifier: MIT
// Joint choice: one Settings for several scenes, out of the candidates of their own choices. It meets the
// budget in every scene and has the least geometric mean of times, so that slow scenes do not dominate.
// Without an error budget it has the least worst error.
#pragma once

#include "compare/choose/search.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace diptych::choose {

struct JointOptions {
    Budget budget;  // for every scene
    // Maximum candidates; those that most scenes propose come first.
    std::size_t max_candidates = 16;
    // Called before each long step with its description and the fraction done, approximate.
    std::function<void(double, std::string_view)> progress = {};
};

struct JointCandidate {
    Settings settings;            // without a camera
    std::size_t proposed_by = 0;  // count of scenes
    // In order of the choices. Times are geometric means: from the scene's own choice until raced.
    std::vector<experiment::Row> scenes{};
    bool fits = false;                // within the budget in every scene
    std::optional<TimeRatio> race{};  // over the winner; geometric means over all scenes
};

struct JointChoice : Outcome {
    std::vector<JointCandidate> candidates;
    std::size_t omitted = 0;
    // By scene: its time over that of the scene's own choice, at 95 % confidence; empty if there is none.
    std::vector<std::optional<TimeRatio>> slower;
    std::size_t nearest_scene = 0;  // the one with the nearest candidate's largest miss
};

// `own`: choices of at least one scene for this budget. `evaluatorOf`: evaluator of a scene by index, valid
// until the next call. Throws what evaluators throw.
JointChoice chooseJointly(std::span<const SettingsChoice* const> own,
                          const std::function<Evaluator&(std::size_t)>& evaluatorOf,
                          const JointOptions& options);

}  // namespace diptych::choose
