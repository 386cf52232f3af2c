// SPDX-License-Identifier: MIT
#pragma once

#include "compare/audit/audit.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace diptych::audit {

// Adds the reduced failure of a quantity's first precise series to its failures, and the files to
// `scenes`. It takes the failure nearest to the default magnitude; adds nothing if no series fails.
// `folder`: where the files will be. A failure's command was tried: its words name files in
// `trial.folder`, where they are until then, and trial.fails() returned true (it exits with 1). Otherwise
// there is no command.
struct Trial {
    std::filesystem::path folder;
    std::vector<std::string> words;  // of every command: the device
    std::function<bool(const std::vector<std::string>& words)> fails;
};
void addFailures(QuantityAudit& of, const Subject& subject, Measurer& measurer, const Trial& trial,
                 const std::filesystem::path& folder, std::map<std::string, std::string>& scenes);

}  // namespace diptych::audit
