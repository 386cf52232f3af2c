// SPDX-License-Identifier: MIT
#include "compare/render.h"

#include "compare/metrics/channel.h"
#include "compare/reference/reference.h"
#include "compare/tolerance.h"
#include "compare/truth.h"
#include "compare/undrawn.h"
#include "deferred/deferred.h"
#include "forward_plus/forward_plus.h"
#include "shared/contract/debug_mode.h"
#include "shared/draw/overdraw.h"
#include "shared/frame/debug_modes.h"
#include "shared/light/cutoff.h"
#include "shared/scene/requirements.h"
#include "shared/scene/rig.h"
#include "shared/scene/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory>
#include <stdexcept>

namespace diptych {

namespace {

// What all Settings share: uploaded and compiled once.
struct SharedResources {
    SharedResources(Device& d, const Scene& scene)
        : uploader(d),
          geometry(d, uploader, scene),
          materials(d, uploader, scene),
          layouts(d, materials.layout()),
          pipelines(d, layouts.pipeline) {
        uploader.flush();
    }
    Uploader uploader;
    Geometry geometry;
    Materials materials;
    Layouts layouts;
    Pipelines pipelines;
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

// A workgroup a cell suits a GPU's wide groups; lavapipe runs them eight threads at a time and tests every
// light in every cell (README, "Many lights").
ListKernel kernelOf(LightKernel kernel, const Device& device) {
    if (kernel == LightKernel::automatic)
        return device.info().isCpu() ? ListKernel::scatter : ListKernel::gather;
    return kernel == LightKernel::scatter ? ListKernel::scatter : ListKernel::gather;
}

// One view of the scene under one Settings, ready for passes.
class Shot {
public:
    Shot(Device& device, SharedResources& shared, const Scene& scene, const Settings& settings)
        : pose(poseAt(scene, settings.time)),
          view(makeView(scene, pose, settings.camera, settings.size.width, settings.size.height)),
          needs(requirements(scene, pose)),
          lit_by(litBy(scene, pose, settings)),
          lights(gpuLights(withCutoff(lit_by, double{settings.light_cutoff}), view.eye())),
          draws(makeDrawList(pose, shared.geometry, shared.materials, view)),
          buffers(device, shared.uploader, shared.layouts, shared.materials, view, draws, lights,
                  {listsOf(settings.assign), kernelOf(settings.light_kernel, device)}),
          gbuffer(gbufferLayout(settings.gbuffer, needs)),
          inputs{device,           shared.layouts,
                 shared.pipelines, shared.geometry,
                 shared.materials, draws,
                 buffers.set(),    buffers.carriedNothing(),
                 buffers.lists(),  sceneVariant(needs, lights, view, gbuffer),
                 gbuffer,          settings.prepass != Switch::off} {
        buffers.lists().specialise(inputs.variant);
        const LightLists& lists = buffers.lists();
        inputs.light_groups = lists.any() ? lists.grid().all_end : lights.local();
        if (settings.path == Path::forward_plus && settings.prepass == Switch::automatic)
            decidePrepass(settings);
    }
    Shot(const Shot&) = delete;
    Shot& operator=(const Shot&) = delete;

