// SPDX-License-Identifier: MIT
#include "shared/light/per_object.h"

#include "shared/scene/model/luminance.h"

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace diptych {

namespace {

constexpr std::size_t vertexLights = 4;

double windowAt(const LightFalloff& falloff, const gpu::Light& light, double distance) {
    return falloff.window(distance * distance * double{light.inverse_range_squared});
}

double coneAt(const LightFalloff& falloff, const gpu::SpotCone& cone, double cosine) {
    return falloff.cone(double{cone.offset} + cosine * double{cone.scale});
}

// Cosine of the smallest angle between the light's axis and a direction to the box's bounding sphere.
double nearestCosine(const glm::dvec3& axis, const glm::dvec3& to_centre, double radius) {
    const double distance = glm::length(to_centre);
    if (distance <= radius) return 1;
    const double off = std::acos(std::clamp(glm::dot(axis, to_centre) / distance, -1.0, 1.0));
    return std::cos(std::max(0.0, off - std::asin(radius / distance)));
}

// Enlarges the box by more than the shaders' float32 rounding of positions and comparisons.
ObjectPosition widened(ObjectPosition object) {
    constexpr double relative = 1e-5;
    object.half += relative * (glm::abs(object.centre) + object.half);
    return object;
}

// Fractions of lights in a group with capacity `room` for `members`, or in a better group; `taken` are
// those in better groups. Moves the brightest members to the front, ties in scene order (`sources`).
// Brightness is compared in float32, so that double rounding ranks nothing.
std::vector<double> fractionsIn(std::vector<std::size_t>& members, std::size_t room,
                                std::span<const double> brightness, std::span<const std::size_t> sources,
                                std::span<const double> taken) {
    if (members.size() <= room) return std::vector<double>(brightness.size(), 1.0);
    const auto key = [&](std::size_t i) { return std::pair(-static_cast<float>(brightness[i]), sources[i]); };
    std::ranges::nth_element(members, members.begin() + static_cast<std::ptrdiff_t>(room), {}, key);
    const double threshold = brightness[members[room]];  // of the first light beyond the capacity
    std::vector<double> fractions;
    for (std::size_t i = 0; i < brightness.size(); ++i)
        fractions.push_back(std::max(taken[i], fade(brightness[i], threshold)));
    // Lights of exactly the threshold's brightness share the remaining capacity.
    double left = static_cast<double>(room);
    std::vector<std::size_t> equal;
    for (const std::size_t i : members)
        if (static_cast<float>(brightness[i]) == static_cast<float>(threshold))
            equal.push_back(i);
        else
            left -= fractions[i] - taken[i];
    if (equal.size() < 2) return fractions;
    std::ranges::sort(equal, {}, [&](std::size_t i) { return sources[i]; });
    for (const std::size_t i : equal) {
        const double more = std::clamp(left, 0.0, 1 - taken[i]);
        fractions[i] = taken[i] + more;
        left -= more;
    }
    return fractions;
}

}  // namespace

double brightnessAt(const GpuLights& lights, std::size_t i, const ObjectPosition& object) {
    const gpu::Light& light = lights.lights[i];
    const double strength = luminance(glm::dvec3(light.intensity));
    if (i < lights.directional) return strength;
    const ObjectPosition box = widened(object);
    const glm::dvec3 to_centre = box.centre - glm::dvec3(light.position);
    const glm::dvec3 outside = glm::max(glm::abs(to_centre) - box.half, glm::dvec3(0));
    const double nearest = glm::length(outside), radius = glm::length(box.half);
    const double reach = windowAt(lights.falloff, light, nearest * (1 - 1e-5));
    if (!(reach > 0)) return 0;
    double shone = strength * reach / (nearest * nearest + radius * radius / 4 + 1e-20);
    if (const gpu::AreaLight* area = lights.shapeOf(i)) {
        const double extent = double{area->extent}, near = std::max(nearest - extent, 0.0);
        const double square = near * near + radius * radius / 4 + extent * extent + 1e-20;
        shone = strength * reach * shownArea(lights, i, {}).max / square;
    }
    if (const gpu::SpotCone* cone = lights.coneOf(i))
        shone *= coneAt(lights.falloff, *cone,
                        nearestCosine(glm::dvec3(cone->direction), to_centre, radius) + 1e-5);
    return shone;
}

double fade(double brightness, double threshold) {
    if (!(threshold > 0)) return 1;
    if (!(brightness > threshold)) return 0;
    const double x = std::clamp(std::log(brightness / threshold) / std::log(fadeRange), 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

std::vector<LightFractions> lightFractions(const GpuLights& lights, const ObjectPosition& object,
                                           std::uint32_t pixels) {
    const std::size_t count = lights.count();
    std::vector<double> brightness(count);
    for (std::size_t i = 0; i < count; ++i) brightness[i] = brightnessAt(lights, i, object);
    std::vector<std::size_t> ranked, others;
    for (std::size_t i = 0; i < count; ++i) {
        if (!(brightness[i] > 0)) continue;
        if (lights.importance[i] == Importance::automatic) ranked.push_back(i);
        if (lights.importance[i] == Importance::not_important) others.push_back(i);
    }
    const std::vector<double> none(count);
    std::vector<double> pixel = fractionsIn(ranked, pixels, brightness, lights.sources, none);
    for (std::size_t i = 0; i < count; ++i) {
        const bool always = lights.importance[i] == Importance::important || i == lights.base;
        if (always) pixel[i] = 1;
        if (!always && lights.importance[i] == Importance::not_important) pixel[i] = 0;
    }
    // Lights that are not among the per-pixel ones.
    if (pixels < ranked.size())
        others.insert(others.end(), ranked.begin() + static_cast<std::ptrdiff_t>(pixels), ranked.end());
    const std::vector<double> either = fractionsIn(others, vertexLights, brightness, lights.sources, pixel);

    std::vector<LightFractions> fractions(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (!(brightness[i] > 0)) continue;
        // Vertices do not support area lights.
        const double vertex = lights.shapeOf(i) ? 0 : either[i] - pixel[i];
        fractions[i] = {pixel[i], vertex, 1 - (pixel[i] + vertex)};
    }
    return fractions;
}

void addHarmonics(gpu::ObjectIrradiance& sum, const glm::dvec3& e, const glm::dvec3& l, double directed) {
    const glm::dvec3 linear = e * (directed / 2), square = e * (directed * directed * 15 / 32);
    sum.constant += glm::vec3(e / 4.0);
    sum.linear_x += glm::vec3(linear * l.x);
    sum.linear_y += glm::vec3(linear * l.y);
    sum.linear_z += glm::vec3(linear * l.z);
    // 5/32 (3 l l' - 1) is traceless: its last square is minus the others.
    sum.xx += glm::vec3(square * (l.x * l.x - 1.0 / 3));
    sum.yy += glm::vec3(square * (l.y * l.y - 1.0 / 3));
    sum.xy += glm::vec3(square * (l.x * l.y));
    sum.yz += glm::vec3(square * (l.y * l.z));
    sum.xz += glm::vec3(square * (l.x * l.z));
}

void addHarmonics(gpu::ObjectIrradiance& sum, const GpuLights& lights, std::size_t i,
                  const ObjectPosition& object, double fraction) {
    const gpu::Light& light = lights.lights[i];
    const glm::dvec3 intensity = glm::dvec3(light.intensity) * fraction;
    if (i < lights.directional) return addHarmonics(sum, intensity, glm::dvec3(light.position));
    const glm::dvec3 to_light = glm::dvec3(light.position) - object.centre;
    const double distance = glm::length(to_light), radius = std::max(glm::length(object.half), 1e-10);
    const glm::dvec3 l = distance > 0 ? to_light / distance : glm::dvec3(0);
    const gpu::AreaLight* area = lights.shapeOf(i);
    const double soft = std::max(distance, area ? std::max(radius, double{area->extent}) : radius);
    double shone = windowAt(lights.falloff, light, distance) / (soft * soft);
    if (area) shone *= shownArea(lights, i, -l).there;
    if (const gpu::SpotCone* cone = lights.coneOf(i))
        shone *= coneAt(lights.falloff, *cone, -glm::dot(l, glm::dvec3(cone->direction)));
    if (shone > 0) addHarmonics(sum, intensity * shone, l, distance / soft);
}

ObjectLightLists objectLightLists(const GpuLights& lights, std::span<const ObjectPosition> objects,
                                  std::uint32_t pixels) {
    struct Own {
        gpu::ObjectLights head{};  // relative to the object's own entries
        std::vector<gpu::ObjectLight> entries;
    };
    std::vector<Own> all(objects.size());
    tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t o) {
        Own& own = all[o];
        const std::vector<LightFractions> fractions = lightFractions(lights, objects[o], pixels);
        const std::size_t kinds[] = {0, lights.directional, lights.firstSpot(), lights.firstArea(),
                                     lights.count()};
        const auto list = [&](double LightFractions::*fraction, std::size_t kind) {
            for (std::size_t i = kinds[kind]; i < kinds[kind + 1]; ++i)
                if (fractions[i].*fraction > 0)
                    own.entries.push_back(
                        {static_cast<gpu::uint>(i), static_cast<float>(fractions[i].*fraction)});
            return static_cast<gpu::uint>(own.entries.size());
        };
        own.head.local_begin = list(&LightFractions::pixel, 0);
        own.head.point_end = list(&LightFractions::pixel, 1);
        own.head.spot_end = list(&LightFractions::pixel, 2);
        own.head.area_end = list(&LightFractions::pixel, 3);
        own.head.vertex_directional_end = list(&LightFractions::vertex, 0);
        own.head.vertex_point_end = list(&LightFractions::vertex, 1);
        own.head.vertex_end = list(&LightFractions::vertex, 2);
        if (!objects[o].harmonics) return;
        for (std::size_t i = 0; i < fractions.size(); ++i)
            if (fractions[i].harmonics > 0)
                addHarmonics(own.head.irradiance, lights, i, objects[o], fractions[i].harmonics);
    });

    ObjectLightLists result;
    for (Own& own : all) {
        gpu::ObjectLights& head = own.head;
        const auto begin = static_cast<gpu::uint>(result.entries.size());
        result.longest = std::max(result.longest, head.area_end - head.local_begin);
        for (gpu::uint* end :
             {&head.begin, &head.local_begin, &head.point_end, &head.spot_end, &head.area_end,
              &head.vertex_directional_end, &head.vertex_point_end, &head.vertex_end})
            *end += begin;
        result.objects.push_back(head);
        result.entries.insert(result.entries.end(), own.entries.begin(), own.entries.end());
    }
    std::size_t ranked = 0, unimportant = 0;
    for (const Importance importance : lights.importance) {
        ranked += importance == Importance::automatic;
        unimportant += importance == Importance::not_important;
    }
    const std::size_t rest = unimportant + ranked - std::min<std::size_t>(ranked, pixels);
    result.features = gpu::OBJECT_LIGHTS_LISTS;
    if (rest > 0) result.features |= gpu::OBJECT_LIGHTS_VERTEX;
    if (rest > vertexLights || (rest > 0 && lights.area() > 0)) result.features |= gpu::OBJECT_LIGHTS_SH;
    return result;
}

}  // namespace diptych
