// SPDX-License-Identifier: MIT
#include "shared/frame/settings.h"

#include "shared/frame/setting_rows.h"
#include "shared/text/did_you_mean.h"
#include "shared/text/json.h"
#include "shared/text/json_text.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>
#include <type_traits>

namespace diptych {

namespace {

using Json = nlohmann::ordered_json;

// Conversion of one type: command line text, JSON, accepted values. read() and fromJson() return whether
// they succeeded; on failure the value may be anything.
template <class T>
struct Codec;

template <class T>
requires std::is_enum_v<T>
struct Codec<T> {
    static std::string accepted() {
        std::string all;
        for (const auto& [value, name] : enumNames<T>()) all.append(all.empty() ? "" : "|").append(name);
        return all;
    }
    static std::string describe(T value) { return std::string(nameOf(value)); }
    static bool read(T& value, std::string_view text) {
        for (const auto& [candidate, name] : enumNames<T>())
            if (name == text) return value = candidate, true;
        return false;
    }
    static Json toJson(T value) { return describe(value); }
    static bool fromJson(T& value, const Json& json) {
        return json.is_string() && read(value, json.get_ref<const std::string&>());
    }
};

template <class T>
requires(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) struct Codec<T> {
    static std::string accepted() { return std::is_integral_v<T> ? "N" : "F"; }
    static std::string describe(T value) { return fmt::format("{}", value); }
    static bool read(T& value, std::string_view text) {
        const char* end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, value);
        return error == std::errc() && rest == end && !text.empty() &&
               std::isfinite(static_cast<double>(value));
    }
    // A float uses its shortest decimal: 0.1, not 0.10000000149011612.
    static Json toJson(T value) {
        if constexpr (!std::is_same_v<T, float>) return value;
        double shortest = 0;
        Codec<double>::read(shortest, describe(value));
        return shortest;
    }
    static bool fromJson(T& value, const Json& json) {
        return (std::is_integral_v<T> ? json.is_number_integer() : json.is_number()) &&
               read(value, json.dump());
    }
};

template <>
struct Codec<bool> {
    static std::string accepted() { return "on|off"; }
    static std::string describe(bool value) { return value ? "on" : "off"; }
    static bool read(bool& value, std::string_view text) {
        value = text == "on";
        return value || text == "off";
    }
    static Json toJson(bool value) { return value; }
    static bool fromJson(bool& value, const Json& json) {
        if (json.is_boolean()) return value = json.get<bool>(), true;
        return json.is_string() && read(value, json.get_ref<const std::string&>());
    }
};

template <>
struct Codec<std::string> {
    static std::string accepted() { return "TEXT"; }
    static std::string describe(const std::string& value) { return value; }
    static bool read(std::string& value, std::string_view text) { return value = text, true; }
    static Json toJson(const std::string& value) { return value; }
    static bool fromJson(std::string& value, const Json& json) {
        return json.is_string() && read(value, json.get_ref<const std::string&>());
    }
};

// Several numbers: one word with `separator` between them; in JSON an array or that word.
template <class T, std::size_t n>
bool readList(T* (&parts)[n], std::string_view text, char separator) {
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t end = i + 1 < n ? text.find(separator) : text.size();
        if (end == std::string_view::npos || !Codec<T>::read(*parts[i], text.substr(0, end))) return false;
        if (i + 1 < n) text.remove_prefix(end + 1);
    }
    return true;
}
template <class T, std::size_t n>
bool listFromJson(T* (&parts)[n], const Json& json, char separator) {
    if (json.is_string()) return readList(parts, json.get_ref<const std::string&>(), separator);
    if (!json.is_array() || json.size() != n) return false;
    for (std::size_t i = 0; i < n; ++i)
        if (!Codec<T>::fromJson(*parts[i], json[i])) return false;
    return true;
}

template <>
struct Codec<Size> {
    static std::string accepted() { return "WxH"; }
    static std::string describe(Size value) { return fmt::format("{}x{}", value.width, value.height); }
    static bool read(Size& value, std::string_view text) {
        int* parts[] = {&value.width, &value.height};
        return readList(parts, text, 'x');
    }
    static Json toJson(Size value) { return Json::array({value.width, value.height}); }
    static bool fromJson(Size& value, const Json& json) {
        int* parts[] = {&value.width, &value.height};
        return listFromJson(parts, json, 'x');
    }
};

template <>
struct Codec<Rgb> {
    static std::string accepted() { return "F,F,F"; }
    static std::string describe(Rgb value) { return fmt::format("{},{},{}", value.r, value.g, value.b); }
    static bool read(Rgb& value, std::string_view text) {
        float* parts[] = {&value.r, &value.g, &value.b};
        return readList(parts, text, ',');
    }
    static Json toJson(Rgb value) {
        return Json::array(
            {Codec<float>::toJson(value.r), Codec<float>::toJson(value.g), Codec<float>::toJson(value.b)});
    }
    static bool fromJson(Rgb& value, const Json& json) {
        float* parts[] = {&value.r, &value.g, &value.b};
        return listFromJson(parts, json, ',');
    }
};

// Names of an enumeration such as "compact|full"; empty for other types.
std::vector<std::string> alternatives(const std::string& accepted) {
    std::vector<std::string> words;
    if (accepted.find('|') == accepted.npos) return words;
    std::istringstream list(accepted);
    for (std::string word; std::getline(list, word, '|');) words.push_back(word);
    return words;
}

template <class T>
using CodecOf = Codec<std::remove_cvref_t<T>>;

