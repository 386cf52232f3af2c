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

struct CommonOptions {
    Budget budget;  // for every scene
    // Maximum candidates; those that most scenes propose come first.
    std::size_t most_candidates = 16;
    // Maximum finalists in the race, the fastest by earlier times.
    std::size_t most_finalists = 6;
    // Rounds of the race. Each renders every finalist twice in each scene.
    int rounds = 4;
    // Called before each long step with its description and the fraction done, approximate.
    std::function<void(double, std::string_view)> progress = {};
};

struct CommonCandidate {
    Settings settings;            // without a camera
    std::size_t proposed_by = 0;  // count of scenes
    // In order of the choices. Times are geometric means: from the scene's own choice until raced.
    std::vector<experiment::Row> scenes{};
    bool fits = false;                // within the budget in every scene
    std::optional<TimeRatio> race{};  // over the winner; geometric means over all scenes
};

struct CommonChoice {
    std::vector<CommonCandidate> candidates;
    std::size_t left_out = 0;
    std::optional<std::size_t> chosen, runner_up;
    std::vector<std::size_t> ties;  // not significantly slower than the chosen one
    bool significant = false;
    // By scene: its time over that of the scene's own choice, at 95 % confidence; empty if there is none.
    std::vector<std::optional<TimeRatio>> slower;
    // If nothing fits: the nearest candidate, and the scene with its largest miss.
    std::optional<std::size_t> nearest;
    std::size_t nearest_scene = 0;
    std::size_t judged = 0, timings = 0;
};

// `own`: choices of at least one scene for this budget. `evaluatorOf`: evaluator of a scene by index, valid
// until the next call. Throws what evaluators throw.
CommonChoice chooseForAll(std::span<const Choice* const> own,
                          const std::function<Evaluator&(std::size_t)>& evaluatorOf,
                          const CommonOptions& options);

}  // namespace diptych::choose