    // Tiles are bounded by depth, so they need it first.
    void decidePrepass(const Settings& settings) {
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

    std::vector<std::string> notes;  // what was decided for this view
    Pose pose;
    View view;
    Requirements needs;
    std::vector<Light> lit_by;
    GpuLights lights;
    DrawList draws;
    FrameBuffers buffers;
    GBufferLayout gbuffer;
    FrameInputs inputs;
};

// The paths, one row each.
struct PathFunctions {
    Path path;
    FrameImages (*add)(PassList&, const FrameInputs&);
    std::vector<CapturedImage> (*capture)(PassList&, const FrameInputs&, const FrameImages&,
                                          const CaptureRequest&);
    std::uint32_t (*bytesPerPixel)(const FrameInputs&);
};

const PathFunctions paths[] = {
    {Path::deferred, addDeferred, addDeferredCapture,
     [](const FrameInputs& inputs) { return inputs.gbuffer.bytesPerPixel() + 4; }},
    {Path::forward_plus, addForwardPlus, addForwardPlusCapture,
     [](const FrameInputs&) { return std::uint32_t{4}; }},
};

const PathFunctions& functionsOf(Path path) {
    for (const PathFunctions& functions : paths)
        if (functions.path == path) return functions;
    throw std::logic_error(fmt::format("--path {} is drawn by no device", nameOf(path)));
}

void checkSize(const Device& device, const Size& size) {
    const auto limit = static_cast<int>(std::min(device.limits().maxImageDimension2D, 1u << 24));
    if (size.width > limit || size.height > limit)
        throw std::runtime_error(fmt::format("--size {}x{}: {} draws up to {}x{}", size.width, size.height,
                                             device.info().name, limit, limit));
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

constexpr double captureFrames = 3;  // a capture of all channels; measured, lavapipe

class FrameMaker {
public:
    FrameMaker(Device& device, SharedResources& shared, const Scene& scene, const Settings& settings,
               const RenderOptions& options)
        : device_(device),
          shared_(shared),
          scene_(scene),
          settings_(settings),
          options_(options),
          shot_(device, shared, scene, settings),
          path_(functionsOf(settings.path)) {}

    Frame make() {
        const auto start = std::chrono::steady_clock::now();
        frame_.name = std::string(nameOf(settings_.path));
        frame_.scene = scene_.name;
        frame_.settings = settings_;
        frame_.camera = cameraOf(shot_.view);
        frame_.background = {scene_.background.r, scene_.background.g, scene_.background.b};
        frame_.notes = scene_.notes;
        for (const std::string& note : shared_.materials.notes()) frame_.notes.push_back(note);
        for (std::string& note : leftOutNotes()) frame_.notes.push_back(std::move(note));
        for (const std::string& note : shot_.notes) frame_.notes.push_back(note);
        frame_.counters.lights = shot_.lights.count();
        frame_.counters.energy_cut =
            energyCut(scene_, shot_.pose, shot_.lit_by, double{settings_.light_cutoff});
        PassList passes(device_, static_cast<std::uint32_t>(settings_.size.width),
                        static_cast<std::uint32_t>(settings_.size.height));
        const FrameImages images = path_.add(passes, shot_.inputs);
        drawTimed(passes);
        lit_ = readLit(passes, images);
        frame_.counters.overflowed_lists = shot_.buffers.lists().overflowed();
        frame_.counters.nonfinite_pixels = nonfinitePixels(lit_);
        if (!options_.channels.empty()) capture(passes, images);
        frame_.asked = options_.asked;
        frame_.made_in_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        return std::move(frame_);
    }

private:
    void say(const std::string& step) const {
        if (options_.said) options_.said(frame_.name + ": " + step);
    }
    // Before something that takes about as long as `frames` timed frames do.
    void step(const std::string& what, double frames = 1) {
        options_.progress.at(framesDone_ / framesIn(options_), frame_.name + ": " + what);
        framesDone_ += frames;
    }
    bool asked(int mode) const {
        return std::find(options_.channels.begin(), options_.channels.end(), mode) != options_.channels.end();
    }

    // What this path does not draw, or otherwise, and the reference does.
    std::vector<std::string> leftOutNotes() const {
        Pose pose = shot_.pose;
        pose.lights = shot_.lit_by;
        const Requirements needs = requirements(scene_, pose);
        std::vector<std::string> notes = undrawnLight(settings_.path, needs);
        std::ranges::move(undrawnMotion(settings_.path, needs), std::back_inserter(notes));
        return notes;
    }

    // The lean pipelines: one frame to warm up (drivers compile at the first draw), then the timed ones.
    void drawTimed(PassList& passes) {
        say("draw");
        step("first frame");
        passes.run();
        std::vector<double> ms;
        for (int i = 0; i < options_.runs; ++i) {
            step(fmt::format("frame {} of {}", i + 1, options_.runs));
            ms.push_back(passes.run());
        }
        frame_.time = timeOf(std::move(ms));
        step("time of each pass");
        if (options_.runs > 0)
            for (const PassMs& pass : passes.profile(0, passes.size()))
                frame_.passes.push_back({pass.name, pass.ms});
        frame_.bytes.images = passes.imageBytes() + shared_.materials.imageBytes();
        frame_.bytes.buffers =
            shared_.geometry.bytes() + shared_.materials.bufferBytes() + shot_.buffers.bytes();
        frame_.bytes.gbuffer_per_pixel = path_.bytesPerPixel(shot_.inputs);
    }

    // lit, to be held against the timed one, and every channel asked for that this path can make.
    CaptureRequest captureRequest() const {
        CaptureRequest request;
        request.modes = {lit};
        for (const int mode : options_.channels)
            if (mode != lit &&
                (settings_.path == Path::forward_plus || debugMode(mode).maker != MadeBy::forward_only))
                request.modes.push_back(mode);
        if (options_.through_gbuffer && settings_.path == Path::forward_plus)
            for (const gpu::uint mode : {gpu::DEBUG_lit, gpu::DEBUG_lit_diffuse, gpu::DEBUG_lit_specular})
                if (asked(static_cast<int>(mode))) request.through_gbuffer.push_back(static_cast<int>(mode));
        return request;
    }

    Image readLit(PassList& passes, const FrameImages& images) const {
        return std::move(readImages(passes, {{images.lit, 3}}).front());
    }

    // Every channel, over what the timed frame left; lit itself stays the timed pipeline's.
    void capture(PassList& passes, const FrameImages& images) {
        say("capture");
        step("capture channels", captureFrames);
        const std::size_t first = passes.size();
        const std::vector<CapturedImage> captured =
            path_.capture(passes, shot_.inputs, images, captureRequest());
        std::vector<PassList::ReadBack> requests;
        for (const CapturedImage& c : captured) requests.push_back({c.image, debugMode(c.mode).width});
        const auto read = [&] {
            passes.run(first, passes.size());
            return readImages(passes, requests);
        };
        std::vector<Image> channels = read();
        for (std::size_t i = 0; i < captured.size(); ++i)
            (captured[i].through_gbuffer ? frame_.through_gbuffer : frame_.channels)[captured[i].mode] =
                std::move(channels[i]);
        frame_.counters.unreproduced_pixels =
            unequalPixels(frame_.channels[lit], lit_, device_.info().isCpu() ? 0 : gpuUlps);
        frame_.channels[lit] = std::move(lit_);
        if (options_.twice) {
            say("once more");
            step("draw once more", 2);
            passes.run(0, first);
            addNoise(lit, readLit(passes, images));
            step("capture once more", captureFrames);
            channels = read();
            for (std::size_t i = 0; i < captured.size(); ++i)
                if (!captured[i].through_gbuffer && captured[i].mode != lit)
                    addNoise(captured[i].mode, channels[i]);
        }
        if (!asked(lit)) frame_.channels.erase(lit);
    }

    // The second run of a channel against the first.
    void addNoise(int number, const Image& again) {
        const Image& first = frame_.channels.at(number);
        ChannelNoise noise{unequalPixels(first, again, 0), 0};
        const DebugMode& mode = debugMode(number);
        if (noise.pixels > 0)
            noise.max = channelStats(mode.metric, mode.kind, first, again, everyPixel(first.pixels())).max;
        frame_.noise[number] = noise;
    }

    static constexpr int lit = static_cast<int>(gpu::DEBUG_lit);

    Device& device_;
    SharedResources& shared_;
    const Scene& scene_;
    const Settings& settings_;
    const RenderOptions& options_;
    double framesDone_ = 0;
    Shot shot_;
    const PathFunctions& path_;
    Frame frame_;
    Image lit_;
};

}  // namespace

std::uint64_t nonfinitePixels(const Image& image) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float* p = image.pixel(i);
        count += !std::all_of(p, p + image.components, [](float v) { return std::isfinite(v); });
    }
    return count;
}

FrameCamera cameraOf(const View& view) {
    FrameCamera camera;
    camera.name = view.camera.name;
    const glm::dvec3 eye = view.eye(), target = view.target(), up = view.up();
    for (int i = 0; i < 3; ++i) {
        camera.eye[i] = eye[i];
        camera.target[i] = target[i];
        camera.up[i] = up[i];
    }
    camera.fov_degrees = view.camera.orthographic ? 0.0 : glm::degrees(view.camera.yfov);
    camera.ymag = view.camera.orthographic ? view.camera.ymag : 0.0;
    camera.near = view.camera.near;
    camera.far = view.camera.far;
    return camera;
}

std::vector<Light> litBy(const Scene& scene, const Pose& pose, const Settings& settings) {
    std::vector<Light> lights = pose.lights;
    if (!settings.lights.empty())
        for (Light& light : makeLights(settings.lights, settings.seed, boundsAtStart(scene, pose)))
            lights.push_back(std::move(light));
    if (lights.empty() && !scene.environment) {
        // The sun stands behind the default view, whichever camera is chosen, so that it lights what faces
        // it.
        Pose withoutCameras = pose;
        withoutCameras.cameras.clear();
        lights.push_back(defaultSun(makeView(scene, withoutCameras, "", 1, 1).backward()));
    }
    return lights;
}

double framesIn(const RenderOptions& options) {
    return 2 + options.runs + (options.twice ? 2 + 2 * captureFrames : captureFrames);
}

struct Renderer::State {
    Device& device;
    const Scene& scene;
    SharedResources shared;
};

Renderer::Renderer(Device& device, const Scene& scene)
    : state_(new State{device, scene, SharedResources(device, scene)}) {}
Renderer::~Renderer() = default;

Frame Renderer::draw(const Settings& settings, const RenderOptions& options) {
    checkSize(state_->device, settings.size);
    if (settings.path == Path::reference) return drawReference(settings, options);
    return FrameMaker(state_->device, state_->shared, state_->scene, settings, options).make();
}

// The reference, over what forward+ captures where that is asked for.
Frame Renderer::drawReference(const Settings& settings, const RenderOptions& options) {
    if (settings.reference_mode == ReferenceMode::scene)
        return drawTruth(state_->scene, settings, nullptr, options);
    RenderOptions capture;
    capture.channels = reference::surfaceChannels();
    capture.runs = 0;
    capture.said = options.said;
    const Frame surfaces =
        FrameMaker(state_->device, state_->shared, state_->scene, surfaceSettings(settings), capture).make();
    Frame truth = drawTruth(state_->scene, settings, &surfaces, options);
    return truth;
}

std::vector<Frame> renderAll(Device& device, const Scene& scene, const std::vector<Settings>& settings,
                             const RenderOptions& options) {
    for (const Settings& s : settings) checkSize(device, s.size);
    options.progress.at(0, "upload");
    Renderer renderer(device, scene);
    RenderOptions each = options;
    std::vector<Frame> frames;
    const auto count = static_cast<double>(settings.size());
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const auto done = static_cast<double>(i);
        each.progress = options.progress.part(done / count, (done + 1) / count);
        frames.push_back(renderer.draw(settings[i], each));
    }
    return frames;
}

std::vector<PathPlan> planPaths(Device& device, const Scene& scene, const std::vector<Settings>& settings) {
    SharedResources shared(device, scene);
    std::vector<PathPlan> plans;
    for (const Settings& s : settings) {
        checkSize(device, s.size);
        const Shot shot(device, shared, scene, s);
        const PathFunctions& path = functionsOf(s.path);
        const std::size_t pipelinesBefore = shared.pipelines.count();
        PassList passes(device, 1, 1);
        path.add(passes, shot.inputs);
        PathPlan plan{std::string(nameOf(s.path)), passes.names(), path.bytesPerPixel(shot.inputs), {}};
        for (const std::string& note : shot.notes) plan.notes.push_back(note);
        plan.notes.push_back(fmt::format("{} draws in view, {} culled, {} pipelines", shot.draws.items.size(),
                                         shot.draws.culled, shared.pipelines.count() - pipelinesBefore));
        plans.push_back(std::move(plan));
    }
    return plans;
}

}  // namespace diptych
