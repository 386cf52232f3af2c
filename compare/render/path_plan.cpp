// SPDX-License-Identifier: MIT
#include "compare/render/path_plan.h"

#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "compare/render/sample_counts.h"
#include "shared/material/gbuffer_layout.h"
#include "shared/scene/lights/shadow_casters.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace diptych {

namespace {

// Width and height of a planned image. Large enough that row padding is negligible per pixel, and small,
// because its images get memory.
constexpr std::uint32_t plannedSize = 256;

SampledBytes bytesOf(Device& device, SharedResources& shared, SceneViews& views, const Settings& settings) {
    const PreparedView view(device, shared, views.at(viewRequest(settings)), settings);
    PassList passes(device, plannedSize, plannedSize);
    const PixelBytes bytes = pixelBytes(passes, functionsOf(settings.path).add(passes, view.inputs));
    return {settings.msaa, bytes.geometry, bytes.all};
}

constexpr std::pair<const char*, gpu::uint> layerNames[]{
    {"clear coats", gpu::LAYER_CLEARCOAT},
    {"anisotropy", gpu::LAYER_ANISOTROPY},
    {"sheen", gpu::LAYER_SHEEN},
    {"iridescence", gpu::LAYER_IRIDESCENCE},
    {"diffuse transmission", gpu::LAYER_DIFFUSE_TRANSMISSION},
};

// Cost of a layer in images of both paths.
std::string layerCost(gpu::uint layer, const Requirements& needs, const Settings& settings) {
    if ((needs.surface_layers & layer) == 0) return "only blended surfaces and glass have it: no G-buffer";
    if (settings.layers == Layers::forward) return "--layers forward: no G-buffer";
    return fmt::format("{} bytes per pixel in deferred's G-buffer, none in forward_plus",
                       layerBytes(layer, settings.gbuffer) * static_cast<gpu::uint>(settings.msaa));
}

// Omissions of a layer's model, with their size where light is lost or gained.
std::string limitOf(std::string_view what, const SceneView& view, const Settings& settings) {
    if (what == "anisotropy") {
        const bool split = !view.needs.environment.empty() && settings.ibl == Ibl::split;
        return std::string("; its direction is made perpendicular to the mapped normal") +
               (split ? "; an environment's highlights are off by 20 to 50 % in the mean (--ibl sampled: "
                        "exact)"
                      : "");
    }
    if (what == "sheen")
        return "; what lies below is dimmed by the view's share alone: up to 14 % brighter in even light "
               "than by the lesser of view and light";
    if (what == "iridescence")
        return "; evaluated at v.h as given, without the extension's guards against indices close to the "
               "base's";
    if (what == "transmission") return "; lights behind rough surfaces have no highlights in it";
    return {};
}

std::string transmissionCost(const Requirements& needs, const Settings& settings) {
    if (settings.transparency == Transparency::off) return "--transparency off: not drawn";
    constexpr double texel = 16;
    const bool blurs = needs.rough_glass || settings.spec_aa;
    return fmt::format("both paths copy depth and the picture, {:.2f} MiB {} mip chain",
                       texel * settings.size.width * settings.size.height * (blurs ? 4.0 / 3 : 1.0) / 0x1p20,
                       blurs ? "with its" : "without");
}

Requirements::Line shadowLine(const SceneView& view, const Settings& settings) {
    constexpr const char* what = "shadows";
    if (settings.shadows == Shadows::off) return {false, what, "--shadows off: no map, no pass"};
    const bool sun = brightestSun(view.lights).has_value();
    const std::size_t local = localCasting(view.lights, settings.shadow_lights).lights.size();
    if (!sun && local == 0)
        return {false, what,
                "no light casts a shadow: no sun, and --shadow-lights enables no point or spot light"};
    std::string casting = sun ? "the brightest sun" : "";
    if (local > 0) casting += fmt::format("{}{}", sun ? " and " : "", counted(local, "point or spot light"));
    return {true, what,
            fmt::format("{} cast{} shadows: --shadows {}", casting, (sun ? 1 : 0) + local == 1 ? "s" : "",
                        nameOf(settings.shadows))};
}

}  // namespace

std::vector<Requirements::Line> planLines(const SceneView& view, const Settings& settings) {
    std::vector<Requirements::Line> lines = view.needs.lines();
    for (Requirements::Line& line : lines) {
        if (line.modelled) line.why += limitOf(line.what, view, settings);
        if (view.default_sun && line.what == "directional lights")
            line.why = "the default sun, added because the scene has no light";
        if (line.modelled && line.what == "skins and morph targets")
            line.why += settings.skinning == Skinning::compute
                            ? ", deformed once per frame by compute shaders"
                            : ", deformed by the vertex shader of every draw";
        if (line.modelled && line.what == "transmission")
            line.why += "; " + transmissionCost(view.needs, settings);
        for (const auto& [name, layer] : layerNames)
            if (line.modelled && line.what == name) line.why += "; " + layerCost(layer, view.needs, settings);
    }
    lines.push_back(shadowLine(view, settings));
    lines.push_back({settings.haze, "haze",
                     settings.haze ? "--haze on: air scatters light between the camera and every surface"
                                   : "--haze off: air scatters no light"});
    return lines;
}

std::vector<PathPlan> planPaths(Device& device, SceneViews& views, const std::vector<Settings>& settings) {
    SharedResources shared(device, views.scene(), std::make_shared<PipelineSet>(device, Creation::planned));
    std::vector<PathPlan> plans;
    for (const Settings& s : settings) {
        checkSize(device, s.size);
        // Counts a path's pipelines as if it were alone, even those that another path has too.
        shared.pipelines.clear();
        const std::size_t others = shared.pipelines.made();
        const PreparedView view(device, shared, views.at(viewRequest(s)), s);
        const PathFunctions& path = functionsOf(s.path);
        PassList passes(device, plannedSize, plannedSize);
        const PixelBytes bytes = pixelBytes(passes, path.add(passes, view.inputs));
        passes.allocate();
        PathPlan plan{std::string(nameOf(s.path)),
                      passes.names(),
                      {{s.msaa, bytes.geometry, bytes.all}},
                      passes.sharedBytes(),
                      drawnCounts(view.draws, shared.geometry, view.culling),
                      {}};
        for (const auto* lines : {&view.notes, &view.details})
            plan.notes.insert(plan.notes.end(), lines->begin(), lines->end());
        plan.notes.push_back(fmt::format("{} in view, {} culled; {}",
                                         counted(view.draws.items.size(), "draw"), view.draws.culled,
                                         counted(shared.pipelines.made() - others, "pipeline")));
        for (const int samples : sampleCounts(device))
            if (samples != s.msaa)
                plan.bytes.push_back(bytesOf(device, shared, views, withSamples(s, samples)));
        plans.push_back(std::move(plan));
    }
    return plans;
}

}  // namespace diptych
