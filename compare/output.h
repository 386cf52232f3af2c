// SPDX-License-Identifier: MIT
// Where a command writes, and what it may replace.
#pragma once

#include <filesystem>
#include <string>

namespace diptych {

enum class OutputKind { folder, exr, png };

struct Output {
    OutputKind kind = OutputKind::folder;
    std::filesystem::path path;
};

// By the ending of `out`: .exr, .png, or none for a folder; an existing folder or a name that ends in a slash
// is one whatever its ending. Throws std::runtime_error naming -o for any other ending.
Output outputOf(const std::filesystem::path& out);

// A file that says in its first bytes that diptych wrote it, or a folder that is empty or holds `mark`, a
// JSON file of ours, may be replaced; whatever else is there needs `force`. Throws std::runtime_error naming
// -o. Files of others in such a folder are left alone.
void checkReplaceable(const Output& output, const std::string& mark, bool force);

}  // namespace diptych
