// SPDX-License-Identifier: MIT
#include "compare/files/layer_kinds.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <utility>

namespace diptych {
namespace {

const DebugMode* modeOf(const std::string& name, std::size_t width) {
    const DebugMode* mode = findDebugMode(name);
    return mode && mode->name == name && static_cast<std::size_t>(mode->width) == width ? mode : nullptr;
}

// The words of a name in lower case: "worldNormal", "normal_ws" and "Denoising Normal" all have "normal".
// Capitals in a row are one word; digits end one.
std::vector<std::string> wordsOf(const std::string& name) {
    std::vector<std::string> words;
    bool open = false, lower = false;
    for (const char c : name) {
        const auto u = static_cast<unsigned char>(c);
        if (std::isalpha(u)) {
            if (!open || (lower && std::isupper(u))) words.emplace_back();
            words.back() += static_cast<char>(std::tolower(u));
            lower = std::islower(u) != 0;
        }
        open = std::isalpha(u) != 0;
    }
    return words;
}

// Renderers name layers of ids, whose exact values count, and of vectors; others are colours.
ChannelKind kindByName(const std::string& layer) {
    static const std::set<std::string> alone{"n", "ng", "ns", "p", "z", "material", "object", "instance"},
        ids{"id", "ids", "index", "objectid", "materialid", "instanceid", "material", "object", "instance"},
        vectors{
            "normal",      "normals",      "geonormal", "shadingnormal", "worldnormal", "pos",       "pref",
            "pworld",      "position",     "positions", "worldposition", "point",       "st",        "uv",
            "uvs",         "texcoord",     "texcoords", "vector",        "velocity",    "motion",    "flow",
            "opticalflow", "motionvector", "mv",        "motionvectors", "tangent",     "bitangent", "depth"};
    const std::vector<std::string> words = wordsOf(layer);
    const std::vector<std::string> last = wordsOf(layer.substr(layer.rfind('.') + 1));
    if (std::ranges::any_of(words, [](const std::string& word) { return word.starts_with("crypto"); }))
        return ChannelKind::id;
    // Short words and "material" say so alone only: "material color" is a colour.
    if (last.size() == 1 && alone.contains(last[0]))
        return ids.contains(last[0]) ? ChannelKind::id : ChannelKind::vector;
    const auto names = [&](const std::set<std::string>& some) {
        return std::ranges::any_of(
            last, [&](const std::string& word) { return some.contains(word) && !alone.contains(word); });
    };
    if (names(ids)) return ChannelKind::id;
    return names(vectors) ? ChannelKind::vector : ChannelKind::color;
}

}  // namespace

std::string componentOf(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    const std::string component = dot == channel.npos ? channel : channel.substr(dot + 1);
    std::string lower = component;
    std::ranges::transform(lower, lower.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    for (const auto& [letter, word] : {std::pair{"r", "red"}, {"g", "green"}, {"b", "blue"}, {"a", "alpha"}})
        if (lower == letter || lower == word) return {static_cast<char>(*letter - 'a' + 'A')};
    return component;
}

ChannelKind kindOf(const std::string& name, const std::vector<std::string>& channels,
                   const std::string& type) {
    if (type == "uint") return ChannelKind::id;
    if (const DebugMode* mode = modeOf(name, channels.size())) return mode->kind;
    if (channels.size() != 3) return ChannelKind::scalar;
    return componentOf(channels[0]) == "X" ? ChannelKind::vector : kindByName(name);
}

bool isNegative(const Image& image) {
    std::size_t negative = 0, all = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float* const p = image.pixel(i);
        const auto any = [&](auto test) { return std::any_of(p, p + image.components, test); };
        negative += any([](float v) { return v < 0; });
        all += any([](float v) { return v != 0; });
    }
    return negative > 0 && 10 * negative >= all;
}

bool isWhole(const Image& image) {
    return std::ranges::all_of(image.data, [](float v) { return std::isfinite(v) && v == std::floor(v); }) &&
           std::ranges::any_of(image.data, [](float v) { return v > 1024; });
}

bool isDebugMode(const std::string& name, std::size_t width) {
    return modeOf(name, width) != nullptr;
}

ErrorKind errorKindOf(const std::string& name, std::size_t width, ChannelKind kind) {
    const DebugMode* mode = modeOf(name, width);
    if (mode && (isAngle(mode->error_kind) || mode->error_kind == ErrorKind::exact)) return mode->error_kind;
    return kind == ChannelKind::id ? ErrorKind::exact : ErrorKind::absolute;
}

}  // namespace diptych
