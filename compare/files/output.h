// SPDX-License-Identifier: MIT
// Output locations of commands, and files that they may replace.
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

// Kind by extension: .exr, .png, none for a folder. Existing folders and names with a trailing slash are
// always folders. Throws std::runtime_error naming -o for other extensions, unless `folders_alone`: the
// command writes only folders.
Output outputOf(const std::filesystem::path& out, bool folders_alone = false);

// ".NAME.what" beside an output, for finished parts of an unfinished output.
std::filesystem::path besideOutput(const std::filesystem::path& out, const std::string& what);

// Throws std::runtime_error naming the output if it cannot be written, or exists and must not be replaced.
// Without `force` only these may be: an EXR or PNG of ours, an empty folder, and a folder with our
// `manifest`. Foreign files in such a folder stay. First finishes moves of a killed program.
void checkReplaceable(const Output& output, const std::string& manifest, bool force);
// The same for a folder; returns the files of the earlier one.
std::vector<std::string> replaceable(const std::filesystem::path& folder, const std::string& manifest,
                                     bool force);

}  // namespace diptych
