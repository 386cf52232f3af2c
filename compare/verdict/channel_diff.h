// SPDX-License-Identifier: MIT
// One channel of two Frames: metrics, tolerance, verdict.
#pragma once

#include "compare/metrics/channel.h"
#include "compare/verdict/approximation_errors.h"
#include "compare/verdict/bound_use.h"
#include "compare/verdict/footprint.h"
#include "compare/verdict/frame_pair.h"
#include "compare/verdict/rules.h"
#include "compare/verdict/tolerance.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/setting_values.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// informative: decides nothing, because the two sides have different lighting Settings.
enum class Verdict { pass, fail, forward_only, deferred_only, informative };
template <>
inline constexpr EnumName<Verdict> enum_names<Verdict>[] = {{Verdict::pass, "pass"},
                                                            {Verdict::fail, "fail"},
                                                            {Verdict::forward_only, "forward-only"},
                                                            {Verdict::deferred_only, "deferred-only"},
                                                            {Verdict::informative, "informative"}};
// Both Frames have the channel.
constexpr bool isCompared(Verdict verdict) {
    return verdict == Verdict::pass || verdict == Verdict::fail || verdict == Verdict::informative;
}

struct ChannelDiff {
    const DebugMode* mode = nullptr;
    ChannelStats stats;          // meaningless if not compared
    std::optional<double> flip;  // mean; only for colours
    Tolerance tolerance;
    std::optional<std::uint64_t>
        unexplained_pixels;  // lit channels: pixels whose difference the encoding does not explain
    std::optional<Footprints> footprints;  // against a reference in mode scene
    std::optional<BoundUse> encoding_use;  // surface channel: use of the quantization error bound
    std::optional<BoundUse> device_use;    // one path on two devices: use of their precision bound
    std::optional<double>
        certain_p999;  // against a sampled reference: the part of p999 beyond its uncertainty
    std::vector<ApproximationError> approximation_errors;  // lit, against the reference
    Verdict verdict = Verdict::pass;
    std::string reason;   // why it failed; else empty
    std::string warning;  // warning of a rule; else empty
    // If set, the difference image shows this instead of the channel's errors: the image, its name, and the
    // error at the end of its colour map.
    std::shared_ptr<const Image> shown_error;
    std::string shown_error_name;
    double shown_error_top = 1;
    std::vector<std::pair<std::string, double>> metrics;  // all defined metrics
    std::string rule;  // deciding rule, "tolerances.json, rule 3: flip <= 0.02"; empty: tolerance
    std::optional<Criterion> criterion;  // the deciding one; empty if not compared, or a rule has no bound
};

// Fraction of its tolerance that a channel uses; infinite if it differs without any tolerance.
double usedFraction(const ChannelDiff& channel);

// Whether a channel depends on light and the two sides have different lighting Settings. Without a rule,
// such a channel is shown but decides nothing.
bool isInformative(const DebugMode& mode, const FramePair& pair);
Tolerance informativeTolerance(const FramePair& pair);

// Compares the channel of both Frames by the last of `rules` that names it, or else by the derived
// tolerance. `allowNoise`: on a GPU, adds the difference between two runs of a path to that tolerance.
ChannelDiff diffChannel(const DebugMode& mode, const FramePair& pair, std::span<const Rule> rules,
                        bool allowNoise);

}  // namespace diptych
