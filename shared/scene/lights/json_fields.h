// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <string_view>

namespace diptych {

// Typed access to the members of a JSON object. `who` names the object in messages. All readers throw
// std::runtime_error, "WHO: KEY: why", and return the fallback if the key is absent. Numbers must be
// finite as float.
class JsonFields {
public:
    JsonFields(const nlohmann::json& object, std::string who);

    [[noreturn]] void fail(std::string_view key, const std::string& why) const;
    const nlohmann::json* find(std::string_view key) const;
    // Throws if a key is not in `known`, and calls it "not a known field of `what`", because a misspelt key
    // would silently keep its default. "extras" is always allowed.
    void knownOnly(std::span<const std::string_view> known, std::string_view what) const;

    std::string text(std::string_view key, const std::string& fallback) const;  // a single line
    bool flag(std::string_view key, bool fallback) const;
    double number(std::string_view key, double fallback, double min, double max) const;
    void numbers(std::string_view key, std::span<double> values) const;  // exactly values.size() elements
    glm::dvec3 vector(std::string_view key, const glm::dvec3& fallback) const;
    glm::dvec3 unit(std::string_view key, const glm::dvec3& fallback) const;  // normalized; throws if zero

    // Returns `x`, the value of `key`; throws if it is out of bounds.
    double within(std::string_view key, double x, double min, double max) const;

private:
    const nlohmann::json& object_;
    std::string who_;
};

}  // namespace diptych
