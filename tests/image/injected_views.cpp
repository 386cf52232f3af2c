// SPDX-License-Identifier: MIT
#include "compare/explain/lighting_components.h"
#include "compare/frames/frame_properties.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/lights/rig.h"
#include "tests/image/injected_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace diptych::tests {
namespace {

constexpr int imageWidth = 48, imageHeight = 27;

std::vector<Channel> injectedChannels() {
    std::vector<Channel> modes = explainedChannels();
    for (const Channel term : termChannels()) modes.push_back(term);
    for (const Channel more : {Channel::shadow_visibility, Channel::local_visibility, Channel::light_count})
        modes.push_back(more);
    return modes;
}

// A view's own random numbers.
class Draws {
public:
    explicit Draws(std::uint32_t seed) : random_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
    }
    bool chance(double p) { return between(0, 1) < p; }

private:
    std::mt19937 random_;
};

// A sky with a bright sun, above a ground.
Environment sky(Draws& draws) {
    Environment made{"sky", Image(32, 16, 3)};
    const double azimuth = draws.between(0, 32), height = draws.between(2, 6),
                 warmth = draws.between(0.5, 1.5);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x) {
            const double around = std::remainder(x - azimuth, 32.0), up = y - height;
            const double sun = 3 * std::exp(-(around * around + up * up) / 18);
            const double base = y < 8 ? 0.4 : 0.12;
            made.radiance.at(x, y, 0) = static_cast<float>(0.6 * base + warmth * sun);
            made.radiance.at(x, y, 1) = static_cast<float>(0.8 * base + sun);
            made.radiance.at(x, y, 2) = static_cast<float>(base + 0.7 * sun);
        }
    return made;
}

// A scene with randomized materials and lights.
Scene seeded(const std::string& name, std::uint32_t seed, ViewKind kind) {
    Scene scene = loadScene(name);
    Draws draws(seed);
    for (Material& material : scene.materials) {
        if (blends(material)) continue;
        material.roughness = static_cast<float>(draws.between(0.15, 0.95));
        material.metallic = draws.chance(0.4) ? static_cast<float>(draws.between(0.4, 1)) : 0.0f;
        for (int c = 0; c < 3; ++c) material.base_color[c] = static_cast<float>(draws.between(0.1, 0.9));
        if (draws.chance(0.5))
            material.emissive = {draws.between(0, 3), draws.between(0, 1), draws.between(0, 0.5)};
    }
    if (kind == ViewKind::blended) scene.environment = sky(draws);
    ViewRequest request;
    request.width = imageWidth, request.height = imageHeight;
    request.lights = "point:3,spot:3";
    request.seed = seed;
    scene.lights = makeSceneView(scene, request).lights;
    for (Light& light : scene.lights) light.node = -1, light.name.clear();
    const bool has_sun = std::ranges::any_of(
        scene.lights, [](const Light& light) { return light.kind == LightKind::directional; });
    if (!has_sun) {
        scene.lights.push_back(sunAlong(
            glm::normalize(glm::dvec3(draws.between(0.6, 1.2), -0.7, draws.between(-0.5, -0.1))), 1));
    }
    // Faults of a single light affect the first one.
    std::rotate(scene.lights.begin(),
                scene.lights.begin() + static_cast<std::ptrdiff_t>(seed % scene.lights.size()),
                scene.lights.end());
    scene.lights.front().name = firstLight;
    return scene;
}

Settings settingsOf(const std::string& name, const std::string& camera, ViewKind kind, std::uint32_t seed) {
    Draws draws(seed + 1000);
    Settings settings = with(smallImage(GBufferEncoding::full), "path forward_plus assign every");
    settings.size = {imageWidth, imageHeight};
    settings.camera = camera;
    const auto ambient = static_cast<float>(draws.between(0.05, 0.3));
    settings.ambient = {ambient, 0.9f * ambient, 1.1f * ambient};
    settings.haze = true;
    settings.haze_density = static_cast<float>(draws.between(300, 1500));
    if (name == "builtin:far_away") settings.haze_ground = 2e5f;  // the scene's height
    if (kind == ViewKind::blended) {
        settings.env = "scene";
        settings.ibl_samples = 16;
    } else {
        settings.shadows = Shadows::pcf;
        settings.shadow_size = 128;
        settings.shadow_lights = 1;
        settings.shadow_cascades = 3;
        settings.shadow_bias = 1;
    }
    return settings;
}

}  // namespace

