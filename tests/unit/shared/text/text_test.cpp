// SPDX-License-Identifier: MIT
// Untrusted strings: their form in messages, and the limits on JSON before parsing.
#include "shared/text/digits.h"
#include "shared/text/indexed_names.h"
#include "shared/text/json_shape.h"
#include "shared/text/one_line.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace diptych {
namespace {

TEST(Digits, TellNumbersApart) {
    EXPECT_EQ(distinguishingDigits(0.0123456, 0.01), "0.0123");
    EXPECT_EQ(distinguishingDigits(0.0100004, 0.01), "0.0100004");
    EXPECT_EQ(distinguishingDigits(0.01, 0.0100004), "0.01");
    EXPECT_EQ(distinguishingDigits(0.01, 0.01, 4), "0.01");
}

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

TEST(IndexedNames, AreQuotedAndTheFirstTwentyShown) {
    const auto listed = [](const std::vector<std::string>& names) { return indexedNames(names); };
    EXPECT_EQ(listed({}), "");
    EXPECT_EQ(listed({"walk", "", "a\nb"}), "0 \"walk\", 1, 2 \"a?b\"");
    EXPECT_TRUE(listed(std::vector<std::string>(20, "x")).ends_with("19 \"x\""));
    EXPECT_TRUE(listed(std::vector<std::string>(23, "x")).ends_with("19 \"x\" and 3 more"));
}

// Characters that terminals obey or that reorder text, in UTF-8.
std::vector<std::string> controls() {
    std::vector<std::string> all;
    for (int code = 0; code < 0x20; ++code) all.emplace_back(1, static_cast<char>(code));
    all.emplace_back("\x7f");
    for (int code = 0x80; code < 0xa0; ++code) all.push_back(std::string("\xc2") + static_cast<char>(code));
    for (const char* text : {"\u061c", "\u200e", "\u200f", "\u2028", "\u2029", "\u202a", "\u202b", "\u202c",
                             "\u202d", "\u202e", "\u2066", "\u2067", "\u2068", "\u2069"})
        all.emplace_back(text);
    return all;
}

TEST(Controls, NoneReachesALine) {
    for (const std::string& control : controls()) {
        const std::string text = "a" + control + "b";
        EXPECT_EQ(oneLine(text), "a?b");
        EXPECT_EQ(messageLine(text), control == "\n" ? "a b" : "a?b");
    }
    EXPECT_EQ(controls().size(), 32u + 1 + 32 + 14);
}

TEST(Controls, StandInLinesAsJsonWritesThem) {
    EXPECT_EQ(escapeControls("a\x1b[1m\nb\u009b\u202e\t\x7f"), "a\\u001b[1m\nb\\u009b\\u202e\\u0009\\u007f");
    EXPECT_EQ(escapeControls("\xff\xc3"), "??") << "no UTF-8";
    EXPECT_EQ(escapeControls("größer\U0001f600"), "größer\U0001f600");
    for (const std::string& control : controls()) {
        // As in a report, where the library only escapes C0.
        const nlohmann::json value = {{"scene", "a" + control + "b"}};
        const std::string shown = escapeControls(value.dump(2));
        EXPECT_EQ(nlohmann::json::parse(shown), value) << shown;
        for (const std::string& other : controls())
            EXPECT_TRUE(other == "\n" || shown.find(other) == shown.npos) << shown;
    }
}

TEST(Controls, NeighboursArePlainText) {
    for (const char* text : {" ", "~", "\u00a0", "\u061b", "\u061d", "\u200d", "\u2010", "\u2027", "\u202f",
                             "\u2065", "\u206a", "\u05d0"}) {
        EXPECT_EQ(oneLine(text), text);
        EXPECT_EQ(escapeControls(text), text);
    }
}

TEST(MessageLine, OfALongOneBeginningAndEndStay) {
    EXPECT_EQ(messageLine(std::string(1900, 'a')), std::string(1900, 'a'));
    const std::string line = messageLine("a.gltf: " + std::string(5'000'000, 'x') + ": rename it");
    EXPECT_TRUE(line.starts_with("a.gltf: xxx")) << line;
    EXPECT_TRUE(line.ends_with("xxx: rename it")) << line;
    EXPECT_NE(line.find("x...x"), line.npos);
    EXPECT_EQ(line.size(), 1903u);
    std::string wide;
    for (int i = 0; i < 2000; ++i) wide += "€";
    EXPECT_EQ(messageLine(wide).find('?'), std::string::npos) << "cut between characters";
}

TEST(LineBreaks, InANameAreRefused) {
    EXPECT_NO_THROW(refuseLineBreak("a b\x1b.gltf"));
    EXPECT_EQ(faultOf([] { refuseLineBreak("a\nb.gltf"); }),
              "a?b.gltf: has a line break in its name; rename it");
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
