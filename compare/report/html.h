// SPDX-License-Identifier: MIT
// index.html: one page without external resources, readable from file://.
#pragma once

#include "compare/report/layout.h"
#include "compare/verdict/comparison.h"

#include <string>

namespace diptych {

std::string reportHtml(const Report& report, const ReportLayout& layout);

// One comparison as a script that puts it into the page: what layout.sections names.
std::string sectionScript(const Report& report, const ReportLayout& layout, std::size_t index);

// Its parts. `index` is the comparison's.
std::string checksSection(const Report& report, const ReportLayout& layout, std::size_t index);
std::string indexTable(const Report& report, const ReportLayout& layout);  // empty for one comparison
std::string channelCards(const Report& report, const ReportLayout& layout, std::size_t index);
// Histogram and worst pixels of the card `id`.
std::string errorFigures(const ChannelDiff& channel, const ChannelPictures& pictures, const std::string& id);
// Empty without a reference.
std::string closerPathSection(const Report& report, const ReportLayout& layout);
std::string frameTables(const Report& report, const Comparison& comparison);

}  // namespace diptych
