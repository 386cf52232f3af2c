// SPDX-License-Identifier: MIT
#include "compare/audit/quantities.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace diptych::audit {

namespace {

float times(float value, double factor) {
    return static_cast<float>(double{value} * factor);
}

// Scales everything that emits light, and thus the image's radiance.
void applyIntensity(Case& changed, const Subject&, double factor) {
    for (Light& light : changed.scene.lights) light.intensity = times(light.intensity, factor);
    Settings& settings = changed.settings;
    settings.ibl_intensity = times(settings.ibl_intensity, factor);
    settings.light_cutoff = times(settings.light_cutoff, factor);
    for (float* component : {&settings.ambient.r, &settings.ambient.g, &settings.ambient.b})
        *component = times(*component, factor);
    for (Material& material : changed.scene.materials) {
        material.emissive = glm::vec3(glm::dvec3(material.emissive) * factor);
        material.lightmap_intensity = times(material.lightmap_intensity, factor);
    }
    for (auto& [index, parts] : changed.scene.material_parts) parts.emissive_strength *= factor;
    changed.scene.background = glm::vec3(glm::dvec3(changed.scene.background) * factor);
}

// Range of light intensities, each in its own unit.
Predicted predictIntensity(const Subject& subject, const Settings&, double) {
    double max = 0, min = std::numeric_limits<double>::infinity();
    for (const Light& light : subject.original.scene.lights) {
        if (!(light.intensity > 0)) continue;
        max = std::max(max, double{light.intensity});
        min = std::min(min, double{light.intensity});
    }
    // Products with squared distances and D keep some ten binary orders from either end.
    return {.up = max > 0 ? 0x1p118 / max : Predicted::never,
            .down = 0x1p-116 / min,
            .because = "light is float32 from its source to the picture: 1e-38 to 3e38"};
}

// Whether anything but local lights shines on surfaces.
bool hasOtherLight(const Subject& subject) {
    const Scene& scene = subject.original.scene;
    const Rgb& ambient = subject.original.settings.ambient;
    return scene.environment || std::max({ambient.r, ambient.g, ambient.b}) > 0 ||
           std::ranges::any_of(scene.lights,
                               [](const Light& light) { return !isLocal(light) && light.intensity > 0; });
}

// A light at height h above a surface, scaled to the same brightness at its foot, is only (h / r)^3 as
// bright at a larger distance r. Other light outshines it there, so its height only matters in an area
// about as wide as h. Before rounding of h matters, that area is smaller than the hundredth of the image
// that a 99th percentile ignores.
Predicted predictDistance(const Subject& subject, const Settings&, double error) {
    if (hasOtherLight(subject))
        return {.because =
                    "a light near a surface only lights an area as wide as its height, less than 1 % of the "
                    "picture; other light outshines it elsewhere"};
    return {.down = 0x1p-25 * subject.distance() / error,
            .because =
                "a light's position is float32 relative to the camera: its height above a surface has an "
                "error of 2^-25 of their distance from the camera"};
}

void applyRange(Case& changed, const Subject&, double metres) {
    for (Light& light : changed.scene.lights)
        if (isLocal(light)) light.range = static_cast<float>(metres);
}

double originalRange(const Subject& subject) {
    double longest = 0;
    for (const Light& light : subject.original.scene.lights)
        if (isLocal(light) && std::isfinite(light.range)) longest = std::max(longest, double{light.range});
    return longest > 0 ? longest : 2 * subject.bounds.radius();
}

// Moves each local light straight to a distance from a point. `as_bright`: scaled to keep its brightness
// there, and without a range.
void moveLocalLights(Case& changed, const glm::dvec3& from, double metres, bool as_bright) {
    for (Light& light : changed.scene.lights) {
        if (!isLocal(light)) continue;
        const glm::dvec3 before = light.position - from;
        const double distance = glm::length(before), nearer = metres / distance;
        if (!(distance > 0)) continue;
        light.position = from + before * nearer;
        if (!as_bright) continue;
        light.range = std::numeric_limits<float>::infinity();
        if (!isArea(light.kind) && metres > 0) light.intensity = times(light.intensity, nearer * nearer);
    }
}

// Point and spot lights become spot lights without a penumbra, aimed at the image's centre.
void applyCone(Case& changed, const Subject& subject, double degrees) {
    for (Light& light : changed.scene.lights) {
        if (!isPunctual(light)) continue;
        light.kind = LightKind::spot;
        light.inner_cone = light.outer_cone = static_cast<float>(glm::radians(degrees / 2));
        const glm::dvec3 along = subject.point - light.position;
        if (glm::length(along) > 0) light.direction = glm::normalize(along);
    }
}

std::string lacksPunctualLight(const Subject& subject) {
    const bool any = std::ranges::any_of(subject.original.scene.lights, isPunctual);
    return any ? "" : "the scene has no point or spot light";
}

std::string lacksEnvironment(const Subject& subject) {
    return subject.original.scene.environment ? "" : "the scene has no environment: add one with --env";
}

// The brightest pixel, and the sum of its components.
std::pair<std::size_t, float> brightestOf(const Image& radiance) {
    std::pair<std::size_t, float> brightest{0, -1};
    for (std::size_t i = 0; i < radiance.pixels(); ++i) {
        const float* const pixel = radiance.pixel(i);
        if (const float sum = pixel[0] + pixel[1] + pixel[2]; sum > brightest.second) brightest = {i, sum};
    }
    return brightest;
}

// Radiance, its maps and their sums are float32; a path's estimate multiplies it by some thousand at most.
// Maps of fixed resolution spread a pixel that outshines all others, and samples miss it.
Predicted predictEnvironment(const Subject& subject, const Settings&, double) {
    const float max = brightestOf(subject.original.scene.environment->radiance).second;
    return {.up = max > 0 ? 0x1p118 / max : Predicted::never,
            .because =
                "radiance is float32 from the environment to the picture, up to 3e38; maps and samples only "
                "approximate a single bright pixel, and their error depends on all other pixels",
            .at_most = true};
}

// Scales only the brightest pixel.
void applyEnvironment(Case& changed, const Subject&, double factor) {
    Image& radiance = changed.scene.environment->radiance;
    const std::size_t brightest = brightestOf(radiance).first;
    for (int c = 0; c < 3; ++c) {
        float& component = radiance.pixel(brightest)[c];
        component = static_cast<float>(
            std::min(double{component} * factor, double{std::numeric_limits<float>::max()}));
    }
}

}  // namespace

