// SPDX-License-Identifier: MIT
// Two Frames, channel by channel, and the report of several such comparisons.
#pragma once

#include "compare/checks/visual_checks.h"
#include "compare/metrics/channel.h"
#include "compare/run/progress.h"
#include "compare/verdict/after_blending.h"
#include "compare/verdict/channel_diff.h"
#include "compare/verdict/closer_path.h"
#include "compare/verdict/explained.h"
#include "compare/verdict/rules.h"
#include "compare/verdict/selection.h"
#include "shared/frame/frame.h"
#include "shared/frame/sides.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

struct Comparison {
    std::size_t baseline = 0, test = 0;  // into Report::frames
    std::vector<ChannelDiff> channels;   // in ascending number
    Coverage coverage;
    std::vector<std::string>
        failures;  // in addition to the channels', e.g. a capture that is not the timed frame
    std::vector<std::string> notes;               // what a reader must know although it is no failure
    std::vector<SettingDifference> differing;     // of two paths: Settings that they do not share
    std::optional<AfterBlending> after_blending;  // where something is blended; a failure has its own line
    // Why the verdict says little: the pictures show hardly anything, or hardly a pixel was judged closely.
    std::string emptiness;
    std::vector<std::string>
        command;  // the command line that repeats this comparison; --channels may be added
    std::vector<FeatureChecks> visual_checks;  // places that a person must look at
    std::optional<Explained> explained;        // where it was asked for, and where lit fails

    bool passed() const;
};

// What is said of a scene or picture that has no comparison: why it could not be drawn while others of the
// same call were, or why it fails.
struct SceneError {
    std::string scene, message;
    // Of an external renderer: its name, and the end of what it said before it failed, many lines.
    std::string renderer{}, output{};
};

struct Report {
    ReportDevice device;
    ReportDevice against;  // of --against-device; no name: there is none
    std::vector<Frame> frames;
    std::vector<Comparison> comparisons;
    std::vector<std::string> first_notes;  // what a reader must know before any number
    std::vector<SceneError> errors;
    std::vector<SceneError> failures;      // of no comparison: pictures that one of two folders lacks
    std::vector<CloserPath> closer_paths;  // with --baseline reference: one per scene and camera
    double diff_ms = 0;                    // time of comparing alone

    bool passed() const;
    const Frame& baseline(const Comparison& comparison) const { return frames[comparison.baseline]; }
    const Frame& test(const Comparison& comparison) const { return frames[comparison.test]; }
};

// The device that a Frame of the report was drawn on in this run.
const ReportDevice& deviceOf(const Report& report, const Frame& frame);

struct CompareOptions {
    Path baseline = Path::deferred;  // the left panel
    std::vector<Rule> rules;         // in place of the derived tolerances, where one names the channel
    SelectionOptions selection;      // pixels
    std::vector<std::string> words;  // of the command line that set the above; repeated commands contain them
    bool allow_noise = false;  // on a GPU: the difference of two runs of one path is added to tolerances
    // A channel that only one of a pair has is a failure, any or those that were asked for by name; and with
    // strict so are pictures that show hardly anything.
    bool strict = false;
    std::vector<int> required{};
    bool allow_empty = false;  // pictures that show nothing, or hardly anything, are what is wanted
    // What the device makes of texels of 8 bits, which a reference in mode scene grants it.
    std::optional<TextureSampling> texels{};
    // Settings by which the two paths are lit otherwise, in words (lightDifferences()): without rules,
    // channels of light then decide nothing. Empty: they are lit alike.
    std::string light_differs{};
    // One path on two devices; outlives the comparison.
    const AcrossDevices* across = nullptr;
    Stage progress{};  // of comparing
};

// frames[test] against frames[baseline] of the report, over the requested channels that both have. A channel
// that only forward+ can make is listed as forward-only and never fails. Throws std::runtime_error where the
// two differ in size or share no channel.
Comparison compareFrames(const Report& report, std::size_t baseline, std::size_t test,
                         const Requirements& needs, const CompareOptions& options = {});

}  // namespace diptych