bool differsVisibly(const Image& a, const Image& b) {
    double difference = 0, all = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) {
        difference += std::abs(double{a.data[i]} - b.data[i]);
        all += std::abs(double{a.data[i]});
    }
    return difference > 1e-5 * all;
}

InjectedView::InjectedView(const std::string& scene_name, const std::string& camera, std::uint32_t seed,
                           ViewKind view_kind)
    : name(fmt::format("{}, {}, seed {}", scene_name, camera, seed)),
      kind(view_kind),
      scene(seeded(scene_name, seed, view_kind)),
      views(scene),
      renderer(device(), views, pipelines()),
      settings(settingsOf(scene_name, camera, view_kind, seed)),
      right(drawnBy(Path::forward_plus, renderer, settings, injectedChannels())),
      images_(device(), settings.size) {
    right.settings = settings;
    // Varies occlusion: few scenes have any.
    Image& occluded = right.channels.at(Channel::occlusion);
    const double turn = 0.7 * seed;
    for (int y = 0; y < imageHeight; ++y)
        for (int x = 0; x < imageWidth; ++x)
            if (covered(occluded.offset(x, y)))
                occluded.at(x, y) *=
                    static_cast<float>(0.6 + 0.35 * std::sin(0.4 * x + turn) * std::cos(0.3 * y - turn));
    shadeInto(right, settings);
}

bool InjectedView::covered(std::size_t pixel) const {
    return right.channels.at(Channel::material_id).pixel(pixel)[0] >= 0;
}

// Computes lit and its terms from the Frame's channels.
void InjectedView::shadeInto(Frame& frame, const Settings& drawn) {
    for (std::size_t c = 0; c < surfaceChannels().size(); ++c) images_.set(0, c, frame);
    std::optional<ChannelShading> other;
    if (!shading_)
        shading_.emplace(renderer.shadeChannels(settings, images_));
    else if (!(drawn == settings))
        other.emplace(renderer.shadeChannels(drawn, images_));
    ChannelShading& shading = other ? *other : *shading_;
    frame.channels.at(Channel::lit) = shading.shade(0);
    ChannelTerms terms = shading.terms(0);
    frame.channels.at(Channel::lit_diffuse) = std::move(terms.diffuse);
    frame.channels.at(Channel::lit_specular) = std::move(terms.specular);
    frame.channels.at(Channel::lit_ambient) = std::move(terms.ambient);
    frame.channels.at(Channel::lit_haze) = std::move(terms.haze);
    frame.channels.at(Channel::transmittance) = std::move(terms.transmittance);
}

Image InjectedView::litUnder(const Settings& other, const std::string& channel,
                             const std::function<void(float*)>& pixel) {
    Frame frame = right;
    for (const Channel number : surfaceChannels())
        if (debugMode(number).name == channel)
            for (std::size_t p = 0; p < right.channels.at(Channel::lit).pixels(); ++p)
                if (covered(p)) pixel(frame.channels.at(number).pixel(p));
    shadeInto(frame, other);
    return frame.channels.at(Channel::lit);
}

