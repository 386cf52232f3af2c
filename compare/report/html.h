// SPDX-License-Identifier: MIT
// index.html: one page without external resources, readable from file://.
#pragma once

#include "compare/report/layout.h"
#include "compare/verdict/comparison.h"

#include <string>

namespace diptych {

std::string reportHtml(const Report& report, const ReportLayout& layout);

// One comparison as a script that adds it to the page: the contents of a file of layout.sections.
std::string sectionScript(const Report& report, const ReportLayout& layout, std::size_t index);

// A channel's place in the page, "c0-lit", and a link to it that shows its name.
std::string cardId(std::size_t comparison, const DebugMode& mode);
std::string cardLink(std::size_t comparison, const DebugMode& mode);

// Parts of the page. `index` is the number of the comparison.
std::string checksSection(const Report& report, const ReportLayout& layout, std::size_t index);
std::string indexTable(const Report& report, const ReportLayout& layout);  // empty for one comparison
std::string channelCards(const Report& report, const ReportLayout& layout, std::size_t index);
// Histogram and worst pixels for the card with this `id`.
std::string errorFigures(const ChannelDiff& channel, const ChannelPictures& pictures, const std::string& id);
// Empty without a reference.
std::string closerPathSection(const Report& report, const ReportLayout& layout);
std::string frameTables(const Report& report, const Comparison& comparison);

}  // namespace diptych
