// SPDX-License-Identifier: MIT
// Names all files of a report, for the writers and the page.
#pragma once

#include "compare/image/channel_image.h"
#include "compare/page/emitted.h"
#include "compare/report/error_metrics.h"
#include "compare/report/report_options.h"
#include "compare/verdict/comparison.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// The images of one channel and the metrics shown with them; a name is empty if there is no such file.
struct ChannelImages {
    std::string baseline, test, difference;  // difference: empty if both are equal
    std::string same;                        // name of both images if identical
    std::string values;                      // valuesScript() of both Frames
    bool differ = false;
    bool kept = true;  // false: omitted because of --keep
    ImageScale scale;
    double error_top = 0;  // the error at the end of the error map's colours
    // The limit for each error in the map; empty if the verdict does not limit single errors.
    std::optional<double> error_limit;
    // The difference's; filled in by encode().
    ErrorHistogram histogram;
    std::vector<WorstPixel> worst;
};
inline constexpr std::size_t maxWorstPixels = 10;
inline constexpr int worstPixelSpacing = 8;  // pixels

// The number of comparisons in the page itself, failing ones first. Each of the others has a table row;
// its section loads on demand from its own file, or with --single-file from text in the page.
inline constexpr std::size_t comparisonsInPage = 4;

// Stand for what depends on the position in the report (parts.h).
using page::folderLater;
using page::indexPlaceholder;
using page::titleLater;

struct ReportLayout {
    std::vector<std::string> ids;  // per comparison: its index, used in anchors of the page
    bool part = false;             // of a report of many scenes: indices and titles come later
    std::vector<std::string> exr;  // per frame; empty: no EXR
    std::vector<std::vector<ChannelImages>> images;  // per comparison and channel
    std::vector<std::string> cause_maps;  // per comparison: image of Comparison::explained; may be empty
    // Image name per Report::closer_paths and its channel.
    std::vector<std::vector<std::string>> closer_paths;
    std::string folder;                 // common folder of all scenes, omitted from names in the page
    std::vector<std::size_t> order;     // the comparisons in the page's order
    std::vector<std::string> sections;  // per comparison: its file, or empty
    std::map<std::string, std::string> embedded;  // --single-file: image name -> data URI
    double encode_ms = 0;                         // time to write EXRs, images and values
    bool single_file = false;
    Keep keep = Keep::all;

    std::vector<std::string> files() const;  // all files of a report, sorted; without embedded images
    const std::string& source(const std::string& image) const;  // for the page: its name or data URI
};

// Names are "deferred.exr", "lit.deferred.png", "lit.values.js". With several scenes or cameras each is in
// a folder, "gallery/entrance/comparison.section.js" (ReportFolders). Images and EXRs that --keep omits
// have no name. In a part (ReportOptions::scene_folder) every comparison has a section. A single-file
// report has no EXRs, values or section files, and its images are embedded.
ReportLayout layoutOf(const Report& report, const ReportOptions& options);

// The layout with the files that junit.xml may name: no images for a single-file report.
ReportLayout onDisk(const ReportLayout& layout);

}  // namespace diptych
