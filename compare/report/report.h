// SPDX-License-Identifier: MIT
// What a comparison leaves for people and for scripts.
#pragma once

#include "compare/command_line.h"
#include "compare/diff.h"
#include "compare/output.h"
#include "compare/progress.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

struct ReportOptions {
    PictureChoice picture;
    bool single_file = false;  // index.html holds its pictures, at half size
    bool force = false;        // also into a folder that is not a report of ours
    Stage progress{};          // of writing it
};

// index.html, report.json, junit.xml, an EXR per frame and the page's pictures. Everything is written into a
// temporary folder first and put in place at once, so an earlier report stays whole until the new one is.
// What the earlier report.json lists and the new one does not is removed, whatever else lies there is left
// alone. With several comparisons each one's files begin with its number, scene and camera. Returns the text
// of report.json. Throws std::runtime_error naming folder or file.
std::string writeReport(const Report& report, const std::filesystem::path& folder,
                        const ReportOptions& options);

// For a terminal: a table per comparison, failures first, then one line of verdict. Ends in a newline.
std::string reportTable(const Report& report);

// One Frame: an EXR of the channels asked for, or a PNG of channel `shown`. Throws std::runtime_error naming
// the file, or the channel where the Frame does not have it.
void writeFrame(const Frame& frame, const ReportDevice& device, const Output& output, const DebugMode& shown,
                const PictureChoice& choice);

// Into the folder that is there: FRAME.exr, CHANNEL.png and frame.json, which lists all; returns their names.
std::vector<std::string> writeFrameFolder(const Frame& frame, const ReportDevice& device,
                                          const std::filesystem::path& folder, const DebugMode& shown,
                                          const PictureChoice& choice);

}  // namespace diptych
