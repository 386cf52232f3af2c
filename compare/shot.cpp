// SPDX-License-Identifier: MIT
#include "compare/shot.h"

#include "compare/undrawn.h"
#include "deferred/deferred.h"
#include "forward_plus/forward_plus.h"
#include "shared/draw/overdraw.h"
#include "shared/light/cutoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

// The paths, one row each.
const PathFunctions paths[] = {
    {Path::deferred, addDeferred, addDeferredCapture,
     [](const FrameInputs& inputs) { return inputs.gbuffer.bytesPerPixel() + 4; }},
    {Path::forward_plus, addForwardPlus, addForwardPlusCapture,
     [](const FrameInputs&) { return std::uint32_t{4}; }},
};

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

GpuLights lightsOf(const std::vector<Light>& lights, const View& view, const Settings& settings) {
    GpuLights result = gpuLights(withCutoff(lights, double{settings.light_cutoff}), view.eye());
    result.ambient = {settings.ambient.r, settings.ambient.g, settings.ambient.b};
    return result;
}

// A workgroup a cell suits a GPU's wide groups; lavapipe runs them eight threads at a time and tests every
// light in every cell (README, "Many lights").
ListKernel kernelOf(LightKernel kernel, const Device& device) {
    if (kernel == LightKernel::automatic)
        return device.info().isCpu() ? ListKernel::scatter : ListKernel::gather;
    return kernel == LightKernel::scatter ? ListKernel::scatter : ListKernel::gather;
}

// What this path does not draw, or otherwise, and the reference does.
std::vector<std::string> leftOut(const Shot& shot, const Scene& scene, Path path) {
    Pose pose = shot.pose;
    pose.lights = shot.lit_by;
    const Requirements needs = requirements(scene, pose);
    std::vector<std::string> notes = undrawnLight(path, needs);
    std::ranges::move(undrawnMotion(path, needs), std::back_inserter(notes));
    return notes;
}

}  // namespace

SharedResources::SharedResources(Device& d, const Scene& scene)
    : uploader(d),
      geometry(d, uploader, scene),
      materials(d, uploader, scene),
      layouts(d, materials.layout()),
      pipelines(d, layouts.pipeline) {
    uploader.flush();
}

Shot::Shot(Device& device, SharedResources& shared, const Scene& scene, const Settings& settings)
    : pose(poseAt(scene, settings.time)),
      view(makeView(scene, pose, settings.camera, settings.size.width, settings.size.height)),
      needs(requirements(scene, pose)),
      lit_by(litBy(scene, pose, settings)),
      lights(lightsOf(lit_by, view, settings)),
      draws(makeDrawList(pose, shared.geometry, shared.materials, view)),
      buffers(device, shared.uploader, shared.layouts, view, draws, lights,
              {listsOf(settings.assign), kernelOf(settings.light_kernel, device)},
              objectPixelLights(settings)),
      gbuffer(gbufferLayout(settings.gbuffer, needs)),
      inputs{device,
             shared.layouts,
             shared.pipelines,
             shared.geometry,
             shared.materials,
             draws,
             buffers.draws(),
             buffers.set(),
             buffers.carriedNothing(),
             buffers.lists(),
             sceneVariant(needs, lights, view, gbuffer, settings.area_lights),
             gbuffer,
             settings.prepass != Switch::off} {
    buffers.lists().specialise(inputs.variant);
    if (device.info().isCpu()) inputs.variant.set(gpu::FEATURE_view_source, gpu::VIEW_TEXELS);
    const LightLists& lists = buffers.lists();
    const ObjectLightBuffers& objects = buffers.objects();
    inputs.variant.set(gpu::FEATURE_object_lights, objects.features());
    inputs.light_groups = lists.any()               ? lists.grid().all_end
                          : objects.features() != 0 ? objects.longest()
                                                    : lights.local();
    if (settings.path == Path::forward_plus && settings.prepass == Switch::automatic) decidePrepass(settings);
}

