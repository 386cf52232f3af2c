// SPDX-License-Identifier: MIT
#pragma once

#include "compare/audit/audit.h"

#include <filesystem>

namespace diptych::audit {

// Where a quantity's first precise series breaks (of what breaks nearest to the usual magnitude), reduced and
// added to its failures, its files to `scenes`; nothing where none breaks. `folder`: where the files will be.
void addFailures(QuantityAudit& of, const Subject& subject, Measurer& measurer,
                 const std::filesystem::path& folder, std::map<std::string, std::string>& scenes);

}  // namespace diptych::audit
