// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/schema.h"

#include "shared/scene/gltf/properties.h"
#include "shared/scene/gltf/references.h"
#include "shared/scene/gltf/rules.h"
#include "shared/scene/gltf/value.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;
using schema::Kind;
using schema::Property;

// The current position in the document: "mesh 0, primitive 1: attributes". Its text is built only for
// messages.
struct Where {
    const Where* outer = nullptr;
    std::string_view what = {};
    std::size_t item = none;

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::string describe() const {
        if (what.empty()) return {};
        std::string text = outer ? outer->describe() : std::string();
        if (!text.empty()) text += item == none ? ": " : ", ";
        text += what;
        if (item != none) text += fmt::format(" {}", item);
        return text;
    }
};

std::string lineAt(const Where& where, const std::string& what) {
    const std::string sentence = where.describe();
    return sentence.empty() ? what : sentence + ": " + what;
}
[[noreturn]] void failAt(const Where& where, const std::string& why) {
    throw std::runtime_error(lineAt(where, why));
}

bool isWhole(const Json& value) {
    return value.is_number() && value.get<double>() == std::floor(value.get<double>());
}

// Formats a value for messages.
std::string quoted(const Json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array";
    if (value.is_string()) return fmt::format("\"{}\"", oneLine(value.get_ref<const std::string&>()));
    return value.dump();
}

class Walk {
public:
    explicit Walk(const Json& document) : references(document) {}

    References references;
    std::set<std::string> met_extensions;
    std::map<std::string, std::string> misplaced;  // extension -> where it occurs
    NoteList notes{"objects"};

    // Removes unsupported members and checks the others.
    void object(Json& value, std::span<const Property> properties, const Where& where) {
        if (!value.is_object()) failAt(where, fmt::format("is {}, not an object", quoted(value)));
        members(value, properties, where, [&](const auto& at, bool known) {
            if (!known && at.key() == "extensions") leaveOut(at.value(), where);
        });
        for (const Property& property : properties)
            if (property.required && !value.contains(property.key))
                failAt(where, fmt::format("has no {}", property.key));
    }

private:
    // Calls meet(member, whether it is supported) for each.
    template <class Meet>
    void members(Json& value, std::span<const Property> properties, const Where& where, const Meet& meet) {
        for (auto at = value.begin(); at != value.end();) {
            const auto property = std::ranges::find(properties, at.key(), &Property::key);
            const bool known = property != properties.end();
            meet(at, known);
            if (!known || isAbsent(at.value(), *property, where)) {
                at = value.erase(at);
                continue;
            }
            check(at.value(), *property, where);
            ++at;
        }
    }

    // Notes the extensions of an object that supports none.
    void leaveOut(const Json& extensions, const Where& where) {
        if (!extensions.is_object()) return;
        for (const auto& extension : extensions.items()) met(extension.key(), false, where);
    }

    void met(const std::string& extension, bool read, const Where& where) {
        const std::string name = oneLine(extension);
        met_extensions.insert(name);
        if (!read && !misplaced.contains(name)) misplaced[name] = where.describe();
    }

