// SPDX-License-Identifier: MIT
#include "compare/audit/relations.h"

#include <algorithm>
#include <array>

namespace diptych::audit {

namespace {

std::string lacksTwoLights(const Subject& subject) {
    if (subject.original.scene.lights.size() < 2) return "the scene has one light";
    if (subject.original.settings.shadow_lights > 0)
        return "--shadow-lights selects among equal lights by their order";
    if (subject.original.settings.haze &&
        std::ranges::count(subject.original.scene.lights, LightKind::directional, &Light::kind) > 1)
        return "--haze scatters the light of one sun";
    return {};
}

std::string lacksSplittable(const Subject& subject) {
    const Settings& settings = subject.original.settings;
    if (subject.original.scene.lights.empty()) return "the scene has no light";
    if (settings.light_cutoff > 0) return "--light-cutoff gives a dimmer light a shorter range";
    if (settings.shadows != Shadows::off) return "a sun or --shadow-lights cast shadows: leave out --shadows";
    return {};
}

// Splits every light, so that all views are affected; haze, though, scatters the light of only one sun.
void splitLights(Related& related, const Subject&) {
    std::vector<Light> halves;
    for (Light light : related.changed.scene.lights) {
        const bool whole = !isLocal(light) && related.changed.settings.haze;
        if (!whole) light.intensity /= 2;
        halves.insert(halves.end(), whole ? 1 : 2, light);
    }
    related.changed.scene.lights = std::move(halves);
}

void multiplyLight(Related& related, const Subject& subject, double factor) {
    // Unlit materials emit their base colour, whatever is multiplied.
    for (std::size_t i = 0; i < related.base.scene.materials.size(); ++i) {
        if (!related.base.scene.materials[i].unlit) continue;
        related.own_base = true;
        related.base.scene.materials[i].unlit = related.changed.scene.materials[i].unlit = false;
    }
    const std::array intensity{std::string("intensity")};
    quantitiesOf(intensity).front()->apply(related.changed, subject, factor);
    related.map.light = factor;
}

// Lights where the camera looks, so that they are in many lists; before and after the others.
void addDarkLights(Related& related, const Subject& subject) {
    Light dark;
    dark.name = "dark";
    dark.intensity = 0;
    dark.position = (subject.has_surface ? subject.point : subject.bounds.centre()) +
                    subject.normal * (0.05 * subject.nearest);
    std::vector<Light>& lights = related.changed.scene.lights;
    lights.insert(lights.begin(), dark);
    dark.kind = LightKind::spot;
    dark.direction = -subject.normal;
    lights.push_back(dark);
}

// Bright lights whose range ends before they reach anything.
void addFarLights(Related& related, const Subject& subject) {
    const double away = 4 * subject.bounds.radius() + 16;
    Light far;
    far.name = "far";
    far.intensity = 1e6f;
    far.range = 1;
    std::vector<Light>& lights = related.changed.scene.lights;
    for (const glm::dvec3& along : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, -1}}) {
        far.position = subject.bounds.centre() + along * away;
        lights.insert(lights.begin(), far);
    }
}

}  // namespace

std::vector<Relation> lightRelations() {
    return {
        {.name = "lights_permuted",
         .changes = "the order of the lights is reversed",
         .equality = Equality::sums,
         .because = "the same terms are added in another order",
         .lacks = {lacksTwoLights, lacksPerObject},
         .change = [](Related& related,
                      const Subject&) { std::ranges::reverse(related.changed.scene.lights); }},
        {.name = "lights_split",
         .changes = "each light becomes two of half the intensity",
         .equality = Equality::sums,
         .because = "half of a float32 is exact; the sum has twice as many terms",
         .lacks = {lacksSplittable, lacksPerObject},
         .change = splitLights},
        {.name = "light_doubled",
         .changes = "every light source is twice as bright",
         .because = "shaded light is proportional to its source, and twice a float32 is exact",
         .change = [](Related& related, const Subject& subject) { multiplyLight(related, subject, 2); },
         .same_pipelines = true},
        {.name = "light_64th",
         .changes = "every light source has 1/64 of its brightness",
         .because = "shaded light is proportional to its source, and 1/64 of a float32 is exact",
         .change = [](Related& related, const Subject& subject) { multiplyLight(related, subject, 0x1p-6); },
         .same_pipelines = true},
        {.name = "dark_lights",
         .changes = "two lights of intensity 0 are added in the middle of the picture",
         .because = "a light of intensity 0 adds 0",
         .lacks = {lacksPerObject},
         .change = addDarkLights},
        {.name = "far_lights",
         .changes = "three bright lights are added out of range of every surface",
         .because = "a light is exactly 0 beyond its range, so it adds 0",
         .lacks = {lacksPerObject},
         .change = addFarLights},
    };
}

}  // namespace diptych::audit