Frame InjectedView::with(std::span<const InjectedFault* const> faults) {
    Frame frame = right;
    Settings drawn = settings;
    const std::vector<Light> lights = scene.lights;
    bool drawn_otherwise = false, surfaces_differ = false;
    for (const InjectedFault* const fault : faults) {
        if (fault->draw) {
            fault->draw(drawn, scene);
            drawn_otherwise = true;
        }
        for (const Channel number : surfaceChannels())
            if (debugMode(number).name == fault->channel) {
                surfaces_differ = true;
                for (std::size_t p = 0; p < frame.channels.at(Channel::lit).pixels(); ++p)
                    if (covered(p)) fault->pixel(frame.channels.at(number).pixel(p));
            }
    }
    // Settings without effect on visibility: environment light, haze and blending.
    Settings seen_by = drawn;
    for (const std::string_view option :
         {"ambient", "haze", "haze-density", "env-rotation", "ibl-intensity", "transparency", "multiscatter"})
        seen_by.set(option, settings.valueOf(option));
    const auto alike = [](const Light& a, const Light& b) {
        return a.intensity == b.intensity && a.color == b.color && a.range == b.range &&
               a.inner_cone == b.inner_cone && a.outer_cone == b.outer_cone && a.position == b.position;
    };
    const bool same_lights = std::ranges::equal(lights, scene.lights, alike);
    if (!same_lights || !(seen_by == settings)) {
        // Nothing in these views moves: another time yields another view, with the current lights.
        static int otherwise = 0;
        drawn.time = ++otherwise;
        const std::vector<Channel> seen{Channel::shadow_visibility, Channel::local_visibility,
                                        Channel::light_count};
        Frame other = drawnBy(Path::forward_plus, renderer, drawn, seen);
        for (const Channel number : seen) frame.channels.at(number) = std::move(other.channels.at(number));
    }
    if (drawn_otherwise || surfaces_differ) shadeInto(frame, drawn);
    scene.lights = lights;
    for (const InjectedFault* const fault : faults)
        if (fault->after) fault->after(*this, frame);
    return frame;
}

Frame InjectedView::with(const InjectedFault& fault) {
    const InjectedFault* const one = &fault;
    return with(std::span(&one, 1));
}

Explanation InjectedView::explained(const Frame& test) {
    return explain(device(), renderer, scene, right, test);
}

bool InjectedView::feels(const InjectedFault& fault) {
    const auto known = felt_.find(fault.means);
    if (known != felt_.end()) return known->second;
    return felt_[fault.means] =
               differsVisibly(right.channels.at(Channel::lit), with(fault).channels.at(Channel::lit));
}

InjectedView* injectedView(ViewKind kind, std::size_t index) {
    using Place = std::pair<const char*, const char*>;  // scene, camera
    static const std::vector<Place> opaque{
        {"builtin:points", "front"},
        {"builtin:suns", "front"},
        {"builtin:spots", "front"},
        {"builtin:far_away", "there"},
        {"builtin:points", "eye=2,1.6,4.6 target=-0.3,0.6,0 fov=44"},
        {"builtin:suns", "eye=-2.5,2.6,4.5 target=0,0.4,0 fov=40"},
        {"builtin:spots", "eye=1,2.8,5 target=0.2,0.2,0 fov=46"},
        {"builtin:far_away", "eye=1000001.2,200001.1,-999996.8 target=1000000,200000.3,-1000000 fov=44"}};
    static const std::vector<Place> blended{{"builtin:glass", "front"},
                                            {"builtin:crossed", "front"},
                                            {"builtin:glass", "inside"},
                                            {"builtin:crossed", "eye=1.2,0.9,3.2 target=0,0.6,0 fov=46"},
                                            {"builtin:glass", "eye=-1.4,1.3,4.5 target=0,0.9,0 fov=46"}};
    pipelines();  // before the views: must outlive them
    static std::map<ViewKind, std::vector<std::unique_ptr<InjectedView>>> made;
    std::vector<std::unique_ptr<InjectedView>>& views = made[kind];
    const std::vector<Place>& places = kind == ViewKind::opaque ? opaque : blended;
    while (views.size() <= index) {
        const std::size_t seed = 1 + views.size() / places.size();
        if (seed > (kind == ViewKind::opaque ? 4 : 5)) return nullptr;
        const auto& [scene, camera] = places[views.size() % places.size()];
        views.push_back(
            std::make_unique<InjectedView>(scene, camera, static_cast<std::uint32_t>(seed), kind));
    }
    return views[index].get();
}

}  // namespace diptych::tests
