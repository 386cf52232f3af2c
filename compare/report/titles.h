// SPDX-License-Identifier: MIT
// The titles of a report's parts, and the order in which they are shown.
#pragma once

#include "compare/page/text.h"
#include "compare/verdict/comparison.h"

#include <string>
#include <string_view>

namespace diptych {

// Whether one scene and camera have several comparisons: with an earlier Frame or the reference.
bool hasSeveralPairs(const Report& report);
// "forward_plus against deferred"
std::string pairTitle(const Report& report, const Comparison& comparison);

// The numbers of the comparisons, failing ones first.
std::vector<std::size_t> failingFirst(const Report& report);

// The channels in the order in which people read them: failures, then passes, then forward-only.
std::vector<const ChannelDiff*> failuresFirst(const Comparison& comparison);

// The comparison's notes and those of its two Frames, each once.
std::vector<std::string> notesOf(const Report& report, const Comparison& comparison);

// "3 places to check by eye: texture transforms 2, alpha masks 1"; empty where there are none.
std::string checksLine(const Comparison& comparison);

// "pass: 14 channels within tolerance", "FAIL: lit, normals".
std::string verdictLine(const Report& report);

}  // namespace diptych
