// SPDX-License-Identifier: MIT
// Sweeps for the tests to run, and what commands wrote as JSON.
#pragma once

#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <set>
#include <string>
#include <vector>

namespace diptych {

using Json = nlohmann::json;

// JSON paths of empty strings, such as "/device/name" and "/rows/*/words". Skips `settings` and `origin`,
// where an empty string means the default.
inline std::set<std::string> emptyIn(const Json& json, const std::string& location = "") {
    std::set<std::string> found;
    if (json == "") found.insert(location);
    if (json.is_structured())
        for (const auto& [key, value] : json.items())
            if (key != "settings" && key != "origin")
                found.merge(emptyIn(value, location + "/" + (json.is_array() ? "*" : key)));
    return found;
}

inline Json readJson(const fs::path& file) {
    return Json::parse(contentsOf(file), nullptr, false);
}

// The JSON that it printed.
inline Json parsed(const Ran& ran) {
    const Json json = Json::parse(ran.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << "not JSON: " << ran.out << "\nerr: " << ran.err;
    return json;
}

inline constexpr const char* sweep = "tradeoff builtin:triangle --size 32x24 --runs 2 --json -q -o t ";

// Long enough to be interrupted at any row.
inline const std::vector<std::string> longSweep{
    "tradeoff",
    "builtin:triangle",
    "--size",
    "64x48",
    "--runs",
    "300",
    "-o",
    "t",
    "--grid",
    R"([{"settings": {"path": ["deferred", "forward_plus"], "size": ["1/2", "1/1"]}},
        {"settings": {"prepass": "off"}}])"};

inline std::string shellWords(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += "'" + word + "' ";
    return line;
}

}  // namespace diptych
