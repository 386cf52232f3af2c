// SPDX-License-Identifier: MIT
// A Frame and its parts as JSON, in all our files.
#pragma once

#include "shared/frame/frame.h"
#include "shared/text/json_at.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace diptych {

// Everything except pixels, as in "frames" of a report.
nlohmann::ordered_json jsonOf(const Frame& frame);
nlohmann::ordered_json jsonOf(const FrameCamera& camera);
nlohmann::ordered_json jsonOf(const FrameTime& time);  // without host times
nlohmann::ordered_json jsonOf(const std::vector<PassTime>& passes);
nlohmann::ordered_json jsonOf(const ReportDevice& device);
nlohmann::ordered_json jsonOf(const Settings& settings);  // as for --settings
// A missing "far" means no far plane. Throws std::runtime_error naming the place of a missing or short
// vector.
FrameCamera cameraFrom(const JsonAt<nlohmann::json>& json);

// Null for infinity and NaN, which JSON lacks.
nlohmann::ordered_json finiteOrNull(double value);
// Null without a value, or without words.
template <class Value>
nlohmann::ordered_json orNull(const std::optional<Value>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}
inline nlohmann::ordered_json orNull(const std::string& text) {
    return text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
}

// `one` of each item.
template <class Items, class One>
nlohmann::ordered_json arrayOf(const Items& items, const One& one) {
    auto array = nlohmann::ordered_json::array();
    for (const auto& item : items) array.push_back(one(item));
    return array;
}

}  // namespace diptych
