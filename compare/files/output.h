// SPDX-License-Identifier: MIT
// Where a command writes, and which existing files it may replace.
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
// is one whatever its ending. Throws std::runtime_error naming -o for any other ending, unless the command
// writes nothing but folders.
Output outputOf(const std::filesystem::path& out, bool folders_alone = false);

// The file that `out` itself is a link to, else `out`: the link that a user names is kept, while those that
// are found in a folder are replaced (AtomicFile).
std::filesystem::path linkedFile(const std::filesystem::path& out);

// ".NAME.what" beside an output: holds the finished part of it until all of it is done.
std::filesystem::path besideOutput(const std::filesystem::path& out, const std::string& what);

// An EXR or PNG that names diptych as its software, or a folder that is empty or holds `manifest`, a JSON
// file of ours, may be replaced; whatever else is there needs `force`. Throws std::runtime_error naming -o.
// Files of others in such a folder are left alone. Moves that a killed program began in the folder are
// finished first.
void checkReplaceable(const Output& output, const std::string& manifest, bool force);

}  // namespace diptych