void Shot::decidePrepass(const Settings& settings) {
    if (settings.assign == Assignment::tiled) return;
    const LightLists& lists = buffers.lists();
    const gpu::LightGrid& grid = lists.grid();
    const std::uint64_t atPixel =
        lists.any() ? std::uint64_t{grid.capacity} * grid.width / grid.lists : lights.local();
    const PrepassChoice choice =
        choosePrepass(measureOverdraw(inputs, static_cast<std::uint32_t>(settings.size.width),
                                      static_cast<std::uint32_t>(settings.size.height)),
                      static_cast<double>(atPixel + lights.directional), inputs.device.info().isCpu());
    inputs.prepass = choice.on;
    notes.push_back(choice.because);
}

const PathFunctions& functionsOf(Path path) {
    for (const PathFunctions& functions : paths)
        if (functions.path == path) return functions;
    throw std::logic_error(fmt::format("--path {} is drawn by no device", nameOf(path)));
}

DrawnShot::DrawnShot(Device& device, SharedResources& shared, const Scene& scene, const Settings& settings)
    : path(functionsOf(settings.path)),
      shot(device, shared, scene, settings),
      passes(device, static_cast<std::uint32_t>(settings.size.width),
             static_cast<std::uint32_t>(settings.size.height)),
      images(path.add(passes, shot.inputs)) {}

void checkSize(const Device& device, const Size& size) {
    const auto limit = static_cast<int>(std::min(device.limits().maxImageDimension2D, 1u << 24));
    if (size.width > limit || size.height > limit)
        throw std::runtime_error(fmt::format("--size {}x{}: {} draws up to {}x{}", size.width, size.height,
                                             device.info().name, limit, limit));
}

Frame describedFrame(const DrawnShot& drawn, const SharedResources& shared, const Scene& scene,
                     const Settings& settings) {
    Frame frame;
    frame.name = std::string(nameOf(settings.path));
    frame.scene = scene.name;
    frame.settings = settings;
    frame.camera = cameraOf(drawn.shot.view);
    frame.background = {scene.background.r, scene.background.g, scene.background.b};
    frame.notes = scene.notes;
    for (const std::string& note : shared.materials.notes()) frame.notes.push_back(note);
    for (std::string& note : leftOut(drawn.shot, scene, settings.path))
        frame.notes.push_back(std::move(note));
    for (const std::string& note : drawn.shot.notes) frame.notes.push_back(note);
    frame.counters.lights = drawn.shot.lights.count();
    frame.counters.energy_cut =
        energyCut(scene, drawn.shot.pose, drawn.shot.lit_by, double{settings.light_cutoff});
    return frame;
}

FrameBytes bytesOf(const DrawnShot& drawn, const SharedResources& shared) {
    return {drawn.passes.imageBytes() + shared.materials.imageBytes(),
            shared.geometry.bytes() + shared.materials.bufferBytes() + drawn.shot.buffers.bytes(),
            drawn.path.bytesPerPixel(drawn.shot.inputs)};
}

std::vector<Image> readImages(PassList& passes, const std::vector<PassList::ReadBack>& requests) {
    std::vector<std::vector<float>> data = passes.readBack(requests);
    std::vector<Image> images(requests.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
        images[i].width = static_cast<int>(passes.width());
        images[i].height = static_cast<int>(passes.height());
        images[i].components = requests[i].components;
        images[i].data = std::move(data[i]);
    }
    return images;
}

Image readLit(DrawnShot& drawn) {
    return std::move(readImages(drawn.passes, {{drawn.images.lit, 3}}).front());
}

FrameTime timeOf(std::vector<double> ms) {
    FrameTime time;
    time.runs = static_cast<int>(ms.size());
    if (ms.empty()) return time;
    std::sort(ms.begin(), ms.end());
    time.min = ms.front();
    time.max = ms.back();
    time.median = 0.5 * (ms[(ms.size() - 1) / 2] + ms[ms.size() / 2]);
    return time;
}

}  // namespace diptych
