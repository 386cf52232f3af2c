// SPDX-License-Identifier: MIT
#include "shared/scene/gltf_schema.h"

#include "shared/scene/gltf_properties.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;
using schema::Kind;
using schema::Property;

// Where the walk is: "mesh 0, primitive 1: attributes". Put into words only where something is wrong.
struct Where {
    const Where* outer = nullptr;
    std::string_view what = {};
    std::size_t item = none;

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::string words() const {
        if (what.empty()) return {};
        std::string text = outer ? outer->words() : std::string();
        if (!text.empty()) text += item == none ? ": " : ", ";
        text += what;
        if (item != none) text += fmt::format(" {}", item);
        return text;
    }
};

[[noreturn]] void fail(const Where& where, const std::string& why) {
    const std::string words = where.words();
    throw std::runtime_error(words.empty() ? why : words + ": " + why);
}

// A value as a line shows it.
std::string quoted(const Json& value) {
    switch (value.type()) {
        case Json::value_t::object:
            return "an object";
        case Json::value_t::array:
            return "an array";
        case Json::value_t::string:
            return fmt::format("\"{}\"", oneLine(value.get_ref<const std::string&>()));
        default:
            return value.dump();
    }
}

class Walk {
public:
    explicit Walk(const Json& document) : document_(document) {}

    std::set<std::string> unknown_extensions;

    // Takes out what is not read and checks the rest.
    void object(Json& value, std::span<const Property> properties, const Where& where) {
        if (!value.is_object()) fail(where, fmt::format("is {}, not an object", quoted(value)));
        for (auto at = value.begin(); at != value.end();) {
            const auto property = std::ranges::find(properties, at.key(), &Property::key);
            if (property == properties.end()) {
                at = value.erase(at);
                continue;
            }
            check(at.value(), *property, where);
            ++at;
        }
        for (const Property& property : properties)
            if (property.required && !value.contains(property.key))
                fail(where, fmt::format("has no {}", property.key));
    }

private:
    const Json& document_;

    void check(Json& value, const Property& p, const Where& where) {
        switch (p.kind) {
            case Kind::whole:
                return whole(value, p, where);
            case Kind::number:
                return number(value, p, where);
            case Kind::flag:
                if (!value.is_boolean()) wrong(value, p.key, "true or false", where);
                return;
            case Kind::text:
                return text(value, p, where);
            case Kind::name:
                if (!value.is_string()) wrong(value, p.key, "text", where);
                value = oneLine(value.get_ref<const std::string&>());
                return;
            case Kind::numbers:
                return numbers(value, p, where);
            case Kind::index:
                return index(value, p.key, p.of, where);
            case Kind::indices:
                for (Json& item : array(value, p, where)) index(item, p.key, p.of, where);
                return;
            case Kind::names:
                for (Json& item : array(value, p, where))
                    if (!item.is_string()) wrong(item, p.key, "text", where);
                return;
            case Kind::attributes:
                return attributes(value, p, {&where, p.key});
            case Kind::attribute_sets:
                for (std::size_t i = 0; Json & item : array(value, p, where))
                    attributes(item, p, {&where, "morph target", i++});
                return;
            case Kind::object:
                return object(value, p.properties, {&where, p.key});
            case Kind::objects:
                for (std::size_t i = 0; Json & item : array(value, p, where))
                    object(item, p.properties, {&where, p.of, i++});
                return;
            case Kind::extensions:
                return extensions(value, p, where);
        }
    }

    [[noreturn]] static void wrong(const Json& value, std::string_view key, std::string_view expected,
                                   const Where& where) {
        fail(where, fmt::format("{} is {}, not {}", key, quoted(value), expected));
    }

    static Json& array(Json& value, const Property& p, const Where& where) {
        if (!value.is_array()) wrong(value, p.key, "an array", where);
        return value;
    }

    // In range, whatever the type that it is written in.
    static void range(const Json& value, std::string_view key, const Property& p, const Where& where) {
        const double v = value.get<double>();
        if (v >= p.min && v <= p.max) return;
        const bool bounded = p.max < std::numeric_limits<int>::max();
        wrong(value, key,
              bounded     ? fmt::format("from {} to {}", p.min, p.max)
              : v < p.min ? fmt::format("at least {}", p.min)
                          : fmt::format("at most {}", p.max),
              where);
    }

    static void number(const Json& value, const Property& p, const Where& where) {
        if (!value.is_number()) wrong(value, p.key, "a number", where);
        range(value, p.key, p, where);
    }

    static void whole(Json& value, const Property& p, const Where& where) {
        if (!value.is_number()) wrong(value, p.key, "a whole number", where);
        const double v = value.get<double>();
        if (v != std::floor(v)) wrong(value, p.key, "a whole number", where);
        range(value, p.key, p, where);
        value = static_cast<std::int64_t>(v);
    }

    static void text(const Json& value, const Property& p, const Where& where) {
        if (!value.is_string()) wrong(value, p.key, "text", where);
        if (p.choices.empty()) return;
        const std::string& text = value.get_ref<const std::string&>();
        if (text.find(' ') != text.npos ||
            fmt::format(" {} ", p.choices).find(fmt::format(" {} ", text)) == std::string::npos)
            wrong(value, p.key, fmt::format("one of {}", p.choices), where);
    }

