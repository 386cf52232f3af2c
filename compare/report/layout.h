// SPDX-License-Identifier: MIT
// The names of all files of a report, decided once for the writers and the page.
#pragma once

#include "compare/picture/picture.h"
#include "compare/report/error_figures.h"
#include "compare/report/report_options.h"
#include "compare/verdict/comparison.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// The pictures of one channel and the figures shown with them; a name is empty where there is no such file.
struct ChannelPictures {
    std::string baseline, test, difference;  // difference: empty if both are equal
    std::string same;    // what baseline and test are both called once their pictures turn out to be the same
    std::string values;  // valuesScript() of both Frames
    bool differ = false;
    bool kept = true;  // else --keep leaves the files out
    PictureScale scale;
    double error_top = 0;  // the error at the end of the error map
    // The most that a single error of the map may be; empty where the verdict bounds no single error.
    std::optional<double> error_limit;
    // Of the difference; filled in by the writer of its picture.
    ErrorHistogram histogram;
    std::vector<WorstPixel> worst;
};
inline constexpr std::size_t worstShown = 10;
inline constexpr int worstApart = 8;  // pixels

// The number of comparisons that the page itself holds, failing ones first. Each of the others has a line in
// a table; its section is loaded on demand from a file of its own, or, with --single-file, from text inside
// the page.
inline constexpr std::size_t comparisonsInPage = 4;

// A report of many scenes is put together of parts (parts.h), which are written before it is known where in
// the page they will stand. What that decides is written as a character that no text of a page holds:
// page::markup() has made U+FFFD of it.
inline constexpr std::string_view numberLater = "\x01";  // the comparison's number
inline constexpr std::string_view titleLater = "\x02";   // its title
inline constexpr std::string_view folderLater = "\x03";  // the report's folder and a slash, in junit.xml

struct ReportLayout {
    std::vector<std::string> ids;  // per comparison: its number, by which its places in the page are called
    bool part = false;             // of a report of many scenes: numbers and titles come later
    std::vector<std::string> exr;  // per frame; empty: it gets none
    std::vector<std::vector<ChannelPictures>> pictures;  // per comparison and channel
    std::vector<std::string> cause_maps;  // per comparison: of Comparison::explained; empty: it has none
    // A picture's name per Report::closer_paths and channel of it.
    std::vector<std::vector<std::string>> closer_paths;
    std::string folder;                           // of all scenes: names in the page leave it out
    std::vector<std::size_t> order;               // the comparisons as the page shows them
    std::vector<std::string> sections;            // per comparison: its file, where it has one
    std::map<std::string, std::string> embedded;  // --single-file: picture -> data URI
    double encode_ms = 0;                         // EXRs, pictures and values
    bool single_file = false;
    Keep keep = Keep::all;

    std::vector<std::string> files() const;  // all of a report, sorted; not the embedded pictures
    const std::string& source(const std::string& picture) const;  // for the page: its name or data URI
};

// Names are "deferred.exr", "lit.deferred.png", "lit.values.js"; of several scenes or cameras each stands in
// a folder, "gallery/entrance/comparison.section.js" (ReportFolders). Pictures and EXRs that are not to be
// kept have no name. Of a part (ReportOptions::scene_folder) every comparison has a section. A single file
// has neither EXRs, values nor sections beside it, and its pictures are embedded.
ReportLayout layoutOf(const Report& report, const ReportOptions& options);

// What junit.xml may name as a file: of a single page no picture.
ReportLayout onDisk(const ReportLayout& layout);

}  // namespace diptych
