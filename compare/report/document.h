// SPDX-License-Identifier: MIT
// A comparison as blocks for the terminal and the page, and the page of a report.
#pragma once

#include "compare/output/document.h"
#include "compare/report/layout.h"
#include "compare/report/texts.h"
#include "compare/verdict/comparison.h"

#include <string>
#include <vector>

namespace diptych {

// Needs the report's Frames; report and layout must outlive the result.
ReportTexts textsOf(const Report& report, const ReportLayout& layout);

// index.html: one page without external resources, readable from file://. Takes everything that depends on
// pixels from `texts`, so it needs no Frames.
std::string reportHtml(const Report& report, const ReportLayout& layout, const ReportTexts& texts);

// One comparison as a script that adds it to the page: the contents of a file of layout.sections. In a
// part, the script names its file instead of the comparison.
std::string sectionScript(const Report& report, const ReportLayout& layout, std::size_t index);
// The comparison's title in the page, which is empty if there is only one comparison. In a part of a
// report, indexPlaceholder and titleLater replace number and title.
std::string sectionTitle(const Report& report, const ReportLayout& layout, std::size_t index);

// Describe one comparison, and which path is closer to the reference. `layout`: the page's; nullptr: for a
// terminal. `index`: in Report::comparisons, or closer_paths. `several`: names scene, camera and time.
std::vector<output::Block> comparisonBlocks(const Report& report, const ReportLayout* layout,
                                            std::size_t index);
std::vector<output::Block> closerPathBlocks(const Report& report, const ReportLayout* layout,
                                            std::size_t index, bool several);

// Parts of them.
// `files`: with the metrics that users of diff expect.
output::Table channelTable(const Comparison& comparison, const std::string& id, bool files);
output::Block cardOf(const Report& report, const ReportLayout& layout, std::size_t index,
                     const ChannelDiff& channel, bool open);
// Histogram and worst pixels for the card with this `id`.
std::string errorMetrics(const ChannelDiff& channel, const ChannelImages& images, const std::string& id);
void addVisualChecks(std::vector<output::Block>& blocks, const Report& report, const ReportLayout& layout,
                     std::size_t index);
output::List frameLines(const Frame& baseline, const Frame& test);
void addFrames(std::vector<output::Block>& blocks, const Report& report, const Comparison& comparison);

// Lines of several comparisons; nothing for one.
std::vector<output::Block> indexBlocks(const Report& report, const ReportLayout& layout,
                                       const ReportTexts& texts);

// A channel's anchor in the page, "c0-lit", and a link to it. `comparison`: from ReportLayout::ids.
std::string cardId(const std::string& comparison, const DebugMode& mode);
output::Span cardLink(const std::string& comparison, const DebugMode& mode);

// A sentence names what decided the channel, the pixel with the largest error, and the tolerance with its
// reason. The pixel links to the `card` with this id.
output::Text findingOf(const ChannelDiff& channel, const std::string& card);

}  // namespace diptych
