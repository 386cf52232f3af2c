// SPDX-License-Identifier: MIT
#pragma once

#include "compare/output/document.h"
#include "compare/verdict/comparison.h"

#include <string>

namespace diptych {

// A channel's anchor in the page, "c0-lit". `comparison`: from ReportLayout::ids.
std::string cardId(const std::string& comparison, const DebugMode& mode);

// A comparison's channels, failures first, for a terminal and the page. `id`: from ReportLayout::ids.
output::Table channelTable(const Comparison& comparison, const std::string& id);

}  // namespace diptych
