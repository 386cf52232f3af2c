// SPDX-License-Identifier: MIT
#include "compare/render/prepared_view.h"

#include "compare/frames/frame_properties.h"
#include "compare/render/omitted_lights.h"
#include "shared/draw/light_batches.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/resolve.h"
#include "shared/light/cutoff.h"
#include "shared/scene/lights/shadow_casters.h"
#include "shared/transparent/transparent.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

gpu::uint listsOf(Assignment assign) {
    switch (assign) {
        case Assignment::tiled:
            return gpu::LISTS_TILED;
        case Assignment::clustered:
            return gpu::LISTS_CLUSTERED;
        case Assignment::every:
        case Assignment::per_object:
            break;
    }
    return gpu::LISTS_NONE;
}

std::optional<std::uint32_t> objectPixelLights(const Settings& settings) {
    if (settings.assign != Assignment::per_object) return std::nullopt;
    return static_cast<std::uint32_t>(settings.pixel_lights);
}

// Empty if no directional light casts shadows or shadows are off.
std::optional<CastingSun> castingSun(const std::vector<Light>& scene_lights, const GpuLights& lights,
                                     const Settings& settings) {
    if (settings.shadows == Shadows::off) return {};
    const std::optional<std::size_t> sun = brightestSun(scene_lights);
    for (gpu::uint i = 0; sun && i < lights.directional; ++i)
        if (lights.sources[i] == *sun) return CastingSun{i, double{scene_lights[*sun].angle}};
    return {};
}

// The directional light that haze scatters, or nullptr.
const Light* sunOf(const std::vector<Light>& lights) {
    const std::optional<std::size_t> sun = brightestSun(lights);
    return sun ? &lights[*sun] : nullptr;
}

GpuLights lightsOf(const SceneView& seen, const Settings& settings) {
    const std::vector<Light>& lights = seen.lights;
    const LocalCasting casting =
        settings.shadows == Shadows::off ? LocalCasting{} : localCasting(lights, settings.shadow_lights);
    GpuLights result =
        gpuLights(withCutoff(lights, double{settings.light_cutoff}), seen.view.eye(), casting.lights);
    result.falloff = {.squared_window = settings.range_window == RangeWindow::squared,
                      .smooth_cones = settings.spot_cone == SpotFalloff::smoothstep};
    result.ambient = {settings.ambient.r, settings.ambient.g, settings.ambient.b};
    result.environment = EnvironmentLight::isLit(seen.environment, settings);
    // A light that is not shaded per pixel cannot be shadowed.
    if (const std::optional<CastingSun> sun = castingSun(lights, result, settings)) result.base = sun->light;
    return result;
}

// One thread per tile and word of lights suits a GPU; lavapipe is faster marking the cells of each light
// (shared/light/MEASURED.md, "What lists cost").
LightCullingKernel kernelOf(LightKernel kernel, const Device& device) {
    if (kernel == LightKernel::automatic)
        return device.profile().wide_groups ? LightCullingKernel::gather : LightCullingKernel::scatter;
    return kernel == LightKernel::scatter ? LightCullingKernel::scatter : LightCullingKernel::gather;
}

std::optional<Materials> posedMaterials(Device& device, SharedResources& shared, const Materials& rest,
                                        const Pose& pose) {
    if (pose.materials.empty()) return std::nullopt;
    std::optional<Materials> posed(std::in_place, device, shared.uploader, rest, pose.materials);
    shared.uploader.flush();
    return posed;
}

}  // namespace

PipelineSet::PipelineSet(Device& device, Creation creation)
    : material(Materials::makeLayout(device)),
      layouts(device, material),
      pipelines(device, layouts.pipeline, drawingParts, creation) {}

SharedResources::SharedResources(Device& d, const Scene& scene, std::shared_ptr<PipelineSet> shared)
    : uploader(d),
      geometry(d, uploader, scene),
      posings(d, uploader, scene, geometry),
      set(shared ? std::move(shared) : std::make_shared<PipelineSet>(d)),
      layouts(set->layouts),
      pipelines(set->pipelines),
      clipmaps(d, layouts.frame),
      environments(d),
      device_(d) {
    uploader.flush();
}

const Materials& SharedResources::materials(TexturePrecision precision) {
    auto found = materials_.find(precision);
    if (found == materials_.end()) {
        found = materials_.try_emplace(precision, device_, uploader, geometry.scene(), precision).first;
        uploader.flush();
    }
    return found->second;
}

