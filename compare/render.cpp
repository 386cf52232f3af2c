// SPDX-License-Identifier: MIT
#include "compare/render.h"

#include "compare/metrics/channel.h"
#include "compare/reference/reference.h"
#include "compare/shot.h"
#include "compare/tolerance.h"
#include "compare/truth.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/requirements.h"
#include "shared/scene/rig.h"
#include "shared/scene/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

namespace diptych {

namespace {

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
          drawn_(device, shared, scene, settings) {}

    Frame make() {
        const auto start = std::chrono::steady_clock::now();
        frame_ = describedFrame(drawn_, shared_, scene_, settings_);
        drawTimed();
        lit_ = readLit(drawn_);
        frame_.counters.overflowed_lists = drawn_.shot.buffers.lists().overflowed();
        frame_.counters.nonfinite_pixels = nonfinitePixels(lit_);
        if (!options_.channels.empty()) capture();
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

    // The lean pipelines: one frame to warm up (drivers compile at the first draw), then the timed ones.
    void drawTimed() {
        PassList& passes = drawn_.passes;
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
        frame_.bytes = bytesOf(drawn_, shared_);
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
            for (const int mode : litModes)
                if (asked(mode)) request.through_gbuffer.push_back(mode);
        return request;
    }

    // Every channel, over what the timed frame left; lit itself stays the timed pipeline's.
    void capture() {
        PassList& passes = drawn_.passes;
        say("capture");
        step("capture channels", captureFrames);
        const std::size_t first = passes.size();
        const std::vector<CapturedImage> captured =
            drawn_.path.capture(passes, drawn_.shot.inputs, drawn_.images, captureRequest());
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
            addNoise(lit, readLit(drawn_));
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
    DrawnShot drawn_;
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

struct PreparedFrames::State {
    SharedResources& shared;
    std::vector<std::unique_ptr<DrawnShot>> shots;
    std::vector<Frame> described;
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

std::size_t Renderer::pipelines() const {
    return state_->shared.pipelines.count();
}

PreparedFrames Renderer::prepare(std::span<const Settings> settings) {
    auto state = std::make_unique<PreparedFrames::State>(PreparedFrames::State{state_->shared, {}, {}});
    for (const Settings& s : settings) {
        checkSize(state_->device, s.size);
        state->shots.push_back(std::make_unique<DrawnShot>(state_->device, state_->shared, state_->scene, s));
        DrawnShot& drawn = *state->shots.back();
        state->described.push_back(describedFrame(drawn, state_->shared, state_->scene, s));
        state->described.back().bytes = diptych::bytesOf(drawn, state_->shared);
    }
    return PreparedFrames(std::move(state));
}

PreparedFrames::PreparedFrames(std::unique_ptr<State> state) : state_(std::move(state)) {}
PreparedFrames::PreparedFrames(PreparedFrames&&) noexcept = default;
PreparedFrames::~PreparedFrames() = default;

std::size_t PreparedFrames::size() const {
    return state_->shots.size();
}

double PreparedFrames::draw(std::size_t i) {
    return state_->shots.at(i)->passes.run();
}

std::vector<PassTime> PreparedFrames::profile(std::size_t i) {
    PassList& passes = state_->shots.at(i)->passes;
    std::vector<PassTime> times;
    for (const PassMs& pass : passes.profile(0, passes.size())) times.push_back({pass.name, pass.ms});
    return times;
}

Image PreparedFrames::lit(std::size_t i) {
    return readLit(*state_->shots.at(i));
}

std::uint64_t PreparedFrames::overflowedLists(std::size_t i) const {
    return state_->shots.at(i)->shot.buffers.lists().overflowed();
}

const Frame& PreparedFrames::described(std::size_t i) const {
    return state_->described.at(i);
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
