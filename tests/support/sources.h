// SPDX-License-Identifier: MIT
// The repository's files, for tests that check them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace diptych {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;  // path from the repository's root -> contents
using Faults = std::vector<std::string>;

// Every source, shader, script and page of the repository.
inline const Files& sources() {
    static const Files files = [] {
        const fs::path root = DIPTYCH_SOURCE_DIR;
        Files found;
        const auto add = [&](const fs::path& file) {
            std::ifstream stream(file, std::ios::binary);
            found[fs::relative(file, root).generic_string()] = {std::istreambuf_iterator<char>(stream), {}};
        };
        for (const auto& entry : fs::directory_iterator(root))
            if (entry.is_regular_file()) add(entry.path());
        for (const char* folder :
             {"shared", "shaders", "forward_plus", "deferred", "compare", "tests", ".ci"})
            if (fs::is_directory(root / folder))
                for (const auto& entry : fs::recursive_directory_iterator(root / folder))
                    if (entry.is_regular_file()) add(entry.path());
        return found;
    }();
    return files;
}

inline bool endsIn(const std::string& path, std::initializer_list<const char*> endings) {
    return std::ranges::any_of(endings, [&](const char* ending) { return path.ends_with(ending); });
}
inline bool isCode(const std::string& path) {
    return endsIn(path, {".cpp", ".h", ".glsl", ".vert", ".frag", ".comp"});
}

inline std::string joined(const Faults& faults) {
    std::string all;
    for (const std::string& fault : faults) all += fault + "\n";
    return all;
}

// Paths of the quoted includes, from the root. The file's own folder is searched first.
inline std::vector<std::string> quotedIncludes(const Files& files, const std::string& path) {
    static const std::regex include("^[ \t]*#[ \t]*include[ \t]*\"([^\"]+)\"");
    std::vector<std::string> targets;
    std::istringstream lines(files.at(path));
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (line.find("include") == line.npos || !std::regex_search(line, match, include)) continue;
        const fs::path named = match[1].str();
        const std::string beside = (fs::path(path).parent_path() / named).lexically_normal().generic_string();
        targets.push_back(files.contains(beside) ? beside : named.lexically_normal().generic_string());
    }
    return targets;
}

}  // namespace diptych
