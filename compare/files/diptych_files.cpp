// SPDX-License-Identifier: MIT
#include "compare/files/diptych_files.h"

#include "shared/text/input_file.h"
#include "shared/text/json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <span>
#include <stdexcept>
#include <string_view>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// The marks and the file list of our file; null if diptych did not write it.
nlohmann::json diptychJson(const fs::path& file) {
    try {
        nlohmann::json json = jsonIn(file, [](int depth, const std::string& key) {
            return depth > 1 || key == "software" || key == "schema" || key == "files";
        });
        const auto contains = [&](const char* key, const auto& value) {
            return json.contains(key) && json[key] == value;
        };
        if (json.is_object() && contains("software", softwareName) &&
            (contains("schema", 1) || contains("schema", 2)))
            return json;
    } catch (const std::runtime_error&) {  // unreadable or malformed
    }
    return {};
}

// Limits of file systems; our names are much shorter.
constexpr std::size_t longest_name = 255, longest_path = 1024;  // bytes

bool isPlainFile(const fs::path& name) {
    constexpr const char* endings[] = {".png", ".exr", ".html",      ".xml",       ".json",
                                       ".csv", ".svg", ".values.js", ".section.js"};
    return name.filename() == name &&
           std::ranges::any_of(endings,
                               [&](const char* ending) {
                                   return name.native().ends_with(ending) && !name.stem().empty() &&
                                          name.native().front() != '.';
                               }) &&
           std::ranges::none_of(name.native(), [](unsigned char c) { return std::iscntrl(c); });
}

// Names of nameOfFolder() in compare/report, and "1" for several Frames.
bool isPlainFolder(const fs::path& name) {
    return !name.empty() && name.native().size() <= longest_name &&
           std::ranges::all_of(name.native(),
                               [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
}

}  // namespace

// Both formats name the software before the pixels. Compares the EXR attribute (name, type, size, value)
// and the PNG chunk (size, type, keyword, text) byte for byte.
bool isDiptychImage(const fs::path& file) {
    using namespace std::string_literals;
    std::string head;
    try {
        InputFile image(file);
        head.resize(std::min<std::uint64_t>(image.size(), 1 << 16));
        image.read(std::as_writable_bytes(std::span(head)));
    } catch (const std::runtime_error&) {
        return false;
    }
    const auto contains = [&](const std::string& magic, const std::string& software) {
        return head.starts_with(magic) && head.find(software + softwareName) != std::string::npos;
    };
    return contains("\x76\x2f\x31\x01"s, "software\0string\0\7\0\0\0"s) ||
           contains("\x89PNG\r\n\x1a\n"s, "\0\0\0\x10tEXtSoftware\0"s);
}

bool isDiptychManifest(const fs::path& file) {
    return diptychJson(file).is_object();
}

bool isDiptychFileName(const fs::path& name) {
    const fs::path folders = name.parent_path();
    if (name.native().size() > longest_path || name.filename().native().size() > longest_name) return false;
    return isPlainFile(name.filename()) && std::ranges::all_of(folders, isPlainFolder);
}

std::vector<fs::path> foldersOf(const fs::path& name) {
    std::vector<fs::path> folders;
    for (fs::path folder = name.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
        folders.push_back(folder);
    return folders;
}

fs::path reportFile(const fs::path& report) {
    std::error_code ignored;
    return fs::is_directory(report, ignored) ? report / "report.json" : report;
}

std::vector<std::string> listedIn(const fs::path& manifest) {
    const nlohmann::json json = diptychJson(manifest);
    std::vector<std::string> names;
    if (json.contains("files") && json["files"].is_array())
        for (const auto& name : json["files"])
            if (name.is_string() && isDiptychFileName(name.get<std::string>())) names.push_back(name);
    return names;
}

std::vector<std::string> manifestFiles(const fs::path& folder, const std::string& manifest) {
    if (!isDiptychManifest(folder / manifest)) return {};
    std::vector<std::string> names = listedIn(folder / manifest);
    if (std::ranges::count(names, manifest) == 0) names.push_back(manifest);
    return names;
}

}  // namespace diptych
