// SPDX-License-Identifier: MIT
// The titles of a report's parts, and the order in which they are shown.
#pragma once

#include "compare/page/text.h"
#include "compare/verdict/comparison.h"

#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// Whether one scene, camera and time have several comparisons: with an earlier Frame, the reference or
// another device.
bool hasSeveralPairs(const Report& report);
// "forward_plus against deferred"
std::string pairTitle(const Report& report, const Comparison& comparison);

// Whether titles and folders say at which time of its animations the Frame is: at any but 0 s, and wherever
// the report has several times.
bool saysTime(const Report& report, const Frame& frame);
// Camera and, where saysTime(), time: "default view", "entrance, 0.5 s".
std::string viewTitle(const Report& report, const Frame& frame);

// The folder that all scenes are in, or the two files that diff compared: pages leave it out.
std::string folderOfAll(const Report& report);

// The numbers of the comparisons, failing ones first.
std::vector<std::size_t> failingFirst(const Report& report);

// The channels in the order in which people read them: failures, then passes, then forward-only.
std::vector<const ChannelDiff*> failuresFirst(const Comparison& comparison);

// The channels whose pictures stand above the table: every one that fails, and lit, which comes second at the
// latest. Without lit and failures, the first that is compared.
std::vector<const ChannelDiff*> leadingChannels(const Comparison& comparison);

// The comparison's notes and those of its two Frames, each once.
std::vector<std::string> notesOf(const Report& report, const Comparison& comparison);

// "3 places to check by eye: texture transforms 2, alpha masks 1"; empty where there are none.
std::string checksLine(const Comparison& comparison);

// The text with every number made one and the same: of notes that say it with other numbers.
std::string withoutNumbers(const std::string& text);

// Scene, and camera and time where the report has several of that scene: "Box.glb", "Box.glb, camera 1",
// "Box.glb, default view, 0.5 s".
std::string placeOf(const Report& report, const Comparison& comparison);

// A note and the scenes that it is about, in the report's order.
struct GroupedNote {
    std::string text;  // of the first scene
    std::vector<std::string> scenes;
    bool varies = false;  // other scenes have other numbers in it
};
// The notes of all comparisons, each once; of several scenes, whatever numbers are in it.
std::vector<GroupedNote> groupedNotes(const Report& report);

// "bad.glb: is cut short", whether or not the message begins with the name.
std::string errorText(const SceneError& error);

// "a, b and 3 more": at most `most` of the names.
std::string listed(const std::vector<std::string>& names, std::size_t most);

// "pass: all 14 channels are within tolerance", "FAIL: lit, normals beyond tolerance", "FAIL: 20 of 26
// comparisons failed: Box.glb, ... (lit beyond tolerance)"; scenes that could not be drawn come first.
std::string verdictLine(const Report& report);

}  // namespace diptych
