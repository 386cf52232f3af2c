// SPDX-License-Identifier: MIT
#include "shared/scene/lights/lights_json.h"

#include "shared/image/file_bytes.h"
#include "shared/scene/lights/json_fields.h"
#include "shared/scene/model/axes.h"
#include "shared/text/json.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace diptych {

namespace {

using Json = nlohmann::json;

#define DIPTYCH_TYPE(number, name, cost) {LightKind::name, #name},
constexpr std::pair<LightKind, std::string_view> types[] = {{LightKind::point, "point"},
                                                            {LightKind::spot, "spot"},
                                                            {LightKind::directional, "directional"},
                                                            AREA_KINDS(DIPTYCH_TYPE)};
#undef DIPTYCH_TYPE
constexpr std::pair<Importance, std::string_view> ranks[] = {{Importance::automatic, "auto"},
                                                             {Importance::important, "important"},
                                                             {Importance::not_important, "not_important"}};

// Keys that only some light types have.
struct OwnKey {
    std::string_view key;
    std::vector<LightKind> kinds;
};
const OwnKey ownKeys[] = {{"angle", {LightKind::directional}},
                          {"spot", {LightKind::spot}},
                          {"shadow", {LightKind::point, LightKind::spot}},
                          {"innerConeAngle", {LightKind::spot}},
                          {"outerConeAngle", {LightKind::spot}},
                          {"size", {LightKind::rect}},
                          {"axis", {LightKind::rect, LightKind::tube}},
                          {"twoSided", {LightKind::rect, LightKind::disc}},
                          {"radius", {LightKind::disc, LightKind::tube}},
                          {"length", {LightKind::tube}}};

constexpr double any = std::numeric_limits<double>::max();
// Bounds of sizes are 1 / maxCoordinate and maxCoordinate, because shaders square them in float32.
constexpr double minSize = 1 / maxCoordinate;  // m
constexpr double rounding = 1e-6;              // tolerance for an angle of pi written with few digits

bool takes(LightKind kind, std::string_view own) {
    return std::ranges::count(std::ranges::find(ownKeys, own, &OwnKey::key)->kinds, kind) > 0;
}

// The value named by the key's text. If it must not be absent, `fallback` names no value.
template <typename T, std::size_t N>
T valueOf(const JsonFields& fields, std::string_view key, const std::string& fallback,
          const std::pair<T, std::string_view> (&values)[N]) {
    const std::string text = fields.text(key, fallback);
    std::vector<std::string_view> names;
    for (const auto& [value, name] : values) {
        if (text == name) return value;
        names.push_back(name);
    }
    const std::string all = fmt::format("{}", fmt::join(names, ", "));
    fields.fail(key, text == fallback ? "is missing; use one of " + all
                                      : fmt::format("\"{}\" is not one of {}", oneLine(text), all));
}

// Unit of `intensity`.
std::string_view unitOf(LightKind kind) {
    if (kind == LightKind::directional) return "lx";
    return isArea(kind) ? "cd/m^2" : "cd";
}

void checkKeys(const JsonFields& fields, LightKind kind) {
    std::vector<std::string_view> known{"type",      "name",  "position",   "direction", "color",
                                        "intensity", "range", "importance", "unit"};
    for (const OwnKey& own : ownKeys) {
        known.push_back(own.key);
        if (takes(kind, own.key) || !fields.find(own.key)) continue;
        std::vector<std::string_view> owners;
        for (const LightKind owner : own.kinds) owners.push_back(nameOf(owner));
        fields.fail(own.key, fmt::format("applies only to {} lights; this is a {} light",
                                         fmt::join(owners, " and "), nameOf(kind)));
    }
    fields.knownOnly(known, "a light");
}

void readCone(const JsonFields& fields, Light& light) {
    constexpr double right = glm::half_pi<double>();
    const double inner = fields.number("innerConeAngle", double{light.inner_cone}, 0, any);
    const double outer = fields.number("outerConeAngle", double{light.outer_cone}, 0, any);
    if (outer > right + rounding) fields.fail("outerConeAngle", fmt::format("{:g} is above pi / 2", outer));
    if (!(static_cast<float>(inner) < static_cast<float>(outer)))
        fields.fail("innerConeAngle", fmt::format("{:g} is not below outerConeAngle {:g}", inner, outer));
    light.inner_cone = static_cast<float>(inner);
    light.outer_cone = static_cast<float>(std::min(outer, right));
}

float sizeIn(const JsonFields& fields, std::string_view key, float fallback) {
    return static_cast<float>(fields.number(key, double{fallback}, minSize, maxCoordinate));
}

glm::dvec3 levelAxis(const glm::dvec3& direction) {
    const glm::dvec3 right = glm::cross(direction, glm::dvec3(0, 1, 0));
    return glm::length(right) > rounding ? glm::normalize(right) : glm::dvec3(1, 0, 0);
}

// Perpendicular to the direction, unless it is free and given.
glm::dvec3 axisOf(const JsonFields& fields, const Light& light) {
    const glm::dvec3 axis = fields.unit("axis", levelAxis(light.direction));
    if (isClosed(light.kind) && fields.find("axis")) return axis;
    const glm::dvec3 across = axis - glm::dot(axis, light.direction) * light.direction;
    if (!(glm::length(across) > rounding)) fields.fail("axis", "is parallel to direction");
    return glm::normalize(across);
}

void readShape(const JsonFields& fields, Light& light) {
    std::array size{double{light.width}, double{light.height}};
    fields.numbers("size", size);
    for (const double side : size) fields.within("size", side, minSize, maxCoordinate);
    light.width = static_cast<float>(size[0]);
    light.height = static_cast<float>(size[1]);
    light.radius = sizeIn(fields, "radius", light.radius);
    light.length = sizeIn(fields, "length", light.length);
    light.two_sided = fields.flag("twoSided", light.two_sided);
    light.axis = axisOf(fields, light);
}

std::vector<Light> readDocument(const Json& document) {
    if (!document.is_object() || !document.contains("lights") || !document["lights"].is_array())
        throw std::runtime_error("is not { \"lights\": [ ... ] }");
    std::vector<Light> lights;
    for (const Json& object : document["lights"])
        lights.push_back(lightFromJson(object, fmt::format("light {}", lights.size())));
    return lights;
}

}  // namespace