    static void numbers(Json& value, const Property& p, const Where& where) {
        array(value, p, where);
        if (value.size() < p.least || value.size() > p.most)
            fail(where, fmt::format("{} has {} numbers, not {}", p.key, value.size(), p.least));
        for (std::size_t i = 0; i < value.size(); ++i) {
            const auto key = [&] { return fmt::format("{}[{}]", p.key, i); };
            if (!value[i].is_number()) wrong(value[i], key(), "a number", where);
            const double v = value[i].get<double>();
            if (!(v >= p.min && v <= p.max)) range(value[i], key(), p, where);
        }
    }

    struct Collection {
        std::size_t count;
        std::string_view one;  // what a message calls an item
    };

    // What an index may lead to.
    Collection collection(std::string_view key) const {
        static const Json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
        if (key.empty()) return {std::numeric_limits<int>::max(), ""};
        if (key == "KHR_lights_punctual")
            return {document_.contains(lights) ? document_[lights].size() : 0, "light"};
        const auto at = document_.find(key);
        return {at == document_.end() || !at->is_array() ? 0 : at->size(),
                std::ranges::find(schema::document, key, &Property::key)->of};
    }

    void index(Json& value, std::string_view key, std::string_view of, const Where& where) const {
        if (!value.is_number() || value.get<double>() != std::floor(value.get<double>()))
            wrong(value, key, "an index", where);
        const double v = value.get<double>();
        const auto [count, one] = collection(of);
        if (!(v >= 0 && v < static_cast<double>(count)))
            fail(where,
                 fmt::format("{}{} {}, but the file has {}", key == one ? "" : fmt::format("{} names ", key),
                             one, value.dump(), count));
        value = static_cast<std::int64_t>(v);
    }

    void attributes(Json& value, const Property& p, const Where& where) const {
        if (!value.is_object()) fail(where, fmt::format("is {}, not an object", quoted(value)));
        for (auto at = value.begin(); at != value.end(); ++at) {
            const std::string name = oneLine(at.key());
            if (name != at.key()) fail(where, fmt::format("{} is no name of an attribute", name));
            index(at.value(), name, p.of, where);
        }
    }

    void extensions(Json& value, const Property& p, const Where& where) {
        if (!value.is_object()) wrong(value, p.key, "an object", where);
        for (auto at = value.begin(); at != value.end();) {
            const auto property = std::ranges::find(p.properties, at.key(), &Property::key);
            if (property == p.properties.end()) {
                unknown_extensions.insert(oneLine(at.key()));
                at = value.erase(at);
                continue;
            }
            check(at.value(), *property, where);
            ++at;
        }
    }
};

// What one property says of another.
void checkAccessors(const Json& document) {
    constexpr std::array types{5120, 5121, 5122, 5123, 5125, 5126};
    static const Json none = Json::array();
    for (std::size_t i = 0;
         const Json& accessor : document.contains("accessors") ? document["accessors"] : none) {
        const Where where{nullptr, "accessor", i++};
        if (const int type = accessor["componentType"].get<int>();
            std::ranges::find(types, type) == types.end())
            fail(where, fmt::format("componentType {} is none of glTF's", type));
        if (accessor.contains("sparse") && accessor["sparse"]["count"] > accessor["count"])
            fail(where, fmt::format("{} sparse elements of {}", accessor["sparse"]["count"].dump(),
                                    accessor["count"].dump()));
    }
    for (std::size_t i = 0;
         const Json& view : document.contains("bufferViews") ? document["bufferViews"] : none) {
        const Where where{nullptr, "bufferView", i++};
        if (const int stride = view.value("byteStride", 4); stride % 4 != 0)
            fail(where, fmt::format("byteStride {} is no multiple of 4", stride));
    }
}

// A camera and a spot light bring an object that their type names.
void checkKinds(const Json& document) {
    static const Json none = Json::array();
    for (std::size_t i = 0; const Json& camera : document.contains("cameras") ? document["cameras"] : none) {
        const Where where{nullptr, "camera", i++};
        const std::string& type = camera["type"].get_ref<const std::string&>();
        if (!camera.contains(type)) fail(where, fmt::format("is {0}, but has no {0}", type));
    }
    static const Json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    for (std::size_t i = 0; const Json& light : document.contains(lights) ? document[lights] : none) {
        const Where where{nullptr, "light", i++};
        if (light["type"] == "spot" && !light.contains("spot")) fail(where, "is spot, but has no spot");
    }
}

}  // namespace

std::set<std::string> applySchema(nlohmann::json& document) {
    Walk walk(document);
    walk.object(document, schema::document, {});
    checkAccessors(document);
    checkKinds(document);
    if (const auto used = document.find("extensionsUsed"); used != document.end())
        for (const Json& name : *used)
            walk.unknown_extensions.insert(oneLine(name.get_ref<const std::string&>()));
    return std::move(walk.unknown_extensions);
}

}  // namespace diptych::gltf
