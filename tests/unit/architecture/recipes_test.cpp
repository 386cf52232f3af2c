// SPDX-License-Identifier: MIT
// Checks the documented recipes "to add X, touch": each recipe names exactly the files that mention an
// existing example. The documentation's table is the data; this file only has the words that identify each
// example.
#include "tests/support/sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace diptych {
namespace {

// File with the table, and the table's first line.
constexpr const char* table_file = "tests/architecture/README.md";
constexpr const char* table_head = "| to add | files | touch |";

// A row of the table, and the whole words that identify its example's files. Words in comments do not
// count, words in quotes do.
struct Example {
    std::string row;
    std::vector<std::string> words;
};
const std::vector<Example> examples = {
    {"a channel", {"X(6,  occlusion", "Channel::occlusion"}},
    {"a channel that bounds another", {"X(4,  roughness", "Channel::roughness"}},
    {"a channel of light", {"X(47, lit_sheen", "Channel::lit_sheen"}},
    {"a term of `lit`", {"X(42, lit_ambient", "Channel::lit_ambient"}},
    {"an input from vertex to fragment shader", {"v_color", "vertex_color", "FEATURE_vertex_color"}},
    {"a kind of area light",
     {"X(2, tube", "LightKind::tube", "\"tube\"", "light.length", "tubeLobes", "tubePoint", "tubeFactor"}},
    {"a path",
     {"Path::forward_plus", ".forward_plus", "\"forward_plus\"", "addForwardPlus", "addForwardPlusCapture",
      "diptych_forward_plus"}},
    {"a setting", {"pixel_lights", "pixel-lights"}},
    {"a setting whose values have names", {"LightKernel", "settings.light_kernel", "light-kernel"}},
    {"a report format", {"reportJunit", "junit.xml"}},
    {"a factor without a channel", {"clearcoat_normal_scale"}},
    {"a command", {"X(calibrate)", "calibrateCommand", "\"calibrate\""}},
    {"a column of results", {"X(registers", "Measure::registers", "\"registers\": {"}},
    {"an output format", {"std::string inCsv"}},
    {"a metric", {"mae"}},
};

// The program's sources; tests and documentation are not part of a recipe.
const Files& programSources() {
    static const Files files = [] {
        Files found;
        for (const auto& [path, text] : sources())
            if (!path.starts_with("tests/") && path.find('/') != std::string::npos && path.front() != '.' &&
                !endsIn(path, {".md", ".exr"}))
                found[path] = text;
        return found;
    }();
    return files;
}

std::string tablePage() {
    return sources().at(table_file);
}

// Whether the file type has C++ style comments.
bool hasComments(const std::string& path) {
    return isCode(path) || path.ends_with(".js");
}

// Removes comments, except inside quotes.
std::string withoutComments(const std::string& text) {
    std::string code;
    char quote = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (quote != 0) {
            code += text[i];
            if (text[i] == '\\' && i + 1 < text.size())
                code += text[++i];
            else if (text[i] == quote || text[i] == '\n')
                quote = 0;
        } else if (text.compare(i, 2, "//") == 0) {
            i = std::min(text.find('\n', i), text.size()) - 1;
        } else if (text.compare(i, 2, "/*") == 0) {
            const std::size_t end = text.find("*/", i + 2);
            i = end == std::string::npos ? text.size() : end + 1;
        } else {
            if (text[i] == '"') quote = text[i];
            code += text[i];
        }
    }
    return code;
}

bool isOfName(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool holdsWord(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        const bool begins = at == 0 || !isOfName(text[at - 1]) || !isOfName(word.front());
        if (begins && (end == text.size() || !isOfName(text[end]) || !isOfName(word.back()))) return true;
    }
    return false;
}

std::set<std::string> filesThatMention(const Files& files, const std::vector<std::string>& words) {
    std::set<std::string> found;
    for (const auto& [path, text] : files) {
        const auto isIn = [&](const std::string& where) {
            return std::ranges::any_of(words, [&](const std::string& w) { return holdsWord(where, w); });
        };
        if (isIn(text) && (!hasComments(path) || isIn(withoutComments(text)))) found.insert(path);
    }
    return found;
}

// The files and folders (with a final slash) of a row, and how many it says they are.
struct Recipe {
    std::set<std::string> names;
    std::string count;
};

