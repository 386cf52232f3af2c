// SPDX-License-Identifier: MIT
#include "compare/files/output.h"

#include "compare/files/our_files.h"
#include "compare/files/output_folder.h"
#include "shared/image/temporary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <stdexcept>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// Ignores temporary files of running programs.
bool isEmpty(const fs::path& folder) {
    const fs::path name = fs::canonical(folder);
    return std::ranges::all_of(fs::directory_iterator(folder), [&](const fs::directory_entry& entry) {
        return isTemporaryOf(name, entry.path().filename().string());
    });
}

}  // namespace

Output outputOf(const fs::path& out, bool folders_alone) {
    std::string ending = out.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::error_code ignored;
    if (ending.empty() || out.filename().empty() || fs::is_directory(out, ignored))
        return {OutputKind::folder, out};
    if (ending == ".exr") return {OutputKind::exr, linkedFile(out)};
    if (ending == ".png") return {OutputKind::png, linkedFile(out)};
    if (folders_alone) return {OutputKind::folder, out};
    throw std::runtime_error(
        fmt::format("-o {}: cannot write {} files; use .exr, .png, or a name without extension for a folder",
                    out.string(), out.extension().string()));
}

fs::path linkedFile(const fs::path& out) {
    std::error_code ignored;
    return fs::is_symlink(fs::symlink_status(out, ignored)) ? fs::weakly_canonical(out, ignored) : out;
}

fs::path besideOutput(const fs::path& out, const std::string& what) {
    fs::path path = fs::absolute(out).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    path = path.parent_path() / fmt::format(".{}.{}", path.filename().string(), what);
    return out.is_absolute() ? path : path.lexically_proximate(fs::current_path());
}

void checkReplaceable(const Output& output, const std::string& manifest, bool force) {
    std::error_code error;
    if (output.kind == OutputKind::folder && fs::is_directory(output.path, error)) finishOutput(output.path);
    const fs::file_status there = fs::status(output.path, error);
    if (!fs::exists(there) || force) return;
    const bool ours =
        output.kind == OutputKind::folder
            ? fs::is_directory(there) && (isEmpty(output.path) || isOurManifest(output.path / manifest))
            : fs::is_regular_file(there) && isOurPicture(output.path);
    if (!ours)
        throw std::runtime_error(fmt::format(
            "-o {}: exists and was not written by diptych; --force replaces it", output.path.string()));
}

}  // namespace diptych