namespace {

// Requirements of the surfaces that the G-buffer stores.
Requirements storedNeeds(const Requirements& needs, const Settings& settings) {
    Requirements stored = needs;
    if (settings.layers == Layers::forward) stored.surface_layers = 0;
    return stored;
}

}  // namespace

PreparedView::PreparedView(Device& device, SharedResources& shared, const SceneView& seen,
                           const Settings& settings)
    : scene(seen),
      materials_at_rest(shared.materials(settings.textures)),
      posed_materials(posedMaterials(device, shared, materials_at_rest, seen.pose)),
      materials(posed_materials ? *posed_materials : materials_at_rest),
      lights(lightsOf(scene, settings)),
      draws(makeDrawList(scene.pose, shared.geometry, materials, scene.view, settings.transparency,
                         hasGBuffer(settings.path) && settings.layers == Layers::forward)),
      culling(device, shared.pipelines, shared.layouts, shared.geometry,
              {scene.pose, scene.view, settings.msaa, settings.cull}, draws),
      posing(shared.posings.at(scene.pose, settings.skinning, settings.skin_normals, shared.pipelines)),
      buffers(
          device, shared.uploader, shared.layouts, {scene.view, draws, lights},
          {{listsOf(settings.assign), kernelOf(settings.light_kernel, device), !draws.transparent().empty()},
           objectPixelLights(settings),
           readsSpecularAlbedo(lights, settings) && settings.specular_albedo == SpecularAlbedo::table,
           (scene.needs.layers & gpu::LAYER_SHEEN) != 0,
           settings.spec_aa_limit}),
      environment(device, shared.uploader, shared.environments, {scene.environment, scene.background},
                  buffers.sets(), settings),
      haze(device, shared.uploader, settings, sunOf(scene.lights), scene.view.eye(), buffers.sets()),
      shadow(device, shared.uploader,
             {scene.pose, shared.geometry, materials, scene.view, draws, lights, scene.lights},
             buffers.sets(), settings),
      fragments(device, draws, settings),
      gbuffer(gbufferLayout(settings.gbuffer, storedNeeds(scene.needs, settings), settings.msaa > 1)),
      inputs{
          .device = device,
          .layouts = shared.layouts,
          .pipelines = shared.pipelines,
          .geometry = shared.geometry,
          .posing = *posing,
          .materials = materials,
          .draws = draws,
          .lights = lights,
          .draw_buffer = buffers.draws(),
          .sorted_indices = buffers.sortedIndices(),
          .culling = &culling,
          .frame_set = buffers.set(),
          .placeholders = buffers.placeholders(),
          .lists = buffers.lists(),
          .variant = sceneVariant(storedNeeds(scene.needs, settings), lights, scene.view, gbuffer, settings),
          .gbuffer = gbuffer,
          .lighting = settings.lighting,
          .layers = scene.needs.surface_layers,
          .depth = depthStorage(settings.depth_format),
          .lit_format = litFormatOf(settings.lit_format),
          .shadow = shadow,
          .transparency = settings.transparency,
          .blurred_backdrop = scene.needs.rough_glass || settings.spec_aa,
          .blended = blendedRange(draws, scene.view),
          .fragments = &fragments,
          .samples = static_cast<VkSampleCountFlagBits>(settings.msaa),
          .sample_shading = settings.msaa_shading == MsaaShading::sample,
          .edges = settings.msaa_edges,
          .alpha_to_coverage = settings.alpha_to_coverage,
      } {
    if (const auto problem = drawingProblem(device, settings)) throw std::runtime_error(*problem);
    inputs.variant.set(gpu::FEATURE_depth_format, inputs.depth.kind);
    shadow.prepare(inputs, shared.uploader, shared.clipmaps, scene.pose, scene.view,
                   castingSun(scene.lights, lights, settings));
    shadow.specialise(inputs.variant);
    environment.specialise(inputs.variant);
    haze.specialise(inputs.variant);
    buffers.lists().specialise(inputs.variant);
    if (device.profile().gathers_uniforms) inputs.variant.set(gpu::FEATURE_view_source, gpu::VIEW_TEXELS);
    const LightLists& lists = buffers.lists();
    const ObjectLightBuffers& objects = buffers.objects();
    inputs.variant.set(gpu::FEATURE_object_lights, objects.features());
    inputs.longest_list = lists.any()               ? lists.grid().all_end
                          : objects.features() != 0 ? objects.longest()
                                                    : lights.local();
    inputs.entries_per_draw = entriesPerDraw(device.profile(), lights, scene.needs.layers,
                                             inputs.variant.get(gpu::FEATURE_list_width));
    checkLightsOfBlended(inputs);
    checkSamples(inputs);
    details = functionsOf(settings.path).prepare(inputs, settings);
    shadow.choosePages(inputs);
    std::ranges::copy(shadow.sun.details(), std::back_inserter(details));
    std::ranges::move(shadow.notes(), std::back_inserter(notes));
    std::ranges::copy(environment.notes(), std::back_inserter(notes));
}