std::string describe(const std::string& accepted) {
    return accepted == "N" ? "a whole number in range" : accepted == "F" ? "a number" : accepted;
}

std::string keyOf(std::string_view option) {
    std::string key(option);
    for (char& c : key)
        if (c == '-') c = '_';
    return key;
}

// "off" and "none" stand for the setting's own off value.
std::string ownWord(const Field& field, const std::string& word) {
    return field.off && (word == "off" || word == "none") ? std::string(*field.off) : word;
}

template <class Value, class Member>
bool readJson(Member& member, const Field& field, const Json& json) {
    const bool selects = field.option == "camera" || field.option == "animation" || field.option == "variant";
    if (selects && json.is_number_unsigned()) return Value::read(member, json.dump());
    if (!json.is_string()) return Value::fromJson(member, json);
    const auto& word = json.get_ref<const std::string&>();
    const std::string own = ownWord(field, word);
    return own == word ? Value::fromJson(member, json) : Value::read(member, own);
}

// Calls visit(Field, member) for the row of `option`; throws if there is none.
template <class Self, class Visit>
void visitField(Self& settings, std::string_view option, Visit&& visit) {
    bool found = false;
    Settings::fields(settings, [&](const Field& field, auto& member) {
        if (field.option != option) return;
        found = true;
        visit(field, member);
    });
    if (!found) throw std::runtime_error(fmt::format("--{}: no such setting", option));
}

}  // namespace

std::string toJson(const Settings& settings, int indent) {
    Json object = Json::object();
    Settings::fields(settings, [&](const Field& field, const auto& member) {
        object[keyOf(field.option)] = CodecOf<decltype(member)>::toJson(member);
    });
    return jsonText(object, indent);
}

namespace {

// Former name of the option: --sort on|off.
constexpr std::string_view earlier_name = "sort";
std::string sortedOrNot(const std::string& value) {
    if (value != "on" && value != "off")
        throw std::runtime_error(fmt::format("--{} {}: not on or off", earlier_name, value));
    return std::string(nameOf(value == "on" ? Transparency::sorted : Transparency::unsorted));
}

}  // namespace

Settings settingsFromJson(const std::string& text, const Settings& base) {
    Json object = named("settings", [&] { return parseOrderedJson(text); });
    if (!object.is_object()) throw std::runtime_error("settings: not a JSON object");
    if (object.size() == 1 && object.contains("settings") && object["settings"].is_object())
        object = Json(object["settings"]);
    for (const char* key : {"settings", "frames"})
        if (object.contains(key) && object[key].is_structured())
            throw std::runtime_error(
                "settings: this is a whole report or frame; give one frame's \"settings\" object");

    Settings settings = base;
    std::set<std::string> unknown;
    for (const auto& [key, value] : object.items()) unknown.insert(key);
    Settings::fields(settings, [&](const Field& field, auto& member) {
        const std::string key = keyOf(field.option);
        if (unknown.erase(key) == 0) return;
        using Value = CodecOf<decltype(member)>;
        if (!readJson<Value>(member, field, object[key]))
            throw std::runtime_error(fmt::format("settings: \"{}\": {} is not {}", key,
                                                 oneLine(jsonText(object[key], -1)),
                                                 describe(Value::accepted())));
    });
    if (unknown.erase(std::string(earlier_name)) != 0) {
        const Json& value = object[std::string(earlier_name)];
        settings.set(earlier_name, value.is_boolean()  ? (value.get<bool>() ? "on" : "off")
                                   : value.is_string() ? value.get<std::string>()
                                                       : value.dump());
    }
    for (const char* option : {"debug", "channels", "exposure", "ev100", "no_tonemap", "frames", "fps",
                               "heat", "runs", "device", "validate", "baseline"})
        if (unknown.contains(option)) {
            std::string name(option);
            std::ranges::replace(name, '_', '-');
            throw std::runtime_error(
                fmt::format("settings: \"{}\" is not a setting; use the option --{}", option, name));
        }
    if (!unknown.empty())
        throw std::runtime_error(fmt::format("settings: unknown key \"{}\"", oneLine(*unknown.begin())));
    return settings;
}

void Settings::set(std::string_view option, const std::string& value) {
    if (option == earlier_name) return set("transparency", sortedOrNot(value));
    visitField(*this, option, [&](const Field& field, auto& member) {
        using Value = CodecOf<decltype(member)>;
        if (!Value::read(member, ownWord(field, value)))
            throw std::runtime_error(fmt::format("--{} {}: not {}{}", option, value,
                                                 describe(Value::accepted()),
                                                 didYouMean(value, alternatives(Value::accepted()))));
    });
}

std::string Settings::valueOf(std::string_view option) const {
    std::string text;
    visitField(*this, option,
               [&](const Field&, const auto& member) { text = CodecOf<decltype(member)>::describe(member); });
    return text;
}

std::string acceptedValues(std::string_view option) {
    const Settings settings;
    std::string accepted;
    visitField(settings, option,
               [&](const Field&, const auto& member) { accepted = CodecOf<decltype(member)>::accepted(); });
    return accepted;
}

std::span<const Field> settingFields() {
    static const std::vector<Field> fields = [] {
        std::vector<Field> all;
        Settings::rows([&](const Field& field, auto) { all.push_back(field); });
        return all;
    }();
    return fields;
}

const Field& settingField(std::string_view option) {
    for (const Field& field : settingFields())
        if (field.option == option) return field;
    throw std::runtime_error(fmt::format("--{}: no such setting", option));
}

}  // namespace diptych
