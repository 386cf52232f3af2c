// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/value.h"

#include "shared/text/fail.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace diptych::gltf {

using Json = nlohmann::json;

const Json* memberOf(const Json& value, std::string_view key) {
    const auto at = value.find(key);  // end() if it is not an object
    return at == value.end() ? nullptr : &*at;
}

const Json& arrayAt(const Json& document, const std::string& location) {
    static const Json none = Json::array();
    const Json::json_pointer pointer(location);
    return document.contains(pointer) && document[pointer].is_array() ? document[pointer] : none;
}

const Json& elementOf(const Json& array, std::size_t index) {
    static const Json none;
    return index < array.size() ? array[index] : none;
}

const Json* extension(const Json& owner, std::string_view name) {
    const Json* extensions = memberOf(owner, "extensions");
    return extensions ? memberOf(*extensions, name) : nullptr;
}

Json takeExtension(Json& owner, const char* name) {
    if (!extension(owner, name)) return nullptr;
    Json taken = std::move(owner["extensions"][name]);
    owner["extensions"].erase(name);
    return taken;
}

int indexBelow(const Json& value, std::size_t count, const std::string& who) {
    const double index = value.is_number() ? value.get<double>() : -1;
    if (!(index >= 0 && index < static_cast<double>(count) && index == std::floor(index)))
        fail(who, fmt::format("is not a whole number below {}", count));
    return static_cast<int>(index);
}

std::string firstLine(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    std::string line(text.substr(0, text.find_first_of("\r\n")));
    constexpr std::size_t longest = 300;  // a data URI, for example, would be unreadable
    if (line.size() > longest) line.replace(longest, line.npos, "...");
    while (line.size() <= longest && !line.empty() && (line.back() == ' ' || line.back() == '.'))
        line.pop_back();
    return line;
}

void limitNotes(std::vector<std::string>& notes, std::size_t first, const std::string& what) {
    NoteList some(what);
    for (std::size_t i = first; i < notes.size(); ++i) some.add(std::move(notes[i]));
    notes.resize(std::min(first, notes.size()));
    some.moveTo(notes);
}

}  // namespace diptych::gltf
