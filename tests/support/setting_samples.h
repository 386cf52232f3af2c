// SPDX-License-Identifier: MIT
// Values of every Setting, from its type and its row.
#pragma once

#include "shared/frame/setting_rows.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace diptych {

// All values of an enumeration; of other types, values that text or JSON may spoil. A vector of bool would
// have no references.
template <class T>
std::deque<T> samplesOf() {
    if constexpr (std::is_enum_v<T>) {
        std::deque<T> all;
        for (const auto& [value, name] : enumNames<T>()) all.push_back(value);
        return all;
    } else if constexpr (std::is_same_v<T, bool>) {
        return {false, true};
    } else if constexpr (std::is_same_v<T, std::string>) {
        return {"", "1", "eye=1,2,3 \"quoted\"", "walk \\ \xc3\xa9"};
    } else if constexpr (std::is_same_v<T, Size>) {
        return {{1, 1}, {1920, 17}};
    } else if constexpr (std::is_same_v<T, Rgb>) {
        return {{1e-30f, 0.3f, 16777217.0f}, {1e-7f, 0.25f, 3e5f}};
    } else if constexpr (std::is_integral_v<T>) {
        return {0, 7, std::numeric_limits<T>::max()};
    } else {
        return {0, T(1) / 3, T(5.5), T(-30.5), T(1e-30), std::numeric_limits<T>::max()};
    }
}

// Texts of valid values of a Setting, without its default: the swept ones, and samples.
inline std::vector<std::string> otherValues(std::string_view option) {
    const Settings defaults;
    std::vector<std::string> values = sweptValues(defaults, option);
    Settings::rows([&](const Field& field, auto member) {
        if (field.option != option) return;
        for (const auto& value : samplesOf<std::remove_cvref_t<decltype(defaults.*member)>>()) {
            Settings settings;
            settings.*member = value;
            if (!field.valid.check || field.valid.check(settings)) values.push_back(settings.valueOf(option));
        }
    });
    std::erase(values, defaults.valueOf(option));
    return values;
}

// Every Setting at a valid value that is neither its default nor that of the surfaces' capture.
inline Settings everythingChanged() {
    Settings changed;
    for (const Field& field : settingFields()) {
        std::vector<std::string> values = otherValues(field.option);
        if (field.for_surfaces) std::erase(values, std::string(*field.for_surfaces));
        changed.set(field.option, values.at(0));
    }
    return changed;
}

}  // namespace diptych