    // Exporters write null for absent values, and numbers for names; neither affects rendering.
    bool isAbsent(const Json& value, const Property& p, const Where& where) {
        if (p.kind == Kind::extras) return !memberOf(value, "diptych");
        if (value.is_null()) {
            notes.add(lineAt(where, fmt::format("{} is null: ignored", p.key)));
            return true;
        }
        if (p.kind != Kind::name || p.required || value.is_string()) return false;
        notes.add(lineAt(where, fmt::format("{} is {}, not text: left out", p.key, quoted(value))));
        return true;
    }

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
                return objects(array(value, p, where), p, where);
            case Kind::extensions:
                return extensions(value, p, where);
            case Kind::extras:
                value = Json{{"diptych", std::move(value["diptych"])}};
                return;
        }
    }

    // A fault in an item of a collection is not fatal yet, because the item may be unused.
    void objects(Json& value, const Property& p, const Where& where) {
        const std::string_view collection = p.of == "light" ? "KHR_lights_punctual" : p.key;
        const bool items = !references.inside();
        for (std::size_t i = 0; i < value.size(); ++i) {
            if (!items) {
                object(value[i], p.properties, {&where, p.of, i});
                continue;
            }
            const Where here{p.of == "light" ? nullptr : &where, p.of, i};
            references.enter(collection, i);
            const std::string fault = faultOf([&] {
                object(value[i], p.properties, here);
                checkRules(collection, value[i], here.describe(), notes);
            });
            if (!fault.empty()) references.broken(collection, i, fault);
            references.leave();
        }
    }

    [[noreturn]] static void wrong(const Json& value, std::string_view key, std::string_view expected,
                                   const Where& where) {
        failAt(where, fmt::format("{} is {}, not {}", key, quoted(value), expected));
    }

    static Json& array(Json& value, const Property& p, const Where& where) {
        if (!value.is_array()) wrong(value, p.key, "an array", where);
        return value;
    }

    // Checks the range of a JSON number of any type.
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
        if (!isWhole(value)) wrong(value, p.key, "a whole number", where);
        range(value, p.key, p, where);
        value = static_cast<std::int64_t>(value.get<double>());
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
        if (value.size() < p.min_count || value.size() > p.max_count)
            failAt(where, fmt::format("{} has {} numbers, not {}", p.key, value.size(), p.min_count));
        for (std::size_t i = 0; i < value.size(); ++i) {
            const auto key = [&] { return fmt::format("{}[{}]", p.key, i); };
            if (!value[i].is_number()) wrong(value[i], key(), "a number", where);
            const double v = value[i].get<double>();
            if (!(v >= p.min && v <= p.max)) range(value[i], key(), p, where);
        }
    }

    // Checks that an index refers to an existing item; without a collection any index is valid. A broken
    // mesh, skin or camera is only removed from its node.
    void index(Json& value, std::string_view key, std::string_view of, const Where& where) {
        if (!isWhole(value)) wrong(value, key, "an index", where);
        const double v = value.get<double>();
        const std::size_t count = of.empty() ? std::numeric_limits<int>::max() : references.count(of);
        if (!(v >= 0 && v < static_cast<double>(count))) {
            const std::string_view one = of == "KHR_lights_punctual" ? "light" : schema::itemOf(of);
            failAt(where,
                   fmt::format("{}{} {}, but the file has {}",
                               key == one ? "" : fmt::format("{} names ", key), one, value.dump(), count));
        }
        value = static_cast<std::int64_t>(v);
        if (!of.empty() && of != "skins" && of != "cameras" && of != "meshes")
            references.names(of, static_cast<std::size_t>(v));
    }

    void attributes(Json& value, const Property& p, const Where& where) {
        if (!value.is_object()) failAt(where, fmt::format("is {}, not an object", quoted(value)));
        for (auto at = value.begin(); at != value.end();) {
            const std::string name = oneLine(at.key());
            if (name != at.key()) failAt(where, fmt::format("{} is not an attribute name", name));
            if (at.value().is_null()) {
                notes.add(lineAt(where, name + " is null: ignored"));
                at = value.erase(at);
                continue;
            }
            index(at.value(), name, p.of, where);
            ++at;
        }
    }

    void extensions(Json& value, const Property& p, const Where& where) {
        if (!value.is_object()) wrong(value, p.key, "an object", where);
        members(value, p.properties, where, [&](const auto& at, bool known) { met(at.key(), known, where); });
    }
};

}  // namespace

Schema applySchema(nlohmann::json& document) {
    Walk walk(document);
    walk.object(document, schema::document, {});
    checkStrides(document, walk.references, walk.notes);
    std::map<std::size_t, std::string> meshes = leaveOutUnusable(document, walk.references, walk.notes);
    Schema found{std::move(walk.met_extensions), {}, std::move(walk.misplaced), std::move(meshes), {}};
    if (const auto used = document.find("extensionsUsed"); used != document.end())
        for (const Json& name : *used) found.declared.insert(oneLine(name.get_ref<const std::string&>()));
    walk.notes.moveTo(found.notes);
    return found;
}

}  // namespace diptych::gltf
