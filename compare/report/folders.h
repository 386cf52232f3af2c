// SPDX-License-Identifier: MIT
// Folders of a report with several scenes, cameras or times.
#pragma once

#include "compare/verdict/comparison.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// 64-bit FNV-1a, 16 hexadecimal digits.
std::string hashOf(std::string_view text);

// A folder name made from `text`: letters, digits and underscores stay, other characters become hyphens;
// at most 40 characters. If the result differs from `identity`, six hexadecimal digits of identity's hash
// follow. "gallery" stays "gallery"; "Box" of "scenes/Box.glb" becomes "Box-1c9f03".
std::string nameOfFolder(const std::string& text, const std::string& identity);

// A unique name for a channel's files and its anchor in the page. Letters, digits, "_", "-", "+" and dots
// except a leading one stay; any other byte becomes "~" and two hexadecimal digits. A long name is cut,
// and "~~" and 16 hash digits follow. Example: "beauty~2fleft".
std::string nameOfFile(std::string_view name);

// Folders of the files of frames and comparisons, each empty or ending in a slash.
struct ReportFolders {
    std::vector<std::string> frames, comparisons;
};

// With one scene, camera and time, all files are in the report's own folder. Otherwise every scene has a
// folder named after it alone, so the name does not depend on the other scenes. It contains a folder for
// every requested camera, and in that one for every time named in a title: "entrance/0_5s/". If such a
// folder has several comparisons, each has its own: "forward_plus-against-reference/". A repeated scene,
// camera and time gets "NAME-2/".
// `scene_folder`: the scene's folder in a report of many scenes, ending in a slash, or ""; unset: the
// report is complete.
ReportFolders reportFolders(const Report& report,
                            const std::optional<std::string>& scene_folder = std::nullopt);

// The folder of each of many different scenes, ending in a slash. It is named after the scene alone;
// repeated names get "-2", "-3".
std::vector<std::string> sceneFolders(const std::vector<std::string>& scenes);

}  // namespace diptych