// Rows of the table by what they add.
std::map<std::string, Recipe> recipesOf(const std::string& page) {
    static const std::regex path("`([^` ]*/[^` ]*)`");
    std::map<std::string, Recipe> recipes;
    std::istringstream lines(page.substr(std::min(page.find(table_head), page.size())));
    std::string line;
    for (int number = 0; std::getline(lines, line) && line.starts_with('|'); ++number) {
        if (number < 2) continue;  // the header and the rule below it
        const std::size_t count = line.find(" | ", 2), touch = line.find(" | ", count + 3);
        Recipe& recipe = recipes[line.substr(2, count - 2)];
        recipe.count = line.substr(count + 3, touch - count - 3);
        const std::string cell = line.substr(touch);
        for (std::sregex_iterator it(cell.begin(), cell.end(), path), end; it != end; ++it)
            recipe.names.insert((*it)[1].str());
    }
    return recipes;
}

Faults recipeFaults(const std::string& page, const Files& files) {
    const std::map<std::string, Recipe> recipes = recipesOf(page);
    Faults faults;
    for (const auto& [row, recipe] : recipes) {
        if (std::ranges::count(examples, row, &Example::row) == 0)
            faults.push_back(row + ": has no example that is looked for");
        if (const std::string named = std::to_string(recipe.names.size()); named != recipe.count)
            faults.push_back(row + ": says " + recipe.count + " files and names " + named);
    }
    for (const Example& example : examples) {
        const auto recipe = recipes.find(example.row);
        if (recipe == recipes.end()) {
            faults.push_back(example.row + ": is no row of the table in " + table_file);
            continue;
        }
        const std::set<std::string> found = filesThatMention(files, example.words);
        const auto covers = [](const std::string& name, const std::string& file) {
            return name == file || (name.ends_with('/') && file.starts_with(name));
        };
        for (const std::string& file : found)
            if (std::ranges::none_of(recipe->second.names,
                                     [&](const auto& name) { return covers(name, file); }))
                faults.push_back(example.row + ": " + file + " mentions " + example.words.front() +
                                 " and the recipe does not name it");
        for (const std::string& name : recipe->second.names)
            if (std::ranges::none_of(found, [&](const auto& file) { return covers(name, file); }))
                faults.push_back(example.row + ": the recipe names " + name + ", which does not mention " +
                                 example.words.front());
    }
    return faults;
}

TEST(Recipes, NameTheFilesThatMentionAnExample) {
    EXPECT_EQ(joined(recipeFaults(tablePage(), programSources())), "");
}

TEST(Recipes, AFileThatIsMissingOrTooManyIsFound) {
    const std::string page = tablePage();
    Files named;  // only files that the recipes mention
    for (const auto& [row, recipe] : recipesOf(page))
        for (const auto& source : programSources())
            if (std::ranges::any_of(recipe.names,
                                    [&](const auto& name) { return source.first.starts_with(name); }))
                named.insert(source);
    ASSERT_EQ(joined(recipeFaults(page, named)), "");
    const auto planted = [&](const std::string& file, const std::string& text) {
        Files files = named;
        files[file] = text;
        return recipeFaults(page, files);
    };
    EXPECT_EQ(
        planted("compare/planted.cpp", "int occlusion = Channel::occlusion;"),
        Faults{"a channel: compare/planted.cpp mentions X(6,  occlusion and the recipe does not name it"});
    EXPECT_EQ(planted("compare/planted.cpp", "// Channel::occlusion\n/* mae */ int Channel::occlusion2;"),
              Faults{})
        << "a comment, and a longer word";
    EXPECT_EQ(planted("compare/reference/channels.cpp", "// Channel::occlusion").size(), 4u)
        << "and the other examples of channels";

    const auto edited = [&](const std::string& from, const std::string& to) {
        std::string other = page;
        const std::size_t at = other.find(from, other.find(table_head));
        EXPECT_NE(at, std::string::npos) << from;
        return recipeFaults(other.replace(at, from.size(), to), named);
    };
    EXPECT_EQ(edited("| a metric | 4 | ", "| a metric | 5 | `compare/rules.h`, "),
              Faults{"a metric: the recipe names compare/rules.h, which does not mention mae"});
    EXPECT_EQ(edited("| a metric | 4 | ", "| a metric | 3 | "), Faults{"a metric: says 3 files and names 4"});
    EXPECT_EQ(edited("| a metric | ", "| a number | ").size(), 2u) << "an unknown row, and a missing one";
    EXPECT_EQ(recipeFaults("no table", named).size(), examples.size());
}

// Rows of the tables, a line of the reference.
TEST(Recipes, AChannelTakesTwoFiles) {
    for (const char* channel : {"a channel", "a channel of light"})
        EXPECT_EQ(recipesOf(tablePage()).at(channel).names,
                  (std::set<std::string>{"shared/contract/debug_mode.h", "compare/reference/channels.cpp"}));
}

}  // namespace
}  // namespace diptych
