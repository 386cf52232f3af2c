// SPDX-License-Identifier: MIT
#pragma once

#include "compare/audit/audit.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace diptych::audit {

inline constexpr const char* auditManifest = "audit.json";

// index.html of an audit: one page without external resources, readable from file://. Links `files`, other
// files of the folder.
std::string auditHtml(const Audit& audit, const std::vector<std::string>& files);

// Writes the folder: index.html, audit.json, audit.csv, a plot for each quantity (NAME.svg), and the
// reduced scenes. Returns the JSON. Throws std::runtime_error naming -o if the folder contains something
// else.
std::string writeAudit(const Audit& audit, const std::filesystem::path& folder, bool force);

}  // namespace diptych::audit
