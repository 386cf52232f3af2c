// SPDX-License-Identifier: MIT
// The folders of a report that has several scenes, cameras or times.
#pragma once

#include "compare/verdict/comparison.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// A name for a folder that depends on `text` alone: letters, digits, hyphens and underscores of it, at most
// 40, and where that is not all of `identity` six hexadecimal digits of the latter. "gallery" of "gallery";
// "Box-1c9f03" of "Box" of "scenes/Box.glb".
std::string nameOfFolder(const std::string& text, const std::string& identity);

// A name for a channel's files and for its place in the page, which any name of a layer becomes, and no two
// names become the same: letters, digits, "_", "-", "+" and dots but the first stay, any other byte is "~"
// and two hexadecimal digits; of a long one the beginning stands before "~~" and 16 digits of the whole.
// "beauty~2fleft".
std::string nameOfFile(std::string_view name);

// Where the files of frames and of comparisons stand, each empty or ending in a slash.
struct ReportFolders {
    std::vector<std::string> frames, comparisons;
};

// One scene, camera and time: all stands in the report's own folder. Otherwise every scene has a folder,
// named after it alone, so that it is called the same whatever else is compared, and in it every camera that
// was asked for has one, and in that every time that a title says: "entrance/0_5s/". Where these have several
// comparisons, each has one of its own in there: "forward_plus-against-reference/". Who asks for one scene,
// camera and time twice finds the second under "NAME-2/".
// `scene_folder`: of a report of one scene among many, the folder that the scene has there, with a slash at
// the end, or ""; nothing: the report is whole.
ReportFolders reportFolders(const Report& report,
                            const std::optional<std::string>& scene_folder = std::nullopt);

// The folder of each of many different scenes, with a slash at the end: called after the scene alone, but of
// two that would be called the same the second has "-2" behind it.
std::vector<std::string> sceneFolders(const std::vector<std::string>& scenes);

}  // namespace diptych
