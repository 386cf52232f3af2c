// SPDX-License-Identifier: MIT
// Untrusted strings: their form in messages, and the shape of JSON before it is parsed.
#include "shared/text/json_shape.h"
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

TEST(JsonShape, DepthIsWhatIsOpenAtOnce) {
    EXPECT_EQ(jsonShape("").depth, 0u);
    EXPECT_EQ(jsonShape("1").depth, 0u);
    EXPECT_EQ(jsonShape("[{}]").depth, 2u);
    EXPECT_EQ(jsonShape("[[],[],[[]]]").depth, 3u);
    EXPECT_EQ(jsonShape(R"({"a": "[[[[", "b\"[[": {}})").depth, 2u) << "brackets in strings are text";
    EXPECT_EQ(jsonShape(R"(["\\", [1]])").depth, 2u) << "an escaped backslash does not keep a string open";
    EXPECT_EQ(jsonShape(std::string(100000, '[')).depth, 100000u);
    EXPECT_EQ(jsonShape("]]][[").depth, 2u) << "closing what was never open is no credit";
    EXPECT_EQ(jsonShape("\"\\").depth, 0u) << "ends in the middle of an escape";
}

TEST(JsonShape, CountsWhatAParserKeeps) {
    EXPECT_EQ(jsonShape("").objects, 0u);
    EXPECT_EQ(jsonShape("").values, 1u);
    EXPECT_EQ(jsonShape("7").values, 1u);
    const JsonShape shape = jsonShape(R"({"a": [1, 2, "x,{}"], "b": {}})");
    EXPECT_EQ(shape.objects, 2u) << "braces in strings are text";
    EXPECT_EQ(shape.values, 7u) << "the object, an array of three, an object; one is counted too many";
}

}  // namespace
}  // namespace diptych
