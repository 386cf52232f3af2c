// SPDX-License-Identifier: MIT
// The only reader of JSON. All files are untrusted, including those of this program, because others can
// write them.
#pragma once

#include "shared/text/json_shape.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace diptych {

// Parses JSON no deeper than json_depth, within `limits`. Throws std::runtime_error, one line without the
// file's name: "is nested deeper than 128 levels", "has 70000000 values: at most 16777216 are read", "is
// not JSON: parse error at line 3, column 7: ...".
nlohmann::json parseJson(std::string_view text, const JsonLimits& limits = {});
// Keeps the order of members.
nlohmann::ordered_json parseOrderedJson(std::string_view text);
// Rejects duplicate keys in an object, of which one would silently win.
nlohmann::ordered_json parseUniqueJson(std::string_view text);

// Drops members whose key is not wanted; they take no memory and do not count as values. Useful for
// reports of thousands of scenes. `depth` is 1 in the outermost object.
using WantedKey = std::function<bool(int depth, const std::string& key)>;
nlohmann::json parseJson(std::string_view text, const WantedKey& wanted);

// Checks that the text is JSON within the limits; keeps nothing.
void checkJson(std::string_view text);

// A report of ten thousand comparisons takes about 300 MB; text and tree are in memory together.
inline constexpr std::uint64_t json_bytes = std::uint64_t(1) << 30;

// Parses a JSON file; errors begin with its name.
nlohmann::json jsonIn(const std::filesystem::path& file);
nlohmann::json jsonIn(const std::filesystem::path& file, const WantedKey& wanted);
nlohmann::ordered_json orderedJsonIn(const std::filesystem::path& file);

}  // namespace diptych
