// SPDX-License-Identifier: MIT
// One channel of two Frames: numbers, tolerance, verdict.
#pragma once

#include "compare/metrics/channel.h"
#include "compare/verdict/criterion.h"
#include "compare/verdict/bound_use.h"
#include "compare/verdict/footprint.h"
#include "compare/verdict/frame_pair.h"
#include "compare/verdict/rules.h"
#include "compare/verdict/tolerance.h"
#include "shared/frame/debug_modes.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {

// informative: decides nothing, as both sides are lit by other Settings.
enum class Verdict { pass, fail, forward_only, deferred_only, informative };
// Both Frames have the channel.
constexpr bool isCompared(Verdict verdict) {
    return verdict == Verdict::pass || verdict == Verdict::fail || verdict == Verdict::informative;
}
std::string_view nameOf(Verdict verdict);  // "pass", "fail", "forward-only", "deferred-only", "informative"

struct ChannelDiff {
    const DebugMode* mode = nullptr;
    ChannelStats stats;          // meaningless where not compared
    std::optional<double> flip;  // mean; of colours
    Tolerance tolerance;
    std::optional<std::uint64_t>
        unexplained_pixels;  // lit channels: pixels whose difference the encoding does not explain
    std::optional<Footprints> footprints;  // of a reference in mode scene
    std::optional<BoundUse> encoding_use;  // of a surface channel: of what the G-buffer's bits allow
    std::optional<BoundUse> device_use;    // of one path on two devices: of what their precision allows
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
    std::optional<Criterion> criterion;  // what decided; empty where not compared, or a rule bounds nothing
};

// The share of its tolerance that a channel uses; infinite where it differs although nothing is granted.
double usedShare(const ChannelDiff& channel);

// Whether a channel is of light, and the pair's sides are lit by other Settings: without a rule for it, it is
// shown and decides nothing.
bool isInformative(const DebugMode& mode, const FramePair& pair);
Tolerance informativeTolerance(const FramePair& pair);

// The channel of both Frames of the pair, judged by the last of `rules` that names it, or else by the
// tolerance derived for it. `allowNoise`: on a GPU, what two runs of a path differ by is added to that.
ChannelDiff diffChannel(const DebugMode& mode, const FramePair& pair, std::span<const Rule> rules,
                        bool allowNoise);

}  // namespace diptych
