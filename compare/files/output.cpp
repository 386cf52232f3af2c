// SPDX-License-Identifier: MIT
#include "compare/files/output.h"

#include "compare/files/diptych_files.h"
#include "compare/files/linked_file.h"
#include "compare/files/output_folder.h"
#include "shared/image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <stdexcept>
#include <system_error>

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

[[noreturn]] void fail(const fs::path& out, const std::string& why) {
    throw std::runtime_error(fmt::format("-o {}: {}", out.string(), why));
}

// Throws if it is certain that nothing can be written there, also with --force.
void checkWritable(const Output& output) {
    std::error_code error;
    const fs::file_status there = fs::status(output.path, error);
    const bool folder = output.kind == OutputKind::folder;
    if (fs::is_other(there))
        fail(output.path, "is a device, pipe or socket; give the name of a file or folder");
    linkedFile(output.path);  // throws for links that must not be followed
    if (there.type() == fs::file_type::none)
        throw std::runtime_error(writingFailed(output.path, error.value()));
    if (folder && fs::is_regular_file(there))
        fail(output.path, "is a file, but a folder is written there; give another name");
    fs::path above = fs::absolute(output.path, error);
    if (!folder || !fs::is_directory(there)) above = above.parent_path();
    while (!fs::exists(above, error) && above.has_relative_path()) above = above.parent_path();
    const int why = !fs::is_directory(above, error)                                      ? ENOTDIR
                    : ::faccessat(AT_FDCWD, above.c_str(), W_OK | X_OK, AT_EACCESS) != 0 ? errno
                                                                                         : 0;
    if (why != 0) throw std::runtime_error(writingFailed(output.path, why));
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

fs::path besideOutput(const fs::path& out, const std::string& what) {
    fs::path path = fs::absolute(out).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    path = path.parent_path() / fmt::format(".{}.{}", path.filename().string(), what);
    return out.is_absolute() ? path : path.lexically_proximate(fs::current_path());
}

void checkReplaceable(const Output& output, const std::string& manifest, bool force) {
    checkWritable(output);
    std::error_code error;
    if (output.kind == OutputKind::folder && fs::is_directory(output.path, error)) finishOutput(output.path);
    const fs::file_status there = fs::status(output.path, error);
    if (!fs::exists(there) || force) return;
    const bool written_by_diptych =
        output.kind == OutputKind::folder
            ? fs::is_directory(there) && (isEmpty(output.path) || isDiptychManifest(output.path / manifest))
            : fs::is_regular_file(there) && isDiptychImage(output.path);
    if (!written_by_diptych) fail(output.path, "exists and was not written by diptych; --force replaces it");
}

std::vector<std::string> replaceable(const fs::path& folder, const std::string& manifest, bool force) {
    checkReplaceable({OutputKind::folder, folder}, manifest, force);
    return manifestFiles(folder, manifest);
}

}  // namespace diptych
