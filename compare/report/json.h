// SPDX-License-Identifier: MIT
// report.json and junit.xml.
#pragma once

#include "compare/report/layout.h"
#include "compare/report/texts.h"
#include "compare/verdict/comparison.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// report.json, schema 1. JSON has no infinity: infinite statistics are null, and infinite_pixels counts
// their pixels. A forward-only channel's statistics are all null. `layout` may be nullptr.
//
// Keys whose names do not explain them:
//   said_first           notes that a reader needs before any number
//   devices              times of comparing and writing, by device; with several, compare_ms and encode_ms of
//                        the whole are null, because times of different devices are never added
//   drawn_on             a frame's device
//   errors, failures     scenes that could not be read or drawn; images that one of two folders lacks. With
//                        any, the verdict is "fail"
//   marks, marks_found   the visual checks of a comparison, and their number by feature
//   emptiness            why a comparison's images show nothing; null if they show something
//   explanation          what `explain --json` prints, or the only key not_explained with the reason; null
//                        unless lit fails or --explain asks. It ignores --mask and the like
//   criterion            what decided a channel; null if it is not evaluated. metric, its measured value, and
//                        its limit (least: the value must not be below). pixels_beyond and share_beyond count
//                        pixels over the limit; if no single pixel's error decides, differing_pixels and
//                        differing_share count all that differ
//   truth                per scene, camera and time compared with the reference: nearer, the closer path; by,
//                        how many times closer; nearer_pixels, the pixels at which each path is closer
std::string reportJson(const Report& report, const ReportLayout* layout, const Trends* since = nullptr);

// The arrays of report.json that need Frames, and the text of an array's elements without brackets.
inline constexpr std::array reportArrays{"frames", "comparisons", "truth"};
std::string arrayText(const Report& report, const ReportLayout* layout, std::size_t array);

// Writes report.json in pieces: `give` passes all elements of an array to the sink, one or several at once.
using JsonSink = std::function<void(std::string_view)>;
using GiveArray = std::function<void(std::size_t array, const JsonSink&)>;
void writeReportJson(const Report& report, const ReportLayout* layout, const std::vector<DrawnOn>& devices,
                     const Trends* since, const GiveArray& give, const JsonSink& sink);

// One test case per scene, camera and channel, and one more if a comparison fails for another reason. A
// failing channel's images are attachments in `folder`. CI servers resolve them against the job's working
// directory, so a relative folder stays relative.
std::string reportJunit(const Report& report, const ReportLayout& layout,
                        const std::filesystem::path& folder);

// One comparison's suite, and the document of all suites. `folder`: escaped, ending in a slash, or
// folderLater.
JunitSuite junitSuite(const Report& report, const ReportLayout& layout, const std::string& folder,
                      std::size_t index);
std::string junitFolder(const std::filesystem::path& folder);
void writeJunit(const Report& report, const JunitSuite& totals,
                const std::function<void(const JsonSink&)>& suites, const JsonSink& sink);

}  // namespace diptych
