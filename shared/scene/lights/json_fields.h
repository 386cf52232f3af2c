// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <string_view>

namespace diptych {

// One JSON object, and who it is in messages. All readers throw std::runtime_error, "WHO: KEY: why"; a key
// that is absent gives the fallback. Numbers are finite as float.
class JsonFields {
public:
    JsonFields(const nlohmann::json& object, std::string who);

    [[noreturn]] void fail(std::string_view key, const std::string& why) const;
    const nlohmann::json* find(std::string_view key) const;
    // A misspelt key would leave its default in force unseen: each that is not `known` fails as no field of
    // `what`. "extras" is everywhere.
    void knownOnly(std::span<const std::string_view> known, std::string_view what) const;

    std::string text(std::string_view key, const std::string& fallback) const;  // one line
    bool flag(std::string_view key, bool fallback) const;
    double number(std::string_view key, double fallback, double least, double most) const;
    void numbers(std::string_view key, std::span<double> values) const;  // as many as there are
    glm::dvec3 vector(std::string_view key, const glm::dvec3& fallback) const;
    glm::dvec3 unit(std::string_view key, const glm::dvec3& fallback) const;  // of whatever length above 0

    // `x`, which stands at `key`, if it lies within.
    double within(std::string_view key, double x, double least, double most) const;

private:
    const nlohmann::json& object_;
    std::string who_;
};

}  // namespace diptych
