// SPDX-License-Identifier: MIT
#include "shared/scene/lights/shadow_casters.h"

#include "shared/contract/local_shadow.h"
#include "shared/scene/model/luminance.h"

#include <algorithm>
#include <functional>

namespace diptych {

double strengthOf(const Light& light) {
    return luminance(glm::dvec3(light.color)) * double{light.intensity};
}

std::optional<std::size_t> brightestSun(std::span<const Light> lights) {
    std::optional<std::size_t> brightest;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (lights[i].kind == LightKind::directional &&
            strengthOf(lights[i]) > (brightest ? strengthOf(lights[*brightest]) : 0))
            brightest = i;
    return brightest;
}

int shadowTiles(const Light& light) {
    constexpr float right = gpu::PI / 2;
    if (light.kind == LightKind::point) return int{gpu::LOCAL_FACES};
    // A half angle of 45 degrees fits one cube face. A wider cone reaches the side faces, but never the
    // face behind.
    return light.outer_cone <= right / 2 ? 1 : int{gpu::LOCAL_FACES} - 1;
}

LocalCasting localCasting(std::span<const Light> lights, int brightest) {
    const auto intensity = [&](std::size_t i) { return strengthOf(lights[i]); };
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if ((lights[i].kind == LightKind::point || lights[i].kind == LightKind::spot) && intensity(i) > 0 &&
            lights[i].range > 0)
            all.push_back(i);
    std::ranges::stable_sort(all, std::greater(), intensity);
    LocalCasting result;
    int tiles = 0;
    for (const std::size_t i : all) {
        if (!lights[i].shadow && brightest-- <= 0) continue;
        if (tiles + shadowTiles(lights[i]) > int{gpu::MAX_LOCAL_TILES}) {
            ++result.over_capacity;
            continue;
        }
        tiles += shadowTiles(lights[i]);
        result.lights.push_back(i);
    }
    std::ranges::sort(result.lights);
    result.unshadowed = all.size() - result.lights.size();
    return result;
}

std::vector<std::size_t> castingLights(std::span<const Light> lights, int brightest_locals) {
    std::vector<std::size_t> casting = localCasting(lights, brightest_locals).lights;
    if (const std::optional<std::size_t> sun = brightestSun(lights))
        casting.insert(std::ranges::upper_bound(casting, *sun), *sun);
    return casting;
}

}  // namespace diptych
