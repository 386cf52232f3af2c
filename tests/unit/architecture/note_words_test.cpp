// SPDX-License-Identifier: MIT
// Every note of the readers of scenes and images has a test that says its words. A row of
// unit/shared/scene/gltf/notes_test.cpp, or the test of its reader, is where a new note belongs.
#include "tests/support/sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <regex>
#include <string>
#include <vector>

namespace diptych {
namespace {

// The literals of a statement that starts at `from`; adjacent ones are one.
std::vector<std::string> literalsIn(const std::string& code, std::size_t from) {
    std::vector<std::string> literals;
    std::size_t end = std::string::npos;  // of the last literal
    for (std::size_t i = from; i < code.size() && code[i] != ';'; ++i) {
        if (code[i] != '"') continue;
        std::size_t close = i + 1;
        while (code[close] != '"') close += code[close] == '\\' ? 2 : 1;
        const bool joins = end != std::string::npos && code.find_first_not_of(" \n", end) == i;
        if (!joins) literals.emplace_back();
        literals.back() += code.substr(i + 1, close - i - 1);
        i = close;
        end = close + 1;
    }
    return literals;
}

// The longest part of the literals without a {}.
std::string longestWords(const std::vector<std::string>& literals) {
    static const std::regex field(R"(\{[^{}]*\})");
    std::string longest;
    for (const std::string& literal : literals)
        for (std::sregex_token_iterator part(literal.begin(), literal.end(), field, -1), none; part != none;
             ++part)
            if (part->length() > static_cast<std::ptrdiff_t>(longest.size())) longest = part->str();
    return longest.substr(std::min(longest.find_first_not_of(": "), longest.size()));
}

// `code` with adjacent literals as one.
std::string withoutSeams(const std::string& code) {
    std::string text;
    for (std::size_t i = 0; i < code.size(); ++i) {
        const std::size_t next = code[i] == '"' ? code.find_first_not_of(" \n", i + 1) : code.npos;
        if (next != code.npos && next > i + 1 && code[next] == '"')
            i = next;
        else
            text += code[i];
    }
    return text;
}

// The notes' words that `tests` lack, as "file: words".
Faults untested(const Files& files, const std::string& tests) {
    static const std::regex adds(R"((notes?_?(\.|->)(push_back|emplace_back|add)|\bnote)\()");
    Faults faults;
    for (const auto& [path, code] : files) {
        if (!path.starts_with("shared/scene/") && !path.starts_with("shared/image/")) continue;
        for (std::sregex_iterator at(code.begin(), code.end(), adds), none; at != none; ++at) {
            const std::string words =
                longestWords(literalsIn(code, static_cast<std::size_t>(at->position() + at->length())));
            // Shorter ones add a name to another text.
            if (words.size() >= 12 && tests.find(words) == tests.npos) faults.push_back(path + ": " + words);
        }
    }
    return faults;
}

TEST(NoteWords, StandInATest) {
    std::string tests;
    for (const auto& [path, code] : sources())
        if (path.starts_with("tests/unit/shared/") && isCode(path)) tests += withoutSeams(code);
    EXPECT_EQ(joined(untested(sources(), tests)), "");
    // Negative control: a note that no test names.
    const Files added{{"shared/scene/new.cpp",
                       "void f() { notes.push_back(fmt::format(\"{}: a beam was \"\n\"bent\", who)); }"}};
    EXPECT_EQ(untested(added, tests), Faults{"shared/scene/new.cpp: a beam was bent"});
    EXPECT_EQ(untested(added, withoutSeams("\"x: a beam \"\n  \"was bent\"")), Faults{});
}

}  // namespace
}  // namespace diptych
