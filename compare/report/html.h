// SPDX-License-Identifier: MIT
// index.html: one page without external resources, readable from file://.
#pragma once

#include "compare/diff.h"
#include "compare/report/layout.h"

#include <string>

namespace diptych {

std::string reportHtml(const Report& report, const ReportLayout& layout);

// Its parts. `index` is the comparison's.
std::string marksSection(const Report& report, const ReportLayout& layout, std::size_t index);
std::string channelCards(const Report& report, const ReportLayout& layout, std::size_t index);
std::string frameTables(const Report& report, const Comparison& comparison);

}  // namespace diptych
