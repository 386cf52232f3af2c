// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/value.h"

#include "shared/scene/gltf/note_list.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace diptych::gltf {

std::string firstLine(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    std::string line(text.substr(0, text.find_first_of("\r\n")));
    constexpr std::size_t longest = 300;  // a data URI, for example, would be unreadable
    if (line.size() > longest) line.replace(longest, line.npos, "...");
    while (line.size() <= longest && !line.empty() && (line.back() == ' ' || line.back() == '.'))
        line.pop_back();
    return line;
}

int checkedIndex(int index, std::size_t count, const std::string& who, const char* what) {
    if (index < -1 || (index >= 0 && static_cast<std::size_t>(index) >= count))
        throw std::runtime_error(fmt::format("{}: {} {}, but the file has {}", who, what, index, count));
    return index;
}

double numberIn(const tinygltf::Value& object, const char* key, double fallback, const std::string& who) {
    if (!object.Has(key)) return fallback;
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsNumber() || !std::isfinite(value.GetNumberAsDouble()))
        throw std::runtime_error(fmt::format("{}: {} is not a number", who, key));
    return value.GetNumberAsDouble();
}

int indexIn(const tinygltf::Value& object, const char* key, int fallback, const std::string& who) {
    if (!object.Has(key)) return fallback;
    if (!object.Get(key).IsInt() || object.Get(key).GetNumberAsInt() < 0)
        throw std::runtime_error(fmt::format("{}: {} is not an index", who, key));
    return object.Get(key).GetNumberAsInt();
}

std::vector<double> numbersIn(const tinygltf::Value& object, const char* key, std::vector<double> fallback,
                              const std::string& who) {
    if (!object.Has(key)) return fallback;
    const tinygltf::Value& array = object.Get(key);
    if (array.ArrayLen() != fallback.size())
        throw std::runtime_error(
            fmt::format("{}: {} is not an array of {} numbers", who, key, fallback.size()));
    for (std::size_t i = 0; i < fallback.size(); ++i) {
        const tinygltf::Value& value = array.Get(static_cast<int>(i));
        if (!value.IsNumber())
            throw std::runtime_error(fmt::format("{}: {} does not contain only numbers", who, key));
        fallback[i] = value.GetNumberAsDouble();
    }
    return fallback;
}

void limitNotes(std::vector<std::string>& notes, std::size_t first, const std::string& what) {
    NoteList some(what);
    for (std::size_t i = first; i < notes.size(); ++i) some.add(std::move(notes[i]));
    notes.resize(std::min(first, notes.size()));
    some.moveTo(notes);
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto at = extensions.find(name);
    return at == extensions.end() || !at->second.IsObject() ? nullptr : &at->second;
}

// Loading is over, so the uri member can store the reason.
void setMissing(tinygltf::Buffer& buffer, std::string line) {
    buffer.uri = std::move(line);
}

const std::string& missing(const tinygltf::Buffer& buffer) {
    return buffer.uri;
}

}  // namespace diptych::gltf
