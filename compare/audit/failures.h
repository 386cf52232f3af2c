// SPDX-License-Identifier: MIT
#pragma once

#include "compare/audit/audit.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace diptych::audit {

// Where a quantity's first precise series breaks (of what breaks nearest to the usual magnitude), reduced and
// added to its failures, its files to `scenes`; nothing where none breaks. `folder`: where the files will be.
// A command that shows it is one that was tried: its words name files of `trial.folder`, where they are until
// then, and trial.fails() says whether it exits with 1. Without one that does there is no command.
struct Trial {
    std::filesystem::path folder;
    std::vector<std::string> words;  // of every command: the device
    std::function<bool(const std::vector<std::string>& words)> fails;
};
void addFailures(QuantityAudit& of, const Subject& subject, Measurer& measurer, const Trial& trial,
                 const std::filesystem::path& folder, std::map<std::string, std::string>& scenes);

}  // namespace diptych::audit
