// SPDX-License-Identifier: MIT
#include "compare/output.h"

#include "compare/report/report_folder.h"
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

// Both stand before the pixels: the EXR attribute (name, type, size, value) and the PNG chunk (size, type,
// keyword, text), byte for byte as they are written.
bool isOurFile(const fs::path& file) {
    using namespace std::string_literals;
    std::string head(1 << 16, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    const auto says = [&](const std::string& magic, const std::string& software) {
        return head.starts_with(magic) && head.find(software + softwareName) != std::string::npos;
    };
    return says("\x76\x2f\x31\x01"s, "software\0string\0\7\0\0\0"s) ||
           says("\x89PNG\r\n\x1a\n"s, "\0\0\0\x10tEXtSoftware\0"s);
}

// Null where the file is not ours.
nlohmann::json ourJson(const fs::path& file) {
    std::ifstream stream(file);
    nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
    const auto says = [&](const char* key, const auto& value) {
        return json.contains(key) && json[key] == value;
    };
    return json.is_object() && says("software", softwareName) && says("schema", 1) ? json : nlohmann::json();
}

bool isPlainName(const fs::path& name) {
    constexpr const char* endings[] = {".png", ".exr", ".html",      ".xml",       ".json",
                                       ".csv", ".svg", ".values.js", ".section.js"};
    return name.filename() == name && std::ranges::any_of(endings, [&](const char* ending) {
               return name.native().ends_with(ending) && !name.stem().empty() && name.native().front() != '.';
           });
}

// But for what is being written there just now, by this program or another.
bool isEmpty(const fs::path& folder) {
    const fs::path name = fs::canonical(folder);
    return std::ranges::all_of(fs::directory_iterator(folder), [&](const fs::directory_entry& entry) {
        return isTemporaryOf(name, entry.path().filename().string());
    });
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

fs::path besideOutput(const fs::path& out, const std::string& what) {
    fs::path path = fs::absolute(out).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    path = path.parent_path() / fmt::format(".{}.{}", path.filename().string(), what);
    return out.is_absolute() ? path : path.lexically_proximate(fs::current_path());
}

bool isOurMark(const fs::path& file) {
    return ourJson(file).is_object();
}

std::vector<std::string> listedIn(const fs::path& mark) {
    const nlohmann::json json = ourJson(mark);
    std::vector<std::string> names;
    if (json.contains("files") && json["files"].is_array())
        for (const auto& name : json["files"])
            if (name.is_string() && isPlainName(name.get<std::string>())) names.push_back(name);
    return names;
}

bool isOurName(const fs::path& name) {
    const std::string folder = name.parent_path().string();
    return isPlainName(name.filename()) &&
           std::ranges::all_of(folder, [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<std::string> markedIn(const fs::path& folder, const std::string& mark) {
    if (!isOurMark(folder / mark)) return {};
    std::vector<std::string> names = listedIn(folder / mark);
    if (std::ranges::count(names, mark) == 0) names.push_back(mark);
    return names;
}

void checkReplaceable(const Output& output, const std::string& mark, bool force) {
    std::error_code error;
    if (output.kind == OutputKind::folder && fs::is_directory(output.path, error)) finishPut(output.path);
    const fs::file_status there = fs::status(output.path, error);
    if (!fs::exists(there) || force) return;
    const bool ours = output.kind == OutputKind::folder
                          ? fs::is_directory(there) && (isEmpty(output.path) || isOurMark(output.path / mark))
                          : fs::is_regular_file(there) && isOurFile(output.path);
    if (!ours)
        throw std::runtime_error(fmt::format(
            "-o {}: is there and was not written by diptych; --force replaces it", output.path.string()));
}

}  // namespace diptych
