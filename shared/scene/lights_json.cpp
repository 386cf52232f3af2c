// SPDX-License-Identifier: MIT
#include "shared/scene/lights_json.h"

#include "shared/image/file_bytes.h"
#include "shared/text/json.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace diptych {

namespace {

using Json = nlohmann::json;

// One object and where it stands, for messages.
class Fields {
public:
    Fields(const Json& object, std::string who) : object_(object), who_(std::move(who)) {
        if (!object.is_object()) throw std::runtime_error(who_ + ": is not an object");
    }

    [[noreturn]] void fail(std::string_view key, const std::string& why) const {
        throw std::runtime_error(fmt::format("{}: {}: {}", who_, oneLine(key), why));
    }

    const Json* find(const char* key) const {
        const auto at = object_.find(key);
        return at == object_.end() ? nullptr : &*at;
    }

    std::string text(const char* key, const std::string& fallback) const {
        const Json* value = find(key);
        if (value && !value->is_string()) fail(key, "is not a text");
        return value ? value->get<std::string>() : fallback;
    }

    // Finite and of at least `least`, as a float can hold it.
    double number(const char* key, double fallback, double least) const {
        const Json* value = find(key);
        if (!value) return fallback;
        if (!value->is_number()) fail(key, "is not a number");
        const double x = value->get<double>();
        if (!(std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max())))
            fail(key, fmt::format("{:g} is too large", x));
        if (x < least) fail(key, fmt::format("{:g} is below {:g}", x, least));
        return x;
    }

    glm::dvec3 vector(const char* key, const glm::dvec3& fallback) const {
        const Json* value = find(key);
        if (!value) return fallback;
        glm::dvec3 result(0);
        if (!value->is_array() || value->size() != 3) fail(key, "is not three numbers");
        for (int c = 0; c < 3; ++c) {
            const Json& x = (*value)[static_cast<std::size_t>(c)];
            if (!x.is_number() ||
                !(std::abs(x.get<double>()) <= static_cast<double>(std::numeric_limits<float>::max())))
                fail(key, "is not three finite numbers");
            result[c] = x.get<double>();
        }
        return result;
    }

    // A misspelt key would leave its default in force unseen.
    void knownOnly(std::initializer_list<std::string_view> known) const {
        for (const auto& [key, value] : object_.items())
            if (std::find(known.begin(), known.end(), key) == known.end() && key != "extras")
                fail(key, "is not a field of a light");
    }

private:
    const Json& object_;
    std::string who_;
};

LightKind kindOf(const Fields& fields) {
    const std::string type = fields.text("type", "");
    if (type == "directional") return LightKind::directional;
    if (type == "point") return LightKind::point;
    if (type == "spot") return LightKind::spot;
    for (const char* area : {"area", "rect", "disc", "tube"})
        if (type == area)
            fields.fail("type", type + " lights are not built yet: point, spot and directional are");
    fields.fail("type", type.empty()
                            ? "is missing: point, spot or directional"
                            : fmt::format("\"{}\" is none of point, spot, directional", oneLine(type)));
}

void readCone(const Fields& fields, Light& light) {
    const double inner = fields.number("innerConeAngle", static_cast<double>(light.inner_cone), 0);
    const double outer = fields.number("outerConeAngle", static_cast<double>(light.outer_cone), 0);
    if (outer > glm::half_pi<double>() + 1e-6)  // a rounded pi / 2 is one
        fields.fail("outerConeAngle", fmt::format("{:g} is beyond pi / 2", outer));
    if (!(static_cast<float>(inner) < static_cast<float>(outer)))
        fields.fail("innerConeAngle", fmt::format("{:g} is not below outerConeAngle {:g}", inner, outer));
    light.inner_cone = static_cast<float>(inner);
    light.outer_cone = static_cast<float>(std::min(outer, glm::half_pi<double>()));
}

Light readLight(const Json& object, const std::string& who) {
    const Fields fields(object, who);
    Light light;
    light.kind = kindOf(fields);  // first: a kind that is not built has fields of its own
    fields.knownOnly({"type", "name", "position", "direction", "color", "intensity", "range", "spot",
                      "innerConeAngle", "outerConeAngle"});
    light.name = fields.text("name", "");
    light.position = fields.vector("position", light.position);
    const glm::dvec3 direction = fields.vector("direction", light.direction);
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (!(largest >= std::numeric_limits<double>::min())) fields.fail("direction", "has no length");
    light.direction = glm::normalize(direction / largest);  // squares of small numbers would vanish
    light.color = glm::vec3(fields.vector("color", glm::dvec3(light.color)));
    if (light.color.r < 0 || light.color.g < 0 || light.color.b < 0) fields.fail("color", "is negative");
    light.intensity = static_cast<float>(fields.number("intensity", 1, 0));
    if (fields.find("range")) {
        const double range = fields.number("range", 0, 0);
        if (!(static_cast<float>(range) > 0)) fields.fail("range", "is not above 0");
        if (light.kind != LightKind::directional) light.range = static_cast<float>(range);
    }
    if (light.kind == LightKind::spot) {
        readCone(fields, light);
        if (const Json* spot = fields.find("spot")) {
            const Fields cone(*spot, who + ": spot");
            cone.knownOnly({"innerConeAngle", "outerConeAngle"});
            readCone(cone, light);
        }
    }
    return light;
}

std::vector<Light> readDocument(const Json& document) {
    if (!document.is_object() || !document.contains("lights") || !document["lights"].is_array())
        throw std::runtime_error("is not { \"lights\": [ ... ] }");
    std::vector<Light> lights;
    for (const Json& object : document["lights"])
        lights.push_back(readLight(object, fmt::format("light {}", lights.size())));
    return lights;
}

}  // namespace

std::vector<Light> lightsFromJson(std::string_view text, const std::string& name) {
    return named(name, [&] { return readDocument(parseJson(text)); });
}

std::vector<Light> readLights(const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = bytesOf(file);
    return lightsFromJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace diptych
