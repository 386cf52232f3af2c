// SPDX-License-Identifier: MIT
#include "shared/text/json.h"

#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <set>
#include <vector>

namespace diptych {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

void checkCount(std::size_t count, std::size_t max, const char* what) {
    if (count > max) fail(fmt::format("has {} {}; the limit is {}", count, what, max));
}

void check(const JsonShape& shape, const JsonLimits& limits) {
    if (shape.depth > json_depth) fail(fmt::format("is nested deeper than {} levels", json_depth));
    checkCount(shape.objects, limits.objects, "objects");
    checkCount(shape.values, limits.values, "values");
}

// For parsing with a filter, which counts the remaining values itself.
constexpr JsonLimits unlimited{std::numeric_limits<std::size_t>::max()};

[[noreturn]] void failNoJson(std::string_view message) {
    // Skips "[json.exception.parse_error.101] " before "parse error at ...".
    const std::size_t at = message.find("] ");
    fail("is not JSON: " + oneLine(message.substr(at == message.npos ? 0 : at + 2)));
}

template <class Json>
Json parse(std::string_view text, const JsonLimits& limits = {},
           const typename Json::parser_callback_t& watch = nullptr) {
    check(jsonShape(text), limits);
    try {
        return Json::parse(text, watch);
    } catch (const typename Json::exception& e) {
        failNoJson(e.what());
    }
}

}  // namespace

json parseJson(std::string_view text, const JsonLimits& limits) {
    return parse<json>(text, limits);
}

ordered_json parseOrderedJson(std::string_view text) {
    return parse<ordered_json>(text);
}

ordered_json parseUniqueJson(std::string_view text) {
    using Event = ordered_json::parse_event_t;
    std::vector<std::set<std::string>> open;
    std::string twice;
    ordered_json parsed = parse<ordered_json>(text, {}, [&](int, Event event, ordered_json& value) {
        if (event == Event::object_start) open.emplace_back();
        if (event == Event::object_end) open.pop_back();
        if (event == Event::key && !open.back().insert(value.get<std::string>()).second)
            twice = value.get<std::string>();
        return true;
    });
    if (!twice.empty()) fail(fmt::format("\"{}\" appears twice", oneLine(twice)));
    return parsed;
}

// Not for ordered_json, whose elements move while others are dropped.
json parseJson(std::string_view text, const WantedKey& wanted) {
    std::size_t values = 0;
    return parse<json>(text, unlimited, [&](int depth, json::parse_event_t event, json& value) {
        if (event == json::parse_event_t::key) return wanted(depth, value.get_ref<const std::string&>());
        const bool closes =
            event == json::parse_event_t::object_end || event == json::parse_event_t::array_end;
        values += closes ? 0 : 1;
        checkCount(values, JsonLimits{}.values, "values");
        return true;
    });
}

void checkJson(std::string_view text) {
    check(jsonShape(text), unlimited);
    if (!json::accept(text)) fail("is not JSON");
}

json jsonIn(const std::filesystem::path& file) {
    return named(file.string(), [&] { return parseJson(textIn(file, json_bytes)); });
}

json jsonIn(const std::filesystem::path& file, const WantedKey& wanted) {
    return named(file.string(), [&] { return parseJson(textIn(file, json_bytes), wanted); });
}

ordered_json orderedJsonIn(const std::filesystem::path& file) {
    return named(file.string(), [&] { return parseOrderedJson(textIn(file, json_bytes)); });
}

}  // namespace diptych
