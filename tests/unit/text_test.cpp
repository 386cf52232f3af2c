// SPDX-License-Identifier: MIT
// Strings from outside: one line of them for a message, and how deep JSON nests before anything parses it.
#include "shared/text/json_depth.h"
#include "shared/text/one_line.h"

#include <gtest/gtest.h>

#include <string>

namespace diptych {
namespace {

TEST(OneLine, ControlCharactersAreShownAsQuestionMarks) {
    EXPECT_EQ(oneLine("a name"), "a name");
    EXPECT_EQ(oneLine("\xff\xc3(\xe4 \xed\xa0\x80"), std::string(2, '?') + "(" + "? " + std::string(3, '?'))
        << "no UTF-8: a lone byte, leads without their rest, half a pair of UTF-16";
    EXPECT_EQ(oneLine("\xf4\x90\x80\x80\xc0\x80"), std::string(6, '?'))
        << "beyond the last character, two bytes for one";
    EXPECT_EQ(oneLine("\u00e4\u20ac\U0001f600"), "\u00e4\u20ac\U0001f600");
    EXPECT_EQ(oneLine("a\nb\tc\x1b[1md\x7f"), "a?b?c?[1md?");
    EXPECT_EQ(oneLine(std::string_view("a\0b", 3)), "a?b");
    EXPECT_EQ(oneLine("größer"), "größer");
    EXPECT_EQ(oneLine(""), "");
}

TEST(OneLine, LongTextIsCutBetweenCharacters) {
    EXPECT_EQ(oneLine("abcdef", 6), "abcdef");
    EXPECT_EQ(oneLine("abcdefg", 6), "abcdef...");
    EXPECT_EQ(oneLine("aö", 2), "a...") << "ö takes the bytes 1 and 2";
    EXPECT_EQ(oneLine("\x80\x80\x80", 2), "...") << "no character begins here";
}

TEST(JsonDepth, CountsWhatIsOpenAtOnce) {
    EXPECT_EQ(jsonDepth(""), 0u);
    EXPECT_EQ(jsonDepth("1"), 0u);
    EXPECT_EQ(jsonDepth("[{}]"), 2u);
    EXPECT_EQ(jsonDepth("[[],[],[[]]]"), 3u);
    EXPECT_EQ(jsonDepth(R"({"a": "[[[[", "b\"[[": {}})"), 2u) << "brackets in strings are text";
    EXPECT_EQ(jsonDepth(R"(["\\", [1]])"), 2u) << "an escaped backslash does not keep a string open";
    EXPECT_EQ(jsonDepth(std::string(100000, '[')), 100000u);
    EXPECT_EQ(jsonDepth("]]][["), 2u) << "closing what was never open is no credit";
    EXPECT_EQ(jsonDepth("\"\\"), 0u) << "ends in the middle of an escape";
}

}  // namespace
}  // namespace diptych
