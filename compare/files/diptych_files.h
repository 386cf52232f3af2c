// SPDX-License-Identifier: MIT
// Recognizes files written by diptych.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Software name in our JSON, EXR and PNG files.
inline constexpr const char* softwareName = "diptych";

// Whether the file is a manifest: JSON with "software": "diptych" and "schema": 1 or 2. A manifest marks its
// folder as ours.
bool isDiptychManifest(const std::filesystem::path& file);

// The file of a report, which may be named by its folder.
std::filesystem::path reportFile(const std::filesystem::path& report);

// Names in a manifest's "files", filtered by isDiptychFileName(). An edited list thus cannot name files
// outside the folder or files that diptych never writes. Empty if the file is not a manifest.
std::vector<std::string> listedIn(const std::filesystem::path& manifest);

// Whether diptych may write a file of this relative name: known extension, and folders of letters, digits,
// hyphens and underscores. For example "lit.png" or "Box-1c9f03/top/lit.png".
bool isDiptychFileName(const std::filesystem::path& name);

// Parent folders of a name, innermost first: "a/b", "a" for "a/b/lit.png".
std::vector<std::filesystem::path> foldersOf(const std::filesystem::path& name);

// Files in the folder's manifest, and the manifest itself. Empty without a manifest.
std::vector<std::string> manifestFiles(const std::filesystem::path& folder, const std::string& manifest);

// Whether an EXR or PNG names diptych as its software.
bool isDiptychImage(const std::filesystem::path& file);

}  // namespace diptych
