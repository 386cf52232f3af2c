// SPDX-License-Identifier: MIT
#include "compare/choose/variations.h"

#include "compare/experiment/evaluator.h"
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "compare/render/sample_counts.h"
#include "forward_plus/prepass.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace diptych::choose {

namespace {

// The references' cameras only. Automatic cameras become explicit, so that variations use the same view.
experiment::ReferenceFrames viewpointsOf(const Scene& scene, const experiment::ReferenceFrames& references) {
    experiment::ReferenceFrames viewpoints;
    for (const Frame& reference : references.frames) {
        Frame& frame = viewpoints.frames.emplace_back();
        frame.settings = reference.settings;
        const FrameCamera& camera = reference.camera;
        if (!frame.settings.camera.empty() || !scene.cameras.empty() || camera.fov_degrees <= 0) continue;
        const auto point = [](const double(&p)[3]) {
            return fmt::format("{:.9g},{:.9g},{:.9g}", p[0], p[1], p[2]);
        };
        frame.settings.camera = fmt::format("eye={} target={} fov={:.9g} near={:.9g}", point(camera.eye),
                                            point(camera.target), camera.fov_degrees, camera.near);
        if (std::isfinite(camera.far)) frame.settings.camera += fmt::format(" far={:.9g}", camera.far);
    }
    return viewpoints;
}

// A modified copy of a scene, uploaded.
struct MadeScene {
    MadeScene(Scene made, const VariedScene& of, experiment::ReferenceFrames from,
              const std::array<Settings, 2>& settings)
        : scene(std::move(made)),
          views(scene),
          renderer(of.device, views, of.pipelines),
          viewpoints(std::move(from)),
          varied{of.device, of.pipelines, views, renderer, viewpoints, settings},
          draw(drawAsIs(varied)) {}
    Scene scene;
    SceneViews views;
    Renderer renderer;
    experiment::ReferenceFrames viewpoints;
    VariedScene varied;
    DrawInOrder draw;
};

// Sums over all cameras.
struct Metrics {
    double fragments = 0, covered = 0, triangles = 0;  // opaque
    double lights = 0, surface = 0;                    // evaluated lights, pixels with an opaque surface
};

Overdraw overdrawFrom(const VariedScene& of, const Settings& settings) {
    SharedResources shared(of.device, of.views.scene(), of.pipelines);
    const PreparedView view(of.device, shared, of.views.at(viewRequest(settings)), settings);
    return measureOverdraw(view.inputs, static_cast<std::uint32_t>(settings.size.width),
                           static_cast<std::uint32_t>(settings.size.height));
}

Metrics metricsOf(const VariedScene& of) {
    Metrics metrics;
    for (const Frame& from : of.references.frames) {
        Settings seen = shadesFragments(of.settings[0].path) ? of.settings[0] : of.settings[1];
        seen.camera = from.settings.camera;
        const Overdraw overdraw = overdrawFrom(of, seen);
        metrics.fragments += static_cast<double>(overdraw.fragments);
        metrics.covered += static_cast<double>(overdraw.covered);
        metrics.triangles += static_cast<double>(overdraw.triangles);
        RenderOptions drawing;
        drawing.channels = {Channel::material_id, Channel::light_count};
        drawing.requested = drawing.channels;
        drawing.runs = 0;
        const Frame frame = of.renderer.draw(seen, drawing);
        const Image &ids = frame.channels.at(Channel::material_id),
                    &lights = frame.channels.at(Channel::light_count);
        for (std::size_t i = 0; i < ids.pixels(); ++i) {
            if (ids.pixel(i)[0] < 0) continue;
            metrics.surface += 1;
            metrics.lights += lights.pixel(i)[0];
        }
    }
    return metrics;
}

double ratioOf(double a, double b) {
    return b > 0 ? a / b : 0;
}

std::size_t materialsIn(const Scene& scene) {
    std::set<int> used;
    for (const Node& node : scene.nodes)
        if (node.mesh >= 0)
            for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives)
                used.insert(primitive.material);
    return used.size();
}

