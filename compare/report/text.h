// SPDX-License-Identifier: MIT
// Words and numbers of every report.
#pragma once

#include "compare/diff.h"

#include <string>
#include <string_view>

namespace diptych {

// Text for HTML and XML, in elements and attributes: markup is escaped; what is no UTF-8, or no character
// that XML 1.0 allows, becomes U+FFFD.
std::string markup(std::string_view text);

std::string number(double value);        // three digits: "0.0123", "1.2e-07", "inf"
std::string bytes(std::uint64_t count);  // "1.25 MiB"

const char* unitOf(const DebugMode& mode);  // of its errors: a degree sign, or nothing

// "default view", or the camera's name, or what was asked for.
std::string cameraTitle(const Frame& frame);
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
std::string marksLine(const Comparison& comparison);

// "pass: 14 channels within tolerance", "FAIL: lit, normals".
std::string verdictLine(const Report& report);

}  // namespace diptych