Importance importanceOf(const JsonFields& fields) {
    return valueOf(fields, "importance", "auto", ranks);
}

float sunAngle(const JsonFields& fields) {
    const double angle = fields.number("angle", 0, 0, any);
    if (angle > glm::pi<double>() + rounding) fields.fail("angle", fmt::format("{:g} is above pi", angle));
    return static_cast<float>(std::min(angle, glm::pi<double>()));
}

nlohmann::ordered_json jsonOf(const Light& light) {
    using Ordered = nlohmann::ordered_json;
    const auto listOf = [](const glm::dvec3& v) { return Ordered{v.x, v.y, v.z}; };
    Ordered json{{"type", nameOf(light.kind)},
                 {"color", listOf(glm::dvec3(light.color))},
                 {"intensity", light.intensity},
                 {"unit", unitOf(light.kind)},
                 {"position", listOf(light.position)}};
    if (!light.name.empty()) json["name"] = light.name;
    if (light.kind != LightKind::point && !isClosed(light.kind)) json["direction"] = listOf(light.direction);
    if (std::isfinite(light.range)) json["range"] = light.range;
    if (light.kind == LightKind::directional) {
        if (light.angle > 0) json["angle"] = light.angle;
        json.erase("position");
    }
    if (light.kind == LightKind::spot)
        json["spot"] = {{"innerConeAngle", light.inner_cone}, {"outerConeAngle", light.outer_cone}};
    if (takes(light.kind, "size")) json["size"] = {light.width, light.height};
    if (takes(light.kind, "radius")) json["radius"] = light.radius;
    if (takes(light.kind, "length")) json["length"] = light.length;
    if (takes(light.kind, "axis")) json["axis"] = listOf(light.axis);
    if (takes(light.kind, "twoSided")) json["twoSided"] = light.two_sided;
    if (light.shadow) json["shadow"] = true;
    return json;
}

Light lightFromJson(const Json& object, const std::string& who) {
    const JsonFields fields(object, who);
    Light light;
    light.kind = valueOf(fields, "type", "", types);  // first, because it decides the allowed keys
    checkKeys(fields, light.kind);
    light.name = fields.text("name", "");
    light.position = fields.vector("position", light.position);
    for (int c = 0; c < 3; ++c) fields.within("position", light.position[c], -maxCoordinate, maxCoordinate);
    light.direction = fields.unit("direction", light.direction);
    light.color = glm::vec3(fields.vector("color", glm::dvec3(light.color)));
    if (light.color.r < 0 || light.color.g < 0 || light.color.b < 0) fields.fail("color", "is negative");
    light.intensity = static_cast<float>(fields.number("intensity", 1, 0, any));
    if (const std::string unit = fields.text("unit", std::string(unitOf(light.kind)));
        unit != unitOf(light.kind))
        fields.fail("unit", fmt::format("\"{}\": a {} light is given in {}", oneLine(unit),
                                        nameOf(light.kind), unitOf(light.kind)));
    if (fields.find("range")) {
        const double range = fields.number("range", 0, 0, any);
        if (!(static_cast<float>(range) > 0)) fields.fail("range", "is not above 0");
        if (light.kind != LightKind::directional) light.range = static_cast<float>(range);
    }
    if (light.kind == LightKind::directional) light.angle = sunAngle(fields);
    light.importance = importanceOf(fields);
    light.shadow = fields.flag("shadow", false);
    if (isArea(light.kind)) readShape(fields, light);
    if (light.kind == LightKind::spot) {
        readCone(fields, light);
        if (const Json* spot = fields.find("spot")) {
            const JsonFields cone(*spot, who + ": spot");
            constexpr std::array<std::string_view, 2> angles{"innerConeAngle", "outerConeAngle"};
            cone.knownOnly(angles, "a spot");
            readCone(cone, light);
        }
    }
    return light;
}

std::vector<Light> lightsFromJson(std::string_view text, const std::string& name) {
    return named(name, [&] { return readDocument(parseJson(text)); });
}

std::string_view nameOf(LightKind kind) {
    for (const auto& [of, name] : types)
        if (of == kind) return name;
    return "light";
}

std::vector<Light> readLights(const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = bytesOf(file);
    return lightsFromJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace diptych