// Fractions of the images: blended pixels, and pixels with any surface.
std::pair<double, double> blendedFraction(const experiment::ReferenceFrames& references, double surface) {
    double blended = 0, all = 0;
    for (const Frame& frame : references.frames) {
        all += static_cast<double>(frame.settings.size.width) * frame.settings.size.height;
        for (std::size_t i = 0; i < frame.blended.pixels(); ++i) blended += frame.blended.pixel(i)[0] > 0;
    }
    return {ratioOf(blended, all), std::min(1.0, ratioOf(std::max(blended, surface), all))};
}

class Properties {
public:
    explicit Properties(const VariedScene& of)
        : of_(of),
          scene_(of.views.scene()),
          viewpoints_(viewpointsOf(scene_, of.references)),
          here_(metricsOf({of.device, of.pipelines, of.views, of.renderer, viewpoints_, of.settings})) {}

    std::vector<Property> all() const {
        return {overdraw(), lights(), blended(), samples(), materials(), triangles(), size()};
    }

private:
    // The same scene with other Settings on both paths.
    std::function<Variation()> withSettings(double value, const std::array<Settings, 2>& settings) const {
        VariedScene of = of_;
        of.settings = settings;
        return [of, value] { return Variation{value, drawAsIs(of)}; };
    }
    // A modified scene; `valueOf` measures the property.
    template <class Make, class ValueOf>
    std::function<Variation()> withScene(Make make, ValueOf valueOf, bool bakedLights = false) const {
        std::array<Settings, 2> settings = of_.settings;
        if (bakedLights)
            for (Settings& each : settings) each.lights.clear();
        return [of = of_, viewpoints = viewpoints_, settings, make, valueOf] {
            const auto made = std::make_shared<MadeScene>(make(of.views.scene()), of, viewpoints, settings);
            return Variation{valueOf(made->varied),
                             [made](std::span<const std::size_t> order) { return made->draw(order); }};
        };
    }
    // Adds a modified scene whose metrics measure the property.
    template <class Make>
    void addMeasured(Property& property, double (*of_metrics)(const Metrics&), Make make,
                     bool bakedLights = false) const {
        property.others.push_back(withScene(
            make, [of_metrics](const VariedScene& made) { return of_metrics(metricsOf(made)); },
            bakedLights));
    }

    static double overdrawOf(const Metrics& metrics) { return ratioOf(metrics.fragments, metrics.covered); }
    static double lightsOf(const Metrics& metrics) { return ratioOf(metrics.lights, metrics.surface); }
    static double trianglesOf(const Metrics& metrics) { return metrics.triangles; }

    Property overdraw() const {
        Property property{.name = "overdraw",
                          .unit = "fragments per covered pixel",
                          .how =
                              "one and three copies of every surface are drawn first, just below it, which "
                              "also adds triangles",
                          .value = overdrawOf(here_),
                          .min = 1,
                          .max = 32};
        if (property.value <= 0)
            property.not_varied = "this device does not count fragments, or no surface is opaque";
        for (const int copies : {1, 3})
            if (property.not_varied.empty())
                addMeasured(property, overdrawOf,
                            [copies](const Scene& scene) { return withOverdraw(scene, copies); });
        return property;
    }

    Property lights() const {
        Property property{.name = "light density",
                          .unit = "lights per pixel",
                          .how = "every other light, and two and four copies of each",
                          .value = lightsOf(here_),
                          .min = 0,
                          .max = 1024};
        Settings seen = of_.settings[0];
        seen.camera = viewpoints_.frames.front().settings.camera;
        const SceneView& view = of_.views.at(viewRequest(seen));
        std::vector<Light> lights = view.lights;
        if (view.sun && !lights.empty()) lights.pop_back();  // the environment's light
        if (lights.empty()) property.not_varied = "the scene has no light to remove or copy";
        for (const double factor : {0.5, 2.0, 4.0}) {
            if (lights.empty() || (factor < 1 && lights.size() < 2)) continue;
            addMeasured(
                property, lightsOf,
                [lights, factor](const Scene& scene) { return withLights(scene, lights, factor); }, true);
        }
        return property;
    }

