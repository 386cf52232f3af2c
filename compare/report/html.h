// SPDX-License-Identifier: MIT
// index.html: one page without external resources, readable from file://.
#pragma once

#include "compare/report/layout.h"
#include "compare/report/texts.h"
#include "compare/verdict/comparison.h"

#include <string>

namespace diptych {

// Of a report that has its Frames; report and layout must outlive them.
ReportTexts textsOf(const Report& report, const ReportLayout& layout);

// `texts` stand for what the report's Frames hold of pixels, which they need not have then.
std::string reportHtml(const Report& report, const ReportLayout& layout);
std::string reportHtml(const Report& report, const ReportLayout& layout, const ReportTexts& texts);

// One comparison, and its title, empty where there is one alone; of a part with numberLater and titleLater in
// their places.
std::string section(const Report& report, const ReportLayout& layout, std::size_t index);
std::string sectionTitle(const Report& report, const ReportLayout& layout, std::size_t index);

// One comparison as a script that adds it to the page: the contents of a file of layout.sections. That of a
// part says which file it is and not which comparison.
std::string sectionScript(const Report& report, const ReportLayout& layout, std::size_t index);

// A channel's place in the page, "c0-lit", and a link to it that shows its name; of ReportLayout::ids.
std::string cardId(const std::string& comparison, const DebugMode& mode);
std::string cardLink(const std::string& comparison, const DebugMode& mode);

// Parts of the page. `index` is the number of the comparison.
std::string checksSection(const Report& report, const ReportLayout& layout, std::size_t index);
// Empty for one comparison.
std::string indexTable(const Report& report, const ReportLayout& layout, const ReportTexts& texts);
// The cards of leadingChannels(), and those of the others.
std::string leadingCards(const Report& report, const ReportLayout& layout, std::size_t index);
std::string otherCards(const Report& report, const ReportLayout& layout, std::size_t index);
// Histogram and worst pixels for the card with this `id`.
std::string errorFigures(const ChannelDiff& channel, const ChannelPictures& pictures, const std::string& id);
// Empty without a reference.
std::string closerPathSection(const Report& report, const ReportLayout& layout, const ReportTexts& texts);
std::string closerPathBox(const Report& report, const ReportLayout& layout, std::size_t index);  // one of it
std::string frameTables(const Report& report, const Comparison& comparison);

}  // namespace diptych
