// SPDX-License-Identifier: MIT
// index.html: one page without external resources, readable from file://.
#pragma once

#include "compare/report/layout.h"
#include "compare/report/texts.h"
#include "compare/verdict/comparison.h"

#include <string>

namespace diptych {

// Needs the report's Frames; report and layout must outlive the result.
ReportTexts textsOf(const Report& report, const ReportLayout& layout);

// The second overload takes everything that depends on pixels from `texts`, so it needs no Frames.
std::string reportHtml(const Report& report, const ReportLayout& layout);
std::string reportHtml(const Report& report, const ReportLayout& layout, const ReportTexts& texts);

// One comparison and its title, which is empty if there is only one comparison. In a part of a report,
// numberLater and titleLater replace number and title.
std::string section(const Report& report, const ReportLayout& layout, std::size_t index);
std::string sectionTitle(const Report& report, const ReportLayout& layout, std::size_t index);

// One comparison as a script that adds it to the page: the contents of a file of layout.sections. In a
// part, the script names its file instead of the comparison.
std::string sectionScript(const Report& report, const ReportLayout& layout, std::size_t index);

// A link to cardId() that shows the channel's name.
std::string cardLink(const std::string& comparison, const DebugMode& mode);

// Parts of the page; `index` is the index of the comparison.
std::string checksSection(const Report& report, const ReportLayout& layout, std::size_t index);
// Empty for one comparison.
std::string indexTable(const Report& report, const ReportLayout& layout, const ReportTexts& texts);
// The cards of leadingChannels(), and those of the other channels.
std::string leadingCards(const Report& report, const ReportLayout& layout, std::size_t index);
std::string otherCards(const Report& report, const ReportLayout& layout, std::size_t index);
// Histogram and worst pixels for the card with this `id`.
std::string errorFigures(const ChannelDiff& channel, const ChannelPictures& pictures, const std::string& id);
// Empty without a reference.
std::string closerPathSection(const Report& report, const ReportLayout& layout, const ReportTexts& texts);
// One box of closerPathSection().
std::string closerPathBox(const Report& report, const ReportLayout& layout, std::size_t index);
std::string frameTables(const Report& report, const Comparison& comparison);

}  // namespace diptych
