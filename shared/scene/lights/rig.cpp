// SPDX-License-Identifier: MIT
#include "shared/scene/lights/rig.h"

#include "shared/image/free_memory.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/scene/model/luminance.h"
#include "shared/scene/motion/bounds.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string_view>

namespace diptych {
namespace {

constexpr double TAU = 2.0 * std::numbers::pi;
constexpr std::uint64_t MAX_LIGHTS = std::uint64_t{1} << 31;
constexpr double LIGHTS_AT_A_POINT = 6.0;
constexpr double CANDELA_PER_RANGE_SQUARED = 0.4;

// Each light type draws random numbers from its own stream.
enum class Stream : std::uint32_t { point, spot, area };
constexpr std::array<std::string_view, 3> STREAM_NAMES{"point", "spot", "area"};

struct Order {
    Stream stream;
    std::uint64_t count;
};

struct Box {
    glm::dvec3 min, size;
};

[[noreturn]] void failLights(const std::string& lights, const std::string& fault) {
    throw std::runtime_error(
        fmt::format("--lights {}: {}; it takes KIND:N[,KIND:N...] with KIND point, spot or area, or the name "
                    "of a JSON file",
                    lights, fault));
}

Order parseOrder(const std::string& lights, std::string_view item) {
    const std::size_t colon = item.find(':');
    if (colon == std::string_view::npos)
        failLights(lights, fmt::format("'{}' is not KIND:N or a file", item));
    const std::string_view kind = item.substr(0, colon), digits = item.substr(colon + 1);
    const auto found = std::ranges::find(STREAM_NAMES, kind);
    if (found == STREAM_NAMES.end()) failLights(lights, fmt::format("unknown kind '{}'", kind));
    std::uint64_t count = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
    if (error == std::errc::result_out_of_range) count = MAX_LIGHTS + 1;
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
        failLights(lights, fmt::format("'{}' is not a count", digits));
    return {static_cast<Stream>(found - STREAM_NAMES.begin()), count};
}

std::vector<Order> parseOrders(const std::string& lights) {
    std::vector<Order> orders;
    std::uint64_t total = 0;
    for (std::size_t begin = 0; begin <= lights.size();) {
        const std::size_t end = std::min(lights.find(',', begin), lights.size());
        orders.push_back(parseOrder(lights, std::string_view(lights).substr(begin, end - begin)));
        if (orders.back().count > MAX_LIGHTS - total)
            failLights(lights, fmt::format("more than 2^31 ({}) lights", MAX_LIGHTS));
        total += orders.back().count;
        begin = end + 1;
    }
    return orders;
}

std::uint64_t countOf(const std::vector<Order>& orders) {
    std::uint64_t total = 0;
    for (const Order& order : orders) total += order.count;
    return total;
}

bool isFile(const std::string& lights) {
    std::error_code ignored;
    return lights.ends_with(".json") || std::filesystem::exists(lights, ignored);
}

Box boxIn(const Bounds& bounds) {
    if (bounds.empty()) return {glm::dvec3(-1.0), glm::dvec3(2.0)};
    Box box{bounds.min, bounds.max - bounds.min};
    const double longest = std::max({box.size.x, box.size.y, box.size.z});
    if (!std::isfinite(longest)) throw std::runtime_error("--lights: the scene's bounds are not finite");
    const double min = longest > 0 ? longest / 8 : 1.0;
    for (int axis : {0, 1, 2}) {
        const double grow = std::max(0.0, min - box.size[axis]);
        box.size[axis] += grow;
        if (axis != 1) box.min[axis] -= grow / 2;
    }
    return box;
}

double frac(double x) {
    return x - std::floor(x);
}

// A colour of this hue (0 and 1 red, 1/3 green, 2/3 blue) mixed with white; its largest component is 1.
glm::dvec3 pastel(double hue) {
    const auto ramp = [hue](double shift) {
        return std::clamp(std::abs(frac(hue + shift) * 6 - 3) - 1, 0.0, 1.0);
    };
    return 0.6 * glm::dvec3(ramp(0.0), ramp(2.0 / 3), ramp(1.0 / 3)) + 0.4;
}

// A direction within 35 degrees of straight down; almost uniform over that cap.
glm::dvec3 downwards(double u, double v) {
    const double tilt = 35.0 / 360.0 * TAU * std::sqrt(u), azimuth = TAU * v;
    return {std::sin(tilt) * std::cos(azimuth), -std::cos(tilt), std::sin(tilt) * std::sin(azimuth)};
}

// Turns a point light into an area light with a size proportional to `range`. Its brightest direction gets
// the point light's intensity.
void spreadOut(Light& light, double range, double shape, const std::array<double, 3>& u) {
    light.axis = glm::normalize(
        glm::cross(light.direction, glm::dvec3(std::cos(TAU * u[0]), 0, std::sin(TAU * u[0]))));
    if (shape < 1) {
        light.kind = LightKind::rect;
        light.width = static_cast<float>(range * (0.2 + 0.3 * u[1]));
        light.height = light.width * static_cast<float>(0.25 + 0.75 * u[2]);
    } else if (shape < 2) {
        light.kind = LightKind::disc;
        light.radius = static_cast<float>(range * (0.1 + 0.15 * u[1]));
    } else {
        light.kind = LightKind::tube;
        light.length = static_cast<float>(range * (0.3 + 0.4 * u[1]));
        light.radius = light.length * static_cast<float>(0.01 + 0.04 * u[2]);
    }
    light.intensity = static_cast<float>(double{light.intensity} / intensityFromAfar(light, 1));
}

Light makeLight(Stream stream, std::uint32_t key, std::uint32_t index, const Box& box, double range) {
    const std::uint32_t own = pcg(key + index);
    const auto u = [own](std::uint32_t k) { return u01(own + k); };

    constexpr double G = 1.2207440846057596;  // g^4 = g + 1
    glm::dvec3 location;
    double power = 1;
    for (int axis : {0, 1, 2}) {
        power *= G;
        location[axis] = frac(u01(key + static_cast<std::uint32_t>(axis) + 1) + (index + 1.0) / power);
    }
    if (stream != Stream::point) location.y = 0.5 + 0.5 * location.y;

    const glm::dvec3 color = pastel(u(0));
    Light light;
    light.name = fmt::format("{} {}", STREAM_NAMES[static_cast<std::size_t>(stream)], index);
    light.position = box.min + box.size * location;
    light.color = glm::vec3(color);
    light.intensity = static_cast<float>(CANDELA_PER_RANGE_SQUARED * range * range / luminance(color));
    light.range = static_cast<float>(range);
    if (stream == Stream::point) return light;
    light.direction = downwards(u(1), u(2));
    if (stream == Stream::area) {
        spreadOut(light, range, 3 * u(3), {u(4), u(5), u(6)});
        return light;
    }
    const double outer = (20.0 + 20.0 * u(3)) / 360.0 * TAU;
    light.kind = LightKind::spot;
    light.range *= 2;
    light.outer_cone = static_cast<float>(outer);
    light.inner_cone = static_cast<float>(0.7 * outer);
    return light;
}

}  // namespace

std::uint32_t pcg(std::uint32_t i) {
    const std::uint32_t state = i * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

double u01(std::uint32_t i) {
    return pcg(i) / 4294967296.0;
}

std::uint64_t rigBytes(const std::string& lights) {
    if (lights.empty() || isFile(lights)) return 0;
    return static_cast<std::uint64_t>(lightBytes * static_cast<double>(countOf(parseOrders(lights))));
}

std::vector<Light> makeLights(const std::string& lights, std::uint32_t seed, const Bounds& bounds) {
    if (lights.empty()) return {};
    if (isFile(lights)) return readLights(lights);

    const std::vector<Order> orders = parseOrders(lights);
    const std::uint64_t total = countOf(orders);
    checkMemory("--lights " + lights, rigBytes(lights), "fewer lights need less");
    std::vector<Light> made;
    made.reserve(total);

    const Box box = boxIn(bounds);
    const double volume = box.size.x * box.size.y * box.size.z;
    const double range = std::cbrt(LIGHTS_AT_A_POINT * 3 / (2 * TAU) * volume /
                                   static_cast<double>(std::max<std::uint64_t>(total, 1)));
    std::array<std::uint32_t, STREAM_NAMES.size()> next{};
    for (const Order& order : orders) {
        const auto stream = static_cast<std::uint32_t>(order.stream);
        const std::uint32_t key = pcg(seed + pcg(stream));
        for (std::uint64_t n = 0; n < order.count; ++n)
            made.push_back(makeLight(order.stream, key, next[stream]++, box, range));
    }
    return made;
}

Light defaultSun(const glm::dvec3& towardsEye) {
    const glm::dvec3 up(0, 1, 0), eye = glm::normalize(towardsEye);
    const glm::dvec3 side = glm::cross(eye, up);  // to the left of the viewer who looks along -eye
    const double length = glm::length(side);
    const glm::dvec3 left = length > 1e-6 ? side / length : glm::dvec3(-1, 0, 0);
    Light sun;
    sun.name = "default sun";
    sun.kind = LightKind::directional;
    sun.intensity = 3;
    sun.direction = -glm::normalize(eye + 0.9 * up + 0.35 * left);
    return sun;
}

}  // namespace diptych
