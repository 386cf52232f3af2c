// SPDX-License-Identifier: MIT
// How diptych recognises files that it wrote.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// The name of the software that every JSON, EXR and PNG of ours carries.
inline constexpr const char* softwareName = "diptych";

// Whether the file is a manifest: JSON with "software": "diptych" and "schema": 1. A manifest marks its
// folder as written by diptych.
bool isOurManifest(const std::filesystem::path& file);

// The names that a manifest lists under "files". Only those that isOurName() are returned, so that an edited
// list can name neither files outside the folder nor files that diptych never writes. Empty if the file is no
// manifest.
std::vector<std::string> listedIn(const std::filesystem::path& manifest);

// A file's name as diptych gives them in a folder that it writes, with an ending of its own: "lit.png", or
// "Box-1c9f03/top/lit.png", where folders are called by letters, digits, hyphens and underscores.
bool isOurName(const std::filesystem::path& name);

// The folders of a file's name, the innermost first: of "a/b/lit.png" "a/b" and "a".
std::vector<std::filesystem::path> foldersOf(const std::filesystem::path& name);

// The files that the folder's manifest lists, and the manifest itself. Empty if there is no manifest.
std::vector<std::string> manifestFiles(const std::filesystem::path& folder, const std::string& manifest);

// An EXR or PNG that names diptych as its software.
bool isOurPicture(const std::filesystem::path& file);

}  // namespace diptych
