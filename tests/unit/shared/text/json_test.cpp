// SPDX-License-Identifier: MIT
// The JSON reader: input refused before parsing, and the positions in its errors.
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <limits>

namespace diptych {
namespace {

TEST(JsonReader, DepthIsRefusedBeforeParsing) {
    const std::string deep(200000, '[');
    for (const auto& read : std::initializer_list<std::function<void()>>{
             [&] { parseJson(deep); }, [&] { parseOrderedJson(deep); }, [&] { parseUniqueJson(deep); },
             [&] { checkJson(deep); },
             [&] { parseJson(deep, [](int, const std::string&) { return true; }); }})
        EXPECT_EQ(faultOf(read), "is nested deeper than 128 levels");
    EXPECT_EQ(faultOf([] { parseJson(std::string(128, '[') + std::string(128, ']')); }), "");
}

TEST(JsonReader, ValuesAreCountedBeforeParsing) {
    const std::string many = "[" + std::string((std::size_t(1) << 24) + 10, ',') + "]";
    EXPECT_EQ(faultOf([&] { parseJson(many); }), "has 16777228 values; the limit is 16777216");
    EXPECT_EQ(faultOf([&] { parseOrderedJson(many); }), "has 16777228 values; the limit is 16777216");
    EXPECT_EQ(faultOf([] { parseJson("[1,[],{}]", {.values = 5}); }), "has 6 values; the limit is 5");
    EXPECT_EQ(faultOf([] { parseJson("[{},{}]", {.objects = 1}); }), "has 2 objects; the limit is 1");
}

TEST(JsonReader, ErrorsNameThePlaceAndNotTheLibrary) {
    EXPECT_TRUE(
        faultOf([] { parseJson("{\n \"a\": ]"); }).starts_with("is not JSON: parse error at line 2, column"));
    EXPECT_EQ(faultOf([] { parseJson("[1e999]"); }), "is not JSON: number overflow parsing '1e999'");
    EXPECT_EQ(faultOf([] { checkJson("[1,"); }), "is not JSON");
    EXPECT_EQ(faultOf([] { checkJson("[1, {}]"); }), "");
    const std::filesystem::path file = folder() / "a.json";
    std::ofstream(file) << "{";
    EXPECT_TRUE(
        faultOf([&] { jsonIn(file); }).starts_with(file.string() + ": is not JSON: parse error at line 1"));
    EXPECT_EQ(faultOf([] { parseUniqueJson(R"([{"a":1},{"a":1,"b":{"a":2},"a":3}])"); }),
              "\"a\" appears twice");
    EXPECT_EQ(faultOf([] { parseUniqueJson(R"([{"a":1},{"a":{"a":2}}])"); }), "");
}

TEST(JsonReader, UnwantedMembersAreLeftOut) {
    const nlohmann::json json =
        parseJson(R"({"a":[1,{"x":2,"y":3}],"b":4})",
                  [](int depth, const std::string& key) { return depth > 1 ? key != "x" : key != "b"; });
    EXPECT_EQ(json, nlohmann::json::parse(R"({"a":[1,{"y":3}]})"));
}

TEST(JsonAt, WhatDoesNotFitNamesItsPlace) {
    const nlohmann::json json =
        nlohmann::json::parse(R"({"a":[{"n":"x"},{"n":-1}],"f":1.5,"big":18446744073709551615,"t":true})");
    const JsonAt top(json);
    EXPECT_EQ(top.at("a")[0].at("n").text(), "x");
    EXPECT_EQ(faultOf([&] { top.at("a")[1].at("n").text(); }), "a[1].n: is not a string");
    EXPECT_EQ(faultOf([&] { top.at("a")[2]; }), "a: has only 2 elements");
    EXPECT_EQ(faultOf([&] { top.at("b"); }), "has no \"b\"");
    EXPECT_EQ(faultOf([&] { top.at("a").at("b"); }), "a: has no \"b\"");
    EXPECT_EQ(faultOf([&] { top.at("f").each(); }), "f: is not an array");
    EXPECT_EQ(faultOf([&] { top.at("f").whole(0, 5); }), "f: is not a whole number from 0 to 5");
    EXPECT_EQ(faultOf([&] { top.at("a")[1].at("n").index(9); }), "a[1].n: is not a whole number from 0 to 8");
    EXPECT_EQ(faultOf([&] { top.at("f").index(0); }), "f: is an index into an empty list");
    EXPECT_EQ(top.at("big").whole<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max()),
              std::numeric_limits<std::uint64_t>::max());
    EXPECT_NE(faultOf([&] { top.at("big").whole(0, 2147483647); }), "");
    EXPECT_EQ(top.at("a")[1].at("n").whole(-1, 1), -1);
    EXPECT_TRUE(top.at("t").flag());
    EXPECT_EQ(faultOf([&] { top.at("t").number(); }), "t: is not a number");
    EXPECT_EQ(faultOf([&] { top.at("f").flag(); }), "f: is not true or false");
    EXPECT_EQ(top.textOr("none", "or"), "or");
    EXPECT_EQ(faultOf([&] { top.textOr("f", "or"); }), "f: is not a string")
        << "no fallback for what is wrong";
}

}  // namespace
}  // namespace diptych
