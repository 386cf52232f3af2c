// SPDX-License-Identifier: MIT
#include "compare/files/layer_kinds.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <utility>

namespace diptych {
namespace {

const DebugMode* modeOf(const std::string& name, std::size_t width) {
    const DebugMode* mode = findDebugMode(name);
    return mode && mode->name == name && static_cast<std::size_t>(mode->width) == width ? mode : nullptr;
}

// Renderers name layers of Cryptomatte ids, whose float bits count, and of vectors; others are colours.
ChannelKind kindByName(const std::string& layer) {
    static const std::set<std::string> vectors{
        "n",      "ng",   "ns",          "normal",       "normals",       "geonormal",     "shadingnormal",
        "p",      "pref", "pworld",      "position",     "positions",     "worldposition", "point",
        "st",     "uv",   "uvs",         "texcoord",     "texcoords",     "vector",        "velocity",
        "motion", "flow", "opticalflow", "motionvector", "motionvectors", "tangent",       "bitangent"};
    std::istringstream parts(layer);
    std::string word;
    for (std::string part; std::getline(parts, part, '.');) {
        word.clear();
        for (const char c : part)
            if (std::isalpha(static_cast<unsigned char>(c))) word += static_cast<char>(std::tolower(c));
        if (word.starts_with("crypto")) return ChannelKind::id;
    }
    return vectors.contains(word) ? ChannelKind::vector : ChannelKind::color;
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
    if (const DebugMode* mode = modeOf(name, channels.size())) return mode->kind;
    if (type == "uint") return ChannelKind::id;
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

bool isDebugMode(const std::string& name, std::size_t width) {
    return modeOf(name, width) != nullptr;
}

Metric metricOf(const std::string& name, std::size_t width, ChannelKind kind) {
    const DebugMode* mode = modeOf(name, width);
    if (mode && (isAngle(mode->metric) || mode->metric == Metric::exact)) return mode->metric;
    return kind == ChannelKind::id ? Metric::exact : Metric::absolute;
}

}  // namespace diptych
