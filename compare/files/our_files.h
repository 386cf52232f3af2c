// SPDX-License-Identifier: MIT
// How diptych knows again what it wrote.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Every JSON, EXR and PNG of ours says so: what to look for, and what to write.
inline constexpr const char* softwareName = "diptych";

// A JSON file that says "software": "diptych" and "schema": 1.
bool isOurManifest(const std::filesystem::path& file);

// What a manifest of ours lists under "files": plain names that end as files of ours do, so that an edited
// list reaches neither outside the folder nor what diptych never writes. Empty where the manifest is not
// ours.
std::vector<std::string> listedIn(const std::filesystem::path& manifest);

// A file's name as diptych gives them in a folder that it writes: "lit.png" or, of several Frames,
// "1/lit.png".
bool isOurName(const std::filesystem::path& name);

// `manifest` in the folder and what it lists, where the manifest is ours.
std::vector<std::string> manifestFiles(const std::filesystem::path& folder, const std::string& manifest);

// An EXR or PNG that names diptych as its software.
bool isOurPicture(const std::filesystem::path& file);

}  // namespace diptych
