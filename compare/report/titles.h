// SPDX-License-Identifier: MIT
// What a report calls its parts, and in which order it tells of them.
#pragma once

#include "compare/page/text.h"
#include "compare/verdict/comparison.h"

#include <string>
#include <string_view>

namespace diptych {

// Whether a scene and camera have several pairs: with a Frame of earlier, or the reference.
bool hasSeveralPairs(const Report& report);
// "forward_plus against deferred"
std::string pairTitle(const Report& report, const Comparison& comparison);

// The comparisons by number, those that fail first.
std::vector<std::size_t> failingFirst(const Report& report);

// The channels as people want to read them: failures, then passes, then forward-only.
std::vector<const ChannelDiff*> failuresFirst(const Comparison& comparison);

// The comparison's notes and those of its two Frames, each once.
std::vector<std::string> notesOf(const Report& report, const Comparison& comparison);

// "3 places to check by eye: texture transforms 2, alpha masks 1"; empty where there are none.
std::string checksLine(const Comparison& comparison);

// "pass: 14 channels within tolerance", "FAIL: lit, normals".
std::string verdictLine(const Report& report);

}  // namespace diptych
