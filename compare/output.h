// SPDX-License-Identifier: MIT
// Where a command writes, and what it may replace.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

enum class OutputKind { folder, exr, png };

struct Output {
    OutputKind kind = OutputKind::folder;
    std::filesystem::path path;
};

// By the ending of `out`: .exr, .png, or none for a folder; an existing folder or a name that ends in a slash
// is one whatever its ending. Throws std::runtime_error naming -o for any other ending.
Output outputOf(const std::filesystem::path& out);

// ".NAME.what" beside an output: where what is done of it is kept until it is whole.
std::filesystem::path besideOutput(const std::filesystem::path& out, const std::string& what);

// Every JSON, EXR and PNG of ours says so: what to look for, and what to write.
inline constexpr const char* softwareName = "diptych";

// A JSON file that says "software": "diptych" and "schema": 1.
bool isOurMark(const std::filesystem::path& file);

// What a mark of ours lists under "files": plain names that end as files of ours do, so that an edited list
// reaches neither outside the folder nor what diptych never writes. Empty where the mark is not ours.
std::vector<std::string> listedIn(const std::filesystem::path& mark);

// A file's name as diptych gives them in a folder that it writes: "lit.png" or, of several Frames,
// "1/lit.png".
bool isOurName(const std::filesystem::path& name);

// `mark` in the folder and what it lists, where the mark is ours.
std::vector<std::string> markedIn(const std::filesystem::path& folder, const std::string& mark);

// An EXR or PNG that names diptych as its software, or a folder that is empty or holds `mark`, a JSON file of
// ours, may be replaced; whatever else is there needs `force`. Throws std::runtime_error naming
// -o. Files of others in such a folder are left alone. What a killed program left half done in a folder is
// completed first.
void checkReplaceable(const Output& output, const std::string& mark, bool force);

}  // namespace diptych