PreparedFrame::PreparedFrame(Device& device, SharedResources& shared, const SceneView& scene,
                             const Settings& settings)
    : path(functionsOf(settings.path)),
      view(device, shared, scene, settings),
      passes(device, static_cast<std::uint32_t>(settings.size.width),
             static_cast<std::uint32_t>(settings.size.height)),
      images(path.add(passes, view.inputs)) {}

void checkSize(const Device& device, const Size& size) {
    const auto limit = static_cast<int>(std::min(device.support().maxPixels(), 1u << 24));
    if (size.width > limit || size.height > limit)
        throw std::runtime_error(fmt::format("--size {}x{}: {} draws up to {}x{}", size.width, size.height,
                                             device.info().name, limit, limit));
}

Frame describedFrame(const PreparedFrame& prepared, const Scene& scene, const Settings& settings) {
    const SceneView& seen = prepared.view.scene;
    Frame frame = describedFrame(scene, seen, settings);
    for (const std::string& note : prepared.view.materials.notes()) frame.notes.push_back(note);
    std::ranges::move(omittedLights(settings.path, seen.needs), std::back_inserter(frame.notes));
    std::ranges::move(omittedShadows(seen.lights, settings), std::back_inserter(frame.notes));
    for (const std::string& note : prepared.view.notes) frame.notes.push_back(note);
    frame.shadow_filter_radii = prepared.view.shadow.sun.filterRadii();
    frame.shadow_level_filter_radii = prepared.view.shadow.sun.levelFilterRadii();
    frame.counters.shadow_pages = prepared.view.shadow.sun.pages();
    frame.local_shadow_filter_radius = prepared.view.shadow.local.filterRadius();
    frame.counters.lights = prepared.view.lights.count();
    frame.counters.energy_cut =
        energyCut(scene, seen.pose, seen.lights, double{settings.light_cutoff}, prepared.view.lights.falloff);
    return frame;
}

void readCounters(PreparedView& view, FrameCounters& counters) {
    counters.overflowed_lists = view.buffers.lists().overflowed();
    const FragmentLists::Overflow overflow = view.fragments.overflow();
    counters.unsorted = {overflow.fragments, overflow.pixels};
}

FrameBytes bytesOf(const PreparedFrame& prepared, const SharedResources& shared) {
    const PixelBytes pixel = pixelBytes(prepared.passes, prepared.images);
    const std::uint64_t pixels = std::uint64_t{prepared.passes.width()} * prepared.passes.height();
    return {prepared.passes.imageBytes() + prepared.view.materials.imageBytes() +
                prepared.view.shadow.imageBytes() + prepared.view.environment.imageBytes(),
            shared.geometry.bytes() + shared.posings.bytes() + prepared.view.posing->bytes() +
                prepared.view.materials.bufferBytes() + prepared.view.buffers.bytes() +
                prepared.view.culling.bytes() + prepared.view.shadow.bytes() +
                prepared.view.environment.bytes() + prepared.view.haze.bytes() +
                prepared.view.fragments.bytes() + (prepared.images.tiles ? prepared.images.tiles->size() : 0),
            pixel.geometry, pixel.all * pixels};
}

std::vector<Image> readImages(PassList& passes, std::span<const PassList::ReadBack> requests) {
    std::vector<Image> images;
    std::vector<std::span<float>> into;
    for (const PassList::ReadBack& request : requests)
        images.emplace_back(static_cast<int>(passes.width()), static_cast<int>(passes.height()),
                            request.components);
    for (Image& image : images) into.emplace_back(image.data);
    passes.readBack(requests, into);
    return images;
}

Image readLit(PreparedFrame& prepared) {
    return std::move(
        readImages(prepared.passes, std::array{PassList::ReadBack{prepared.images.lit, 3}}).front());
}

}  // namespace diptych
