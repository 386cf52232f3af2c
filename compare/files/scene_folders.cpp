// SPDX-License-Identifier: MIT
#include "compare/files/scene_folders.h"

#include "shared/text/input_file.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// About half a million scenes.
constexpr std::uint64_t max_list_bytes = std::uint64_t(64) << 20;
constexpr std::size_t longest_line = 4096;  // PATH_MAX

bool isSceneFile(const fs::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".gltf" || ending == ".glb";
}

bool isHidden(const fs::path& path) {
    return path.filename().string().starts_with('.');
}

std::vector<std::string> sceneFilesIn(const std::string& folder) {
    std::vector<std::string> files;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        if (isHidden(at->path()) && at->is_directory(ignored)) at.disable_recursion_pending();
        if (!isHidden(at->path()) && isSceneFile(at->path()) && at->is_regular_file(ignored))
            files.push_back(at->path().generic_string());
    }
    if (error) throw std::runtime_error(fmt::format("{}: {}", oneLine(folder), error.message()));
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> partsOf(const std::string& pattern) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at < pattern.size();) {
        const std::size_t end = std::min(pattern.find('/', at), pattern.size());
        if (end > at) parts.push_back(pattern.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

bool hasWildcard(const std::string& text) {
    return text.find_first_of("*?[") != text.npos;
}

// Sorted names in a folder; empty if it is unreadable, as in a shell.
std::vector<std::string> namesIn(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
         at.increment(error))
        names.push_back(at->path().filename().string());
    std::ranges::sort(names);
    return names;
}

// Adds paths that match parts[at...] below `folder`.
void match(const fs::path& folder, const std::vector<std::string>& parts, std::size_t at,
           std::vector<fs::path>& found) {
    std::error_code ignored;
    if (at == parts.size()) {
        found.push_back(folder);
        return;
    }
    const std::string& part = parts[at];
    if (part == "**") {
        match(folder, parts, at + 1, found);
        for (const std::string& name : namesIn(folder))
            if (!isHidden(name) && fs::is_directory(fs::symlink_status(folder / name, ignored)))
                match(folder / name, parts, at, found);
    } else if (!hasWildcard(part)) {
        if (fs::exists(folder / part, ignored)) match(folder / part, parts, at + 1, found);
    } else {
        for (const std::string& name : namesIn(folder))
            if (::fnmatch(part.c_str(), name.c_str(), FNM_PERIOD) == 0)
                match(folder / name, parts, at + 1, found);
    }
}

std::vector<std::string> matchesOf(const std::string& pattern) {
    std::vector<fs::path> found;
    match(pattern.starts_with('/') ? "/" : "", partsOf(pattern), 0, found);
    std::vector<std::string> files;
    for (const fs::path& path : found) {
        std::error_code ignored;
        if (fs::is_directory(path, ignored))
            std::ranges::move(sceneFilesIn(path.generic_string()), std::back_inserter(files));
        else if (isSceneFile(path))
            files.push_back(path.generic_string());
    }
    std::ranges::sort(files);  // "a/**" reaches a file in several ways
    return files;
}

class SceneWords {
public:
    void add(const std::string& word) {
        std::error_code ignored;
        if (word.starts_with('@') && !fs::exists(word, ignored))
            addList(word.substr(1));
        else if (fs::is_directory(word, ignored))
            addAll(sceneFilesIn(word), word,
                   "contains no .gltf or .glb file; give a folder that does, or a scene");
        else if (isPattern(word))
            addAll(matchesOf(word), word, "matches no .gltf or .glb file");
        else
            addOne(word);
    }
    std::vector<std::string> scenes;

private:
    static bool isPattern(const std::string& word) {
        std::error_code ignored;
        return !word.starts_with("builtin:") && hasWildcard(word.substr(0, word.rfind("?scene="))) &&
               !fs::exists(word, ignored);
    }

    void addOne(const std::string& scene) {
        refuseLineBreak(scene);
        if (seen_.insert(scene).second) scenes.push_back(scene);
    }

    void addAll(const std::vector<std::string>& files, const std::string& word, const char* where_none) {
        if (files.empty()) throw std::runtime_error(fmt::format("{}: {}", oneLine(word), where_none));
        for (const std::string& file : files) addOne(file);
    }

    // Converts a line of a list to a command-line word.
    static std::string wordOf(std::string line, const fs::path& folder) {
        for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1))
            if (at == 0 || std::isspace(static_cast<unsigned char>(line[at - 1])) != 0) line.resize(at);
        const auto isSpace = [](unsigned char c) { return std::isspace(c) != 0; };
        line.erase(line.begin(), std::ranges::find_if_not(line, isSpace));
        while (!line.empty() && isSpace(static_cast<unsigned char>(line.back()))) line.pop_back();
        if (line.empty() || line.starts_with("builtin:")) return line;
        const bool list = line.starts_with('@');
        return (list ? "@" : "") + (folder / line.substr(list)).lexically_normal().generic_string();
    }

    void addList(const std::string& name) {
        const std::string identity = fs::weakly_canonical(name).string();
        if (!open_.insert(identity).second)
            throw std::runtime_error(fmt::format("@{}: is a list that contains itself", oneLine(name)));
        std::istringstream stream(
            diptych::named("@" + oneLine(name), [&] { return textIn(name, max_list_bytes); }));
        const std::size_t before = scenes.size();
        bool any = false;
        for (std::string line; std::getline(stream, line);) {
            if (line.size() > longest_line)
                throw std::runtime_error(fmt::format("@{}: has a line of {} bytes; the limit is {}",
                                                     oneLine(name), line.size(), longest_line));
            if (const std::string word = wordOf(line, fs::path(name).parent_path()); !word.empty()) {
                add(word);
                any = true;
            }
        }
        open_.erase(identity);
        if (!any && scenes.size() == before)
            throw std::runtime_error(fmt::format("@{}: lists no scene; give one per line", oneLine(name)));
    }

    std::set<std::string> seen_, open_;
};

}  // namespace

std::vector<std::string> scenesOf(const std::vector<std::string>& words) {
    SceneWords all;
    for (const std::string& word : words) all.add(word);
    return all.scenes;
}

}  // namespace diptych
