// SPDX-License-Identifier: MIT
// Parts shared by the pages of quantities and of relations.
#pragma once

#include "compare/audit/case.h"
#include "compare/output/document.h"

#include <optional>
#include <string>
#include <vector>

namespace diptych::audit {

// `passes`: the verdict in the heading; empty: none. `files`: linked at the end.
output::Document pageOf(const Audited& audited, const std::string& title, const std::string& about,
                        const std::vector<std::string>& files, std::optional<bool> passes);
void addNotes(output::Document& page, const std::vector<std::string>& notes);

}  // namespace diptych::audit