    Property blended() const {
        const auto [fraction, surface] = blendedFraction(of_.references, here_.surface);
        Property property{.name = "transparency",
                          .unit = "% of the pixels",
                          .how = "all materials opaque, and all blended",
                          .value = 100 * fraction,
                          .min = 0,
                          .max = 100};
        const auto vary = [&](bool all, double value) {
            property.others.push_back(withScene([all](const Scene& scene) { return withBlends(scene, all); },
                                                [value](const VariedScene&) { return value; }));
        };
        if (fraction > 0) vary(false, 0);
        if (surface > fraction) vary(true, 100 * surface);
        return property;
    }

    Property samples() const {
        const int now = of_.settings[0].msaa, other = now > 1 ? 1 : 4;
        Property property{.name = "MSAA",
                          .unit = now == 1 ? "sample per pixel" : "samples per pixel",
                          .how = "both paths' Settings with this number of samples",
                          .value = static_cast<double>(now),
                          .min = 1,
                          .max = 8,
                          .few_values = true};
        const std::array<Settings, 2> settings{withSamples(of_.settings[0], other),
                                               withSamples(of_.settings[1], other)};
        for (const Settings& each : settings)
            if (const auto problem = each.problem()) property.not_varied = *problem;
        const std::vector<int> can = sampleCounts(of_.device);
        if (std::ranges::count(can, other) == 0)
            property.not_varied = fmt::format("this device does not support {} samples", other);
        if (property.not_varied.empty()) property.others.push_back(withSettings(other, settings));
        return property;
    }

    Property materials() const {
        const auto count = static_cast<double>(materialsIn(scene_));
        Property property{.name = "materials",
                          .unit = count == 1 ? "material" : "materials",
                          .how = "one for all opaque surfaces, and one for each primitive",
                          .value = count,
                          .min = 1,
                          .max = 1024};
        const auto valueOf = [](const VariedScene& made) {
            return static_cast<double>(materialsIn(made.views.scene()));
        };
        if (count > 1) property.others.push_back(withScene(withOneMaterial, valueOf));
        if (materialsIn(withOwnMaterials(scene_)) > materialsIn(scene_))
            property.others.push_back(withScene(withOwnMaterials, valueOf));
        return property;
    }

    Property triangles() const {
        Property property{.name = "triangles",
                          .unit = "triangles drawn",
                          .how = "eight more per triangle, which cover no pixel",
                          .value = trianglesOf(here_),
                          .min = 1,
                          .max = 1e8};
        addMeasured(property, trianglesOf, [](const Scene& scene) { return withEmptyTriangles(scene, 8); });
        return property;
    }

    Property size() const {
        const Size& now = of_.references.frames.front().settings.size;
        const double pixels = static_cast<double>(now.width) * now.height;
        Property property{.name = "size",
                          .unit = "pixels",
                          .how = "half and double the width and height",
                          .value = pixels,
                          .min = 16 * 9,
                          .max = 7680.0 * 4320};
        for (const double factor : {0.5, 2.0}) {
            std::array<Settings, 2> settings = of_.settings;
            for (Settings& each : settings) {
                const auto scaled = [&](int length) {
                    return std::max(1, static_cast<int>(std::lround(length * factor)));
                };
                each.size = {scaled(each.size.width), scaled(each.size.height)};
            }
            property.others.push_back(withSettings(pixels * factor * factor, settings));
        }
        return property;
    }

    const VariedScene& of_;
    const Scene& scene_;
    const experiment::ReferenceFrames viewpoints_;
    const Metrics here_;
};

}  // namespace

DrawInOrder drawAsIs(const VariedScene& of) {
    const auto evaluator = std::make_shared<experiment::SceneEvaluator>(
        of.renderer, of.references, experiment::Measure::flip, RenderOptions());
    return [evaluator, settings = of.settings](std::span<const std::size_t> order) {
        return evaluator->time(settings, order);
    };
}

std::vector<Property> propertiesOf(const VariedScene& of) {
    return Properties(of).all();
}

}  // namespace diptych::choose
