// SPDX-License-Identifier: MIT
// Comparison of two Frames channel by channel, and the report of several comparisons.
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
#include <optional>
#include <string>
#include <vector>

namespace diptych {

struct Comparison {
    std::size_t baseline = 0, test = 0;  // indices in Report::frames
    std::vector<ChannelDiff> channels;   // in ascending channel number
    Coverage coverage;
    std::vector<std::string> failures;            // beside the channels', e.g. a capture unlike its frame
    std::vector<std::string> notes;               // information that is no failure
    std::vector<SettingDifference> differing;     // of two paths: Settings in which they differ
    std::optional<AfterBlending> after_blending;  // if something is blended; a failure has its own line
    // Why the verdict is weak: the images show hardly anything, or hardly a pixel was compared closely.
    std::string emptiness;
    std::vector<std::string> command;          // command line that repeats it; --channels may be added
    std::vector<FeatureChecks> visual_checks;  // pixels to inspect visually
    std::optional<Explained> explained;        // if requested, and if lit fails

    bool passed() const;
};

// An error of a scene or image without a comparison: why it could not be rendered while others of the same
// call were, or why it fails.
struct SceneError {
    std::string scene, message;
    // External renderer: its name, and the last lines of its output before it failed.
    std::string renderer{}, output{};
};

struct Report {
    ReportDevice device;
    ReportDevice against;  // of --against-device; empty name: none
    std::vector<Frame> frames;
    std::vector<Comparison> comparisons;
    std::vector<std::string> first_notes;  // what a reader must know before any metric
    std::vector<SceneError> errors;
    std::vector<SceneError> failures;      // without a comparison: images missing in one of two folders
    std::vector<CloserPath> closer_paths;  // with --baseline reference: one per scene and camera
    double diff_ms = 0;                    // time of comparing only

    bool passed() const;
    const Frame& baseline(const Comparison& comparison) const { return frames[comparison.baseline]; }
    const Frame& test(const Comparison& comparison) const { return frames[comparison.test]; }
};

// The device that rendered a Frame of the report in this run.
const ReportDevice& deviceOf(const Report& report, const Frame& frame);

struct CompareOptions {
    Path baseline = Path::deferred;  // left panel
    std::vector<Rule> rules;         // replace the derived tolerances of channels that they name
    SelectionOptions selection;      // pixels
    std::vector<std::string> words;  // words of the command line that set the above; repeated in commands
    std::vector<std::string> renderer_texts{};  // likewise, only for images of external renderers
    bool allow_noise = false;  // on a GPU: adds the difference of two runs of one path to tolerances
    // Fail if only one side has a channel: any channel (`strict`) or those requested by name (`required`).
    // `strict` also fails if the images show hardly anything.
    bool strict = false;
    std::vector<Channel> required{};
    bool allow_empty = false;  // images that show nothing, or hardly anything, are expected
    // The device's 8-bit texel sampling, which comparisons with a reference in mode scene tolerate.
    std::optional<TextureSampling> texels{};
    // Lighting Settings in which the two paths differ, as text (lightDifferences()). Without rules,
    // channels of light then decide nothing. Empty: equal lighting.
    std::string light_differs{};
    // One path on two devices; must outlive the comparison.
    const AcrossDevices* across = nullptr;
    Stage progress{};  // of the comparison
};

// Compares frames[test] with frames[baseline] of the report, over the requested channels that both have. A
// channel that only forward+ supports is listed as forward-only and never fails. Throws std::runtime_error
// if the sizes differ or no channel is shared.
Comparison compareFrames(const Report& report, std::size_t baseline, std::size_t test,
                         const Requirements& needs, const CompareOptions& options = {});

}  // namespace diptych
