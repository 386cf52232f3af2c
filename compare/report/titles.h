// SPDX-License-Identifier: MIT
// The titles of a report's parts, and the order in which they are shown.
#pragma once

#include "compare/page/text.h"
#include "compare/verdict/comparison.h"

#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// Whether one scene, camera and time has several comparisons: with an earlier Frame, the reference or
// another device.
bool hasMultiplePairs(const Report& report);
// "forward_plus against deferred"
std::string pairTitle(const Report& report, const Comparison& comparison);

// Whether titles and folders name the Frame's animation time: if it is not 0 s, or the report has several
// times.
bool namesTime(const Report& report, const Frame& frame);
// Camera and, if namesTime(), time: "default view", "entrance, 0.5 s".
std::string viewTitle(const Report& report, const Frame& frame);

// The common folder of all scenes, or of the files that diff compared; pages omit it.
std::string folderOfAll(const Report& report);

// The indices of the comparisons, failing ones first.
std::vector<std::size_t> failingFirst(const Report& report);

// The channels in reading order: failures, then passes, then forward-only.
std::vector<const ChannelDiff*> failuresFirst(const Comparison& comparison);

// The channels whose images are above the table: every failing one, and lit, first or second. Without lit
// and failures, the first compared channel.
std::vector<const ChannelDiff*> leadingChannels(const Comparison& comparison);

// The notes of the comparison and its two Frames, without duplicates.
std::vector<std::string> notesOf(const Report& report, const Comparison& comparison);

// "3 places to check by eye: texture transforms 2, alpha masks 1"; empty if there are none.
std::string checksLine(const Comparison& comparison);

// Replaces every number by the same placeholder, to group notes that differ in numbers alone.
std::string withoutNumbers(const std::string& text);

// Scene, and camera and time if the report has several for that scene: "Box.glb", "Box.glb, camera 1",
// "Box.glb, default view, 0.5 s".
std::string viewLabel(const Report& report, const Comparison& comparison);

// A note and its scenes, in the report's order.
struct GroupedNote {
    std::string text;  // of the first scene
    std::vector<std::string> scenes;
    bool varies = false;  // its numbers differ between scenes
};
// The notes of all comparisons, without duplicates; notes of several scenes may differ in numbers.
std::vector<GroupedNote> groupedNotes(const Report& report);

// "bad.glb: is cut short", whether or not the message begins with the name.
std::string errorText(const SceneError& error);

// "a, b and 3 more": at most `max` of the names.
std::string listed(const std::vector<std::string>& names, std::size_t max);

// "pass: all 14 compared channels are within tolerance", "FAIL: lit, normals beyond tolerance", "FAIL: 20
// of 26 comparisons failed: Box.glb, ... (lit beyond tolerance)". Scenes that could not be rendered come
// first.
std::string verdictLine(const Report& report);
// Each once, with its scenes if there are several: "a.glb, b.glb, with different numbers". Scenes are named
// below `folder`.
std::vector<std::pair<std::string, std::string>> notesWithScenes(const Report& report,
                                                                 const std::string& folder);

}  // namespace diptych