std::vector<Quantity> lightQuantities() {
    const std::vector<double> places = ladder(1e-9, 1e7, 10, {0});
    return {
        {.name = "intensity",
         .what = "all light sources, multiplied by a factor",
         .magnitudes = ladder(1e-12, 1e12),
         .apply = applyIntensity,
         .variants = {{"lit-format", "fp16"}, {"lit-format", "b10g11r11"}},
         .same_image = true,
         .light = true,
         .predict = predictIntensity},
        {.name = "range",
         .unit = "m",
         .what = "the range of every point, spot and area light",
         .magnitudes = ladder(1e-3, 1e9),
         .original = originalRange,
         .lacks = {lacksLocalLight},
         .apply = applyRange,
         .because = "the range window uses the squared ratio of distance to range, which one step computes"},
        {.name = "distance",
         .unit = "m",
         .what =
             "distance of local lights from the surface in the middle of the picture, which stays as bright",
         .magnitudes = places,
         .original = [](const Subject& subject) { return localDistance(subject, subject.point); },
         .lacks = {lacksLocalLight, lacksPerspective, lacksSurface},
         .apply = [](Case& changed, const Subject& subject,
                     double metres) { moveLocalLights(changed, subject.point, metres, true); },
         .predict = predictDistance},
        // Intensities stay: a light beside the eye lights the visible surfaces, not the eye.
        {.name = "eye",
         .unit = "m",
         .what = "distance of local lights from the camera",
         .magnitudes = places,
         .original = [](const Subject& subject) { return localDistance(subject, subject.view.eye()); },
         .lacks = {lacksLocalLight},
         .apply = [](Case& changed, const Subject& subject,
                     double metres) { moveLocalLights(changed, subject.view.eye(), metres, false); },
         .because = "a light near the camera is near the origin of all coordinates, where float32 is finest"},
        {.name = "cone",
         .unit = "degrees",
         .what = "the full cone angle of every point and spot light, inner equal to outer",
         .magnitudes = ladder(0.01, 10, 10, {30, 90, 150, 179, 180}),
         .original = [](const Subject&) { return 90.0; },
         .lacks = {lacksPunctualLight, lacksPerspective, lacksSurface},
         .apply = applyCone,
         .because = "a cone's soft edge is at least 0.001 wide in cosine, and float32 resolves 6e-8"},
        {.name = "environment",
         .what = "the brightest pixel of the environment, multiplied by a factor",
         .magnitudes = ladder(1, 1e12),
         .lacks = {lacksEnvironment},
         .apply = applyEnvironment,
         .variants = {{"ibl", "sampled"}},
         .predict = predictEnvironment},
    };
}

}  // namespace diptych::audit
