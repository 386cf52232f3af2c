// SPDX-License-Identifier: MIT
// Two Frames, channel by channel: numbers, tolerance, verdict.
#pragma once

#include "compare/checks/visual_checks.h"
#include "compare/metrics/channel.h"
#include "compare/run/progress.h"
#include "compare/verdict/closer_path.h"
#include "compare/verdict/encoding_use.h"
#include "compare/verdict/footprint.h"
#include "compare/verdict/rules.h"
#include "compare/verdict/selection.h"
#include "compare/verdict/tolerance.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {

enum class Verdict { pass, fail, forward_only };
std::string_view nameOf(Verdict verdict);  // "pass", "fail", "forward-only"

struct ChannelDiff {
    const DebugMode* mode = nullptr;
    ChannelStats stats;          // meaningless where forward-only
    std::optional<double> flip;  // mean; of colours
    Tolerance tolerance;
    std::optional<std::uint64_t>
        unexplained_pixels;  // lit channels: pixels whose difference the encoding does not explain
    std::optional<Footprints> footprints;     // of a reference in mode scene
    std::optional<EncodingUse> encoding_use;  // of what the G-buffer's bits allow a lit channel
    std::optional<double>
        certain_p999;  // against a sampled reference: the part of p999 that exceeds its uncertainty
    Verdict verdict = Verdict::pass;
    std::string reason;   // why it failed; empty otherwise
    std::string warning;  // the warning of a rule; empty without one
    // The image that the difference picture shows instead of the metric's errors, its name, and the error at
    // the end of its colours.
    std::shared_ptr<const Image> shown_error;
    std::string shown_error_name;
    double shown_error_top = 1;
    std::vector<std::pair<std::string, double>> figures;  // all that are defined
    std::string rule;  // which rule decided, "tolerances.json, rule 3: flip <= 0.02"; empty: the tolerance
};

// The share of its tolerance that a channel uses; infinite where it differs although nothing is granted.
double usedShare(const ChannelDiff& channel);

struct Comparison {
    std::size_t baseline = 0, test = 0;  // into Report::frames
    std::vector<ChannelDiff> channels;   // in ascending number
    Coverage coverage;
    std::vector<std::string>
        failures;  // in addition to the channels', e.g. a capture that is not the timed frame
    std::vector<std::string> notes;  // what a reader must know although it is no failure
    std::vector<std::string>
        command;  // the command line that repeats this comparison; --channels may be added
    std::vector<FeatureChecks> visual_checks;  // places that a person must look at

    bool passed() const;
};

struct Report {
    ReportDevice device;
    std::vector<Frame> frames;
    std::vector<Comparison> comparisons;
    std::vector<std::string> first_notes;  // what a reader must know before any number
    std::vector<CloserPath> closer_paths;  // with --baseline reference: one per scene and camera
    double diff_ms = 0;                    // time of comparing alone

    bool passed() const;
    const Frame& baseline(const Comparison& comparison) const { return frames[comparison.baseline]; }
    const Frame& test(const Comparison& comparison) const { return frames[comparison.test]; }
};

struct CompareOptions {
    Path baseline = Path::deferred;  // the left panel
    std::vector<Rule> rules;         // in place of the derived tolerances, where one names the channel
    SelectionOptions selection;      // pixels
    std::vector<std::string> words;  // of the command line that set the above; repeated commands contain them
    bool allow_noise = false;  // on a GPU: the difference of two runs of one path is added to tolerances
    bool strict = false;       // a channel that only one of a pair has is a failure
    // What the device makes of texels of 8 bits, which a reference in mode scene grants it.
    std::optional<TextureSampling> texels{};
    Stage progress{};  // of comparing
};

// frames[test] against frames[baseline] of the report, over the requested channels that both have. A channel
// that only forward+ can make is listed as forward-only and never fails. Throws std::runtime_error where the
// two differ in size or share no channel.
Comparison compareFrames(const Report& report, std::size_t baseline, std::size_t test,
                         const Requirements& needs, const CompareOptions& options = {});

// The main job of the tool: frames come two by two, both paths of one scene and camera side by side; the one
// drawn by `options.baseline` becomes the left panel. `needs`: one entry per frame; `checks`: one per pair,
// or none.
Report makeReport(std::vector<Frame> frames, const std::vector<Requirements>& needs, ReportDevice device,
                  const CompareOptions& options = {}, std::vector<std::vector<FeatureChecks>> checks = {});

// The reference as the left panel: frames come three by three, the reference and both paths of one scene and
// camera; both paths against it, then against each other. `needs`: one entry per frame; `checks` and
// `materials`, the names of these by id: one per scene and camera.
Report makeReferenceReport(std::vector<Frame> frames, const std::vector<Requirements>& needs,
                           ReportDevice device, const CompareOptions& options,
                           std::vector<std::vector<FeatureChecks>> checks,
                           const std::vector<std::vector<std::string>>& materials);

// An earlier Frame as the left panel: both paths against it, then against each other. `mismatches` are
// printed first.
Report makeBaselineReport(Frame baseline, std::vector<Frame> frames, const Requirements& needs,
                          ReportDevice device, const CompareOptions& options,
                          const std::vector<std::string>& mismatches);

}  // namespace diptych
