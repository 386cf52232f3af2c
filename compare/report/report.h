// SPDX-License-Identifier: MIT
// What a comparison leaves for people and for scripts.
#pragma once

#include "compare/command_line.h"
#include "compare/diff.h"
#include "compare/output.h"

#include <filesystem>
#include <string>

namespace diptych {

struct ReportOptions {
    PictureChoice picture;
    bool single_file = false;  // index.html holds its pictures, at half size
    bool force = false;        // also into a folder that is not a report of ours
};

// index.html, report.json, junit.xml, an EXR per frame and the page's pictures. Everything is written into a
// temporary folder first, so an earlier report stays whole until the new one is. Into a folder that is there
// the files are then moved one by one, report.json last; what the earlier report.json lists and the new one
// does not is removed, whatever else lies there is left alone. With several comparisons each one's files
// begin with its number, scene and camera. Returns the text of report.json. Throws std::runtime_error naming
// folder or file.
std::string writeReport(const Report& report, const std::filesystem::path& folder,
                        const ReportOptions& options);

// For a terminal: a table per comparison, failures first, then one line of verdict. Ends in a newline.
std::string reportTable(const Report& report);

// One Frame: an EXR of the channels asked for, a PNG of channel `shown`, or a folder with FRAME.exr,
// CHANNEL.png and frame.json. Throws std::runtime_error naming the file, or the channel where the Frame does
// not have it.
void writeFrame(const Frame& frame, const ReportDevice& device, const Output& output, const DebugMode& shown,
                const PictureChoice& choice, bool force);

}  // namespace diptych
