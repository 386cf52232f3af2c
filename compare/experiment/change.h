// SPDX-License-Identifier: MIT
#pragma once

#include "shared/frame/settings.h"

#include <compare>
#include <span>
#include <string>

namespace diptych::experiment {

// An option and a value, in the words of Settings::set().
struct Change {
    std::string option, value;
    auto operator<=>(const Change&) const = default;
};

// Throws as Settings::set() does.
inline Settings changed(Settings settings, std::span<const Change> changes) {
    for (const Change& change : changes) settings.set(change.option, change.value);
    return settings;
}

}  // namespace diptych::experiment
