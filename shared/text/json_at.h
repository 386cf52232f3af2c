// SPDX-License-Identifier: MIT
#pragma once

#include "shared/text/fail.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {

// A value of parsed JSON and its path, for reading data of fixed shape. All mismatches throw
// std::runtime_error with the path: "frames[2]: has no \"name\"".
template <class Json>
class JsonAt {
public:
    explicit JsonAt(const Json& json, std::string where = {}) : json_(&json), where_(std::move(where)) {}

    const Json& json() const { return *json_; }
    [[noreturn]] void fail(const std::string& why) const {
        diptych::fail(where_.empty() ? why : where_ + ": " + why);
    }

    bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
    JsonAt at(const char* key) const {
        if (!has(key)) fail(fmt::format("has no \"{}\"", key));
        return JsonAt((*json_)[key], where_.empty() ? key : where_ + "." + key);
    }
    JsonAt operator[](std::size_t index) const {
        if (index >= size()) fail(fmt::format("has only {} elements", size()));
        return JsonAt((*json_)[index], fmt::format("{}[{}]", where_, index));
    }

    // The elements of an array.
    std::size_t size() const {
        if (!json_->is_array()) fail("is not an array");
        return json_->size();
    }
    std::vector<JsonAt> each() const {
        std::vector<JsonAt> elements;
        elements.reserve(size());
        for (std::size_t i = 0; i < json_->size(); ++i) elements.push_back((*this)[i]);
        return elements;
    }

    const std::string& text() const {
        if (!json_->is_string()) fail("is not a string");
        return json_->template get_ref<const std::string&>();
    }
    std::string textOr(const char* key, const std::string& fallback) const {
        return has(key) ? at(key).text() : fallback;
    }
    std::vector<std::string> texts() const {
        std::vector<std::string> all;
        for (const JsonAt& element : each()) all.push_back(element.text());
        return all;
    }
    bool flag() const {
        if (!json_->is_boolean()) fail("is not true or false");
        return json_->template get<bool>();
    }
    double number() const {
        if (!json_->is_number()) fail("is not a number");
        return json_->template get<double>();
    }
    double numberOr(const char* key, double fallback) const { return has(key) ? at(key).number() : fallback; }
    // An integer from `min` to `max`.
    template <class Whole>
    Whole whole(Whole min, Whole max) const {
        const bool fits = json_->is_number_unsigned()
                              ? std::cmp_greater_equal(json_->template get<std::uint64_t>(), min) &&
                                    std::cmp_less_equal(json_->template get<std::uint64_t>(), max)
                              : json_->is_number_integer() &&
                                    std::cmp_greater_equal(json_->template get<std::int64_t>(), min) &&
                                    std::cmp_less_equal(json_->template get<std::int64_t>(), max);
        if (!fits) fail(fmt::format("is not a whole number from {} to {}", min, max));
        return json_->template get<Whole>();
    }
    // An index into `count` elements.
    std::size_t index(std::size_t count) const {
        if (count == 0) fail("is an index into an empty list");
        return whole<std::size_t>(0, count - 1);
    }

private:
    const Json* json_;
    std::string where_;
};

}  // namespace diptych
