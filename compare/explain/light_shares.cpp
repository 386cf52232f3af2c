// SPDX-License-Identifier: MIT
#include "compare/explain/light_shares.h"

#include "compare/explain/by_light.h"
#include "compare/explain/frame_images.h"
#include "compare/explain/lighting_components.h"
#include "shared/scene/lights/casters.h"
#include "shared/scene/model/luminance.h"

#include <algorithm>

namespace diptych {

namespace {

// Limits of lights rendered alone: their number, and the bytes of two images of each.
constexpr std::size_t mostLightsDrawn = 32, mostLightBytes = std::size_t{1} << 30;

// Settings of shadows and of the light from single lights.
bool isOfLights(std::string_view option) {
    return option.starts_with("shadow") || option.starts_with("evsm") || option.starts_with("clipmap") ||
           option == "light-cutoff" || option == "area-lights";
}

const char* kindName(LightKind kind) {
    switch (kind) {
        case LightKind::directional:
            return "directional";
        case LightKind::point:
            return "point";
        case LightKind::spot:
            return "spot";
        case LightKind::rect:
            return "rectangle";
        case LightKind::disc:
            return "disc";
        case LightKind::tube:
            return "tube";
    }
    return "light";
}

// Each light's fraction of the sum of all lights' differences, at each pixel.
std::vector<std::vector<float>> partsOfDifference(const std::vector<Image>& a, const std::vector<Image>& b) {
    std::vector<std::vector<float>> parts(a.size(), std::vector<float>(a.front().pixels()));
    std::vector<double> sums(parts.front().size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::vector<double> apart = errorsOf(a[i], b[i]);
        for (std::size_t p = 0; p < apart.size(); ++p) {
            parts[i][p] = static_cast<float>(apart[p]);
            sums[p] += apart[p];
        }
    }
    for (std::vector<float>& part : parts)
        for (std::size_t p = 0; p < part.size(); ++p)
            if (sums[p] > 0) part[p] = static_cast<float>(double{part[p]} / sums[p]);
    return parts;
}

}  // namespace

std::vector<LightShare> LightShares::of(const AblationCause& cause, const std::vector<double>& map) {
    const LightingComponents::Component* const component = ablation_.componentOf(cause);
    if (component ? !component->lights
                  : cause.kind != AblationCause::Kind::setting || !isOfLights(cause.name))
        return {};
    const Settings& test = sides_.settings(1);
    const std::vector<Light> lights = lighting_.under(test).lights();
    const std::vector<std::size_t> places = drawnLights(lights, cause.name, map.size());
    if (places.empty()) return {};
    std::vector<std::vector<float>> parts;
    if (component) {
        Settings lit_by = test;
        if (*component->lights == LightChange::seen) lit_by.shadows = Shadows::off;
        const std::vector<Image> alone = lightsAlone(lit_by, places, component);
        const Image change =
            LightingComponents::directLight(*component, LightingComponents::change(*component));
        parts = lightsOfChange(change, alone, *component->lights);
    } else {
        Settings without = test;
        without.set(cause.name, sides_.settings(0).valueOf(cause.name));
        const std::vector<Image> ablated = lightsAlone(without, places, nullptr);
        // Last, so that the next cause can use its frame.
        parts = partsOfDifference(lightsAlone(test, places, nullptr), ablated);
    }
    std::vector<LightShare> shares;
    for (std::size_t i = 0; i < places.size(); ++i) {
        double sum = 0;
        for (std::size_t p = 0; p < map.size(); ++p) sum += map[p] * double{parts[i][p]};
        if (sum == 0) continue;
        const Light& of = lights[places[i]];
        shares.push_back({places[i], of.name.empty() ? kindName(of.kind) : of.name,
                          sum / static_cast<double>(map.size())});
    }
    return shares;
}

// The indices of the lights to render alone, the brightest first. `of`: name of the cause. For shadow
// channels only suns, or only other lights; of these the shadow-casting ones, if there are any.
std::vector<std::size_t> LightShares::drawnLights(const std::vector<Light>& lights, std::string_view of,
                                                  std::size_t pixels) {
    const bool suns = of == "shadow_visibility", locals = of == "local_visibility";
    const std::vector<std::size_t> casting =
        castingLights(lights, std::max(sides_.settings(0).shadow_lights, sides_.settings(1).shadow_lights));
    const auto fits = [&](std::size_t place) {
        const bool is_sun = lights[place].kind == LightKind::directional;
        return suns ? is_sun : !locals || !is_sun;
    };
    const bool any_casts = std::ranges::any_of(casting, fits);
    std::vector<std::size_t> places;
    for (std::size_t place = 0; place < lights.size(); ++place)
        if (fits(place) && (!(suns || locals) || !any_casts || std::ranges::count(casting, place) > 0))
            places.push_back(place);
    const auto sends = [&](std::size_t place) {
        const Light& light = lights[place];
        return double{light.intensity} * luminance(glm::dvec3(light.color));
    };
    std::ranges::stable_sort(places, [&](std::size_t a, std::size_t b) { return sends(a) > sends(b); });
    const std::size_t room = mostLightBytes / (2 * 3 * sizeof(float) * pixels);
    const std::size_t most = std::clamp<std::size_t>(room, 1, mostLightsDrawn);
    const std::size_t left_out = places.size() - std::min(places.size(), most);
    places.resize(places.size() - left_out);
    drawn_ = std::max(drawn_, places.size());
    left_out_ = std::max(left_out_, left_out);
    return places;
}

// Each light's own contribution on the test's surfaces under some Settings.
std::vector<Image> LightShares::lightsAlone(const Settings& settings, const std::vector<std::size_t>& places,
                                            const LightingComponents::Component* component) {
    ChannelShading& shading = lighting_.under(settings);
    std::vector<Image> alone;
    for (const std::size_t place : places) {
        const LightChannels adds = shading.light(allChannelsOf(1), place);
        alone.push_back(component ? LightingComponents::directLight(*component, adds) : sumOfLobes(adds));
    }
    return alone;
}

}  // namespace diptych
