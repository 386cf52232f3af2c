// SPDX-License-Identifier: MIT
#include "compare/output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <stdexcept>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// EXR attributes and PNG text stand before the pixels, within the first kilobytes.
bool isOurFile(const fs::path& file) {
    std::string head(4096, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    return head.find("diptych") != std::string::npos;
}

bool isOurFolder(const fs::path& folder, const std::string& mark) {
    if (fs::is_empty(folder)) return true;
    std::ifstream stream(folder / mark);
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    return json.is_object() && json.contains("schema");
}

}  // namespace

Output outputOf(const fs::path& out) {
    std::string ending = out.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::error_code ignored;
    if (ending.empty() || out.filename().empty() || fs::is_directory(out, ignored))
        return {OutputKind::folder, out};
    if (ending == ".exr") return {OutputKind::exr, out};
    if (ending == ".png") return {OutputKind::png, out};
    throw std::runtime_error(
        fmt::format("-o {}: {} cannot be written; use .exr, .png, or a name without ending for a folder",
                    out.string(), out.extension().string()));
}

void checkReplaceable(const Output& output, const std::string& mark, bool force) {
    std::error_code error;
    const fs::file_status there = fs::status(output.path, error);
    if (!fs::exists(there) || force) return;
    const bool ours = output.kind == OutputKind::folder
                          ? fs::is_directory(there) && isOurFolder(output.path, mark)
                          : fs::is_regular_file(there) && isOurFile(output.path);
    if (!ours)
        throw std::runtime_error(fmt::format(
            "-o {}: is there and was not written by diptych; --force replaces it", output.path.string()));
}

}  // namespace diptych
