// SPDX-License-Identifier: MIT
#include "shared/scene/lights/json_fields.h"

#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace diptych {

namespace {

constexpr double largestFloat = std::numeric_limits<float>::max();
constexpr std::array<const char*, 5> counts{"no", "one", "two", "three", "four"};

}  // namespace

JsonFields::JsonFields(const nlohmann::json& object, std::string who)
    : object_(object), who_(std::move(who)) {
    if (!object.is_object()) throw std::runtime_error(who_ + ": is not an object");
}

void JsonFields::fail(std::string_view key, const std::string& why) const {
    throw std::runtime_error(fmt::format("{}: {}: {}", who_, oneLine(key), why));
}

const nlohmann::json* JsonFields::find(std::string_view key) const {
    const auto at = object_.find(key);
    return at == object_.end() ? nullptr : &*at;
}

void JsonFields::knownOnly(std::span<const std::string_view> known, std::string_view what) const {
    for (const auto& item : object_.items())
        if (std::ranges::find(known, item.key()) == known.end() && item.key() != "extras")
            fail(item.key(), fmt::format("is not a known field of {}", what));
}

std::string JsonFields::text(std::string_view key, const std::string& fallback) const {
    const nlohmann::json* value = find(key);
    if (value && !value->is_string()) fail(key, "is not text");
    return value ? oneLine(value->get_ref<const std::string&>()) : fallback;
}

bool JsonFields::flag(std::string_view key, bool fallback) const {
    const nlohmann::json* value = find(key);
    if (value && !value->is_boolean()) fail(key, "is not true or false");
    return value ? value->get<bool>() : fallback;
}

double JsonFields::within(std::string_view key, double x, double min, double max) const {
    if (!(std::abs(x) <= largestFloat)) fail(key, fmt::format("{:g} is too large", x));
    if (x < min) fail(key, fmt::format("{:g} is below {:g}", x, min));
    if (x > max) fail(key, fmt::format("{:g} is above {:g}", x, max));
    return x;
}

double JsonFields::number(std::string_view key, double fallback, double min, double max) const {
    const nlohmann::json* value = find(key);
    if (!value) return fallback;
    if (!value->is_number()) fail(key, "is not a number");
    return within(key, value->get<double>(), min, max);
}

void JsonFields::numbers(std::string_view key, std::span<double> values) const {
    const nlohmann::json* value = find(key);
    if (!value) return;
    const char* count = counts.at(values.size());
    if (!value->is_array() || value->size() != values.size())
        fail(key, fmt::format("is not {} numbers", count));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const nlohmann::json& x = (*value)[i];
        if (!x.is_number() || !(std::abs(x.get<double>()) <= largestFloat))
            fail(key, fmt::format("is not {} finite numbers", count));
        values[i] = x.get<double>();
    }
}

glm::dvec3 JsonFields::vector(std::string_view key, const glm::dvec3& fallback) const {
    std::array values{fallback.x, fallback.y, fallback.z};
    numbers(key, values);
    return {values[0], values[1], values[2]};
}

glm::dvec3 JsonFields::unit(std::string_view key, const glm::dvec3& fallback) const {
    const glm::dvec3 v = vector(key, fallback);
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest >= std::numeric_limits<double>::min())) fail(key, "has no length");
    return glm::normalize(v / largest);  // avoids underflow of squares
}

}  // namespace diptych
