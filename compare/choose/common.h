// SPDX-License-Identifier: MIT
// One Settings for several scenes: of what the scenes' own choices found, the one that is within the budget
// in every scene and takes the least time over all (the least sum of logarithms, so that no scene counts more
// for being slow); without an error in the budget the one whose worst error is the least.
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
    Budget budget;  // in every scene
    // What scenes propose beyond this is left out, what most of them propose first.
    std::size_t most_candidates = 16;
    // Of these the fastest by the scenes' own times are raced.
    std::size_t most_contenders = 6;
    // Rounds of the race; each draws all twice, in each scene.
    int rounds = 4;
    // Called before each thing that takes time with a word on it and the share that is done, about.
    std::function<void(double, std::string_view)> progress = {};
};

// What one Settings is in one scene.
struct InScene {
    Judged judged;
    double ms = 0;  // geometric mean of its frames; by the scene's own choice until it is raced
};

struct CommonCandidate {
    Settings settings;                   // without a camera
    std::size_t proposed_by = 0;         // scenes
    std::vector<InScene> scenes{};       // in the order of the choices
    bool fits = false;                   // within the budget in every one
    std::optional<Standing> standing{};  // of the race: times are geometric means over all scenes
};

// How much longer the chosen Settings take in a scene than the scene's own choice, with an interval that
// holds it in 95 of 100 cases.
struct Slowdown {
    double ratio = 1, low = 1, high = 1;
};

struct CommonChoice {
    std::vector<CommonCandidate> candidates;
    std::size_t left_out = 0;
    std::optional<std::size_t> chosen, runner_up;
    std::vector<std::size_t> ties;  // as fast over all scenes, as far as can be told
    bool sure = false;
    // Of each scene; nothing where the scene has no choice of its own.
    std::vector<std::optional<Slowdown>> slower;
    // Where nothing fits all: the nearest candidate, and the scene in which it is furthest from the budget.
    std::optional<std::size_t> nearest;
    std::size_t nearest_scene = 0;
    std::size_t judged = 0, timings = 0;
};

// `own`: at least one scene's choice by this budget. `labOf`: the laboratory of a scene by its number, which
// is used until another is asked for. Throws what the laboratories throw.
CommonChoice chooseForAll(std::span<const Choice* const> own, const std::function<Lab&(std::size_t)>& labOf,
                          const CommonOptions& options);

}  // namespace diptych::choose
