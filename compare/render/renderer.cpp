// SPDX-License-Identifier: MIT
#include "compare/render/renderer.h"

#include "compare/frames/frame_properties.h"
#include "compare/frames/nonfinite.h"
#include "compare/metrics/channel.h"
#include "compare/reference/reference.h"
#include "compare/render/host_memory.h"
#include "compare/render/prepared_view.h"
#include "compare/render/reference_frame.h"
#include "compare/render/render_many.h"
#include "compare/run/progress.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/supported_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

constexpr double captureFrames = 3;  // cost of capturing all channels; measured on lavapipe

class FrameBuilder {
public:
    FrameBuilder(Device& device, SharedResources& shared, SceneViews& views, const Settings& settings,
                 const RenderOptions& options)
        : device_(device),
          shared_(shared),
          scene_(views.scene()),
          settings_(settings),
          options_(options),
          prepared_(device, shared, views.at(viewRequest(settings)), settings) {}

    Frame make() {
        const auto start = std::chrono::steady_clock::now();
        frame_ = describedFrame(prepared_, scene_, settings_);
        drawLit();
        if (options_.twice != Twice::none)
            kernels_ = prepared_.passes.kernelResults(0, prepared_.passes.size());
        lit_ = readLit(prepared_);
        readCounters(prepared_.view, frame_.counters);
        if (auto cut = overflowText(lit_, settings_.lit_format)) frame_.notes.push_back(std::move(*cut));
        if (auto repaired = replaceNonfinite(lit_); !repaired.empty()) {
            frame_.counters.nonfinite_pixels = repaired.size();
            if (isRequested(Channel::lit)) frame_.repaired[Channel::lit] = std::move(repaired);
        }
        if (!options_.channels.empty()) capture();
        if (!rechecks() && isRequested(Channel::lit)) frame_.channels[Channel::lit] = std::move(lit_);
        frame_.requested = options_.requested;
        frame_.made_in_ms = msSince(start);
        return std::move(frame_);
    }

private:
    using Repaired = std::vector<std::uint32_t>;

    void announce(const std::string& step) const {
        if (options_.on_step) options_.on_step(frame_.name + ": " + step);
    }
    // Announces a step that takes about as long as `frames` timed frames.
    void step(const std::string& what, double frames = 1) {
        options_.progress.at(framesDone_ / framesIn(options_), frame_.name + ": " + what);
        framesDone_ += frames;
        doing_ = what;
    }
    // Reports progress between parts of the last step().
    void goOn() {
        options_.progress.at(std::min(1.0, framesDone_ / framesIn(options_)), frame_.name + ": " + doing_);
    }
    // Whether the capture also renders lit: to verify other channels, or for light through surfaces.
    bool rechecks() const {
        const auto isOther = [](Channel mode) { return mode != Channel::lit; };
        if (isThroughRequested()) return true;
        return options_.recheck && (std::ranges::any_of(options_.channels, isOther) ||
                                    options_.through_gbuffer || options_.twice != Twice::none);
    }
    bool isRequested(Channel mode) const {
        return std::find(options_.channels.begin(), options_.channels.end(), mode) != options_.channels.end();
    }

    // Light through surfaces is that of the capture's lit.
    bool isThroughRequested() const {
        return isRequested(Channel::lit_transmission) &&
               !isOmitted(options_, prepared_.view.scene.needs.layers, Channel::lit_transmission);
    }

    // Renders with the timed pipelines, which contain no debug code.
    void drawLit() {
        for (const std::string& detail : prepared_.view.details) announce(detail);
        announce("draw");
        step("draw");
        prepared_.passes.run();
        frame_.bytes = bytesOf(prepared_, shared_);
    }

    // lit, for comparison with the timed frame's if requested, and every requested channel that this path
    // supports.
    CaptureRequest captureRequest() const {
        CaptureRequest request;
        if (rechecks()) request.modes = {Channel::lit};
        for (const Channel mode : options_.channels)
            if (mode != Channel::lit && unsupportedReason(settings_, debugMode(mode)).empty() &&
                !isOmitted(options_, prepared_.view.scene.needs.layers, mode))
                request.modes.push_back(mode);
        request.every_sample = options_.every_sample;
        if (options_.through_gbuffer && shadesFragments(settings_.path))
            for (const Channel mode : litModes)
                if ((isRequested(mode) || (mode == Channel::lit && isThroughRequested())) &&
                    !isOmitted(options_, prepared_.view.scene.needs.layers, mode))
                    request.through_gbuffer.push_back(mode);
        return request;
    }

    // Keeps lit from before blending, if lit was requested.
    void takeUnblended(const CapturedImage& read, Image image) {
        if (!isRequested(Channel::lit)) return;
        keepInFile(image.data);
        (read.through_gbuffer ? frame_.unblended_through_gbuffer : frame_.unblended) = std::move(image);
    }

    // Renders every channel from the timed frame's images. lit stays that of the timed pipeline.
    void capture() {
        PassList& passes = prepared_.passes;
        announce("capture");
        step("capture channels", captureFrames);
        const std::size_t first = passes.size();
        std::vector<CapturedImage> captured =
            prepared_.path.capture(passes, prepared_.view.inputs, prepared_.images, captureRequest());
        readCaptured(first, captured,
                     [this](const CapturedImage& read, Image image, const Repaired& repaired) {
                         if (isRequested(read.mode)) recordNonfinite(frame_, read.mode, repaired);
                         if (read.before_blending) return takeUnblended(read, std::move(image));
                         if (read.sample > 0) {
                             keepInFile(image.data);
                             letGo(image.data);
                             frame_.further_samples[read.mode].push_back(std::move(image));
                             return;
                         }
                         if (read.through_gbuffer) {
                             keepInFile(image.data);
                             frame_.through_gbuffer[read.mode] = std::move(image);
                             return;
                         }
                         if (read.mode == Channel::lit) {
                             frame_.counters.unreproduced_pixels =
                                 unequalPixels(image, lit_, device_.profile().bit_exact ? 0 : gpuUlps);
                             image = std::move(lit_);
                         }
                         keepInFile(image.data);
                         frame_.channels[read.mode] = std::move(image);
                     });
        if (options_.twice != Twice::none) {
            announce("second run");
            step("second run", 1);
            passes.run(0, first);
            for (const auto& [buffer, hash] : passes.kernelResults(0, first))
                if (hash != kernels_.at(buffer)) frame_.changed_buffers.push_back(buffer);
            Image again = readLit(prepared_);
            replaceNonfinite(again);
            addNoise(Channel::lit, again);
        }
        if (options_.twice == Twice::all) {
            step("second capture", captureFrames);
            // They come last, and are rendered once.
            std::erase_if(captured, &CapturedImage::through_gbuffer);
            std::erase_if(captured, [](const CapturedImage& read) { return read.sample > 0; });
            readCaptured(first, captured,
                         [this](const CapturedImage& read, const Image& image, const Repaired&) {
                             if (read.mode != Channel::lit) addNoise(read.mode, image);
                         });
        }
        if (isRequested(Channel::lit)) return;
        frame_.channels.erase(Channel::lit);
        frame_.through_gbuffer.erase(Channel::lit);
    }

    // Runs the capture's passes group by group, beginning at pass `first`. Passes each group's channels to
    // `take`, image by image, without NaN and infinity. Frees each image before reading the next, so that
    // few channels are in memory at a time.
    void readCaptured(std::size_t first, std::span<const CapturedImage> captured,
                      const std::function<void(const CapturedImage&, Image, const Repaired&)>& take) {
        PassList& passes = prepared_.passes;
        while (!captured.empty()) {
            const std::size_t pass = captured.front().pass;
            goOn();
            passes.run(first, pass + 1);
            first = pass + 1;
            while (!captured.empty() && captured.front().pass == pass) {
                const std::size_t image = captured.front().image.index;
                std::vector<PassList::ReadBack> requests;
                for (const CapturedImage& channel : captured)
                    if (channel.pass == pass && channel.image.index == image)
                        requests.push_back(
                            {channel.image, debugMode(channel.mode).width, {}, channel.component});
                    else
                        break;
                std::vector<Image> read = readImages(passes, requests);
                for (std::size_t i = 0; i < read.size(); ++i) {
                    const Repaired repaired = replaceNonfinite(read[i]);
                    take(captured[i], std::move(read[i]), repaired);
                }
                captured = captured.subspan(read.size());
            }
        }
    }

    // Stores the difference of a channel's second run from its first.
    void addNoise(Channel channel, const Image& again) {
        const Image& first = frame_.channels.at(channel);
        ChannelNoise noise{unequalPixels(first, again, 0), 0};
        const DebugMode& mode = debugMode(channel);
        if (noise.pixels > 0)
            noise.max =
                channelStats(mode.error_kind, mode.kind, first, again, everyPixel(first.pixels())).max;
        frame_.noise[channel] = noise;
        letGo(first.data);
    }

    Device& device_;
    SharedResources& shared_;
    const Scene& scene_;
    const Settings& settings_;
    const RenderOptions& options_;
    double framesDone_ = 0;
    std::string doing_;
    PreparedFrame prepared_;
    Frame frame_;
    Image lit_;
    std::map<std::string, std::size_t> kernels_;  // results by buffer, if everything is rendered twice
};

// For a reference that lights captured surfaces: the Settings of a deferred image of the same view with a
// lossy G-buffer.
std::optional<Settings> decodedBeside(const Settings& reference, const std::vector<Settings>& all) {
    if (!isReference(reference.path) || reference.reference_mode != ReferenceMode::surface) return {};
    for (const Settings& s : all)
        if (hasGBuffer(s.path) && s.gbuffer != GBufferEncoding::full && s.msaa == 1 &&
            viewRequest(s) == viewRequest(reference))
            return s;
    return {};
}

}  // namespace

double framesIn(const RenderOptions& options) {
    const double timed = options.runs > 0 ? 1 + options.runs + profiledOf(options.runs) : 0;
    const double again = options.twice == Twice::none  ? 0
                         : options.twice == Twice::lit ? 1
                                                       : 1 + captureFrames;
    return timed + 1 + captureFrames + again;
}

struct Renderer::State {
    Device& device;
    std::unique_ptr<SceneViews> own_views;  // if none were given
    SceneViews& views;
    SharedResources shared;
    std::uint64_t approved = 0;  // bytes of host memory
};

std::shared_ptr<PipelineSet> makePipelineSet(Device& device) {
    return std::make_shared<PipelineSet>(device);
}

Renderer::Renderer(Device& device, SceneViews& views, std::shared_ptr<PipelineSet> pipelines)
    : state_(
          new State{device, nullptr, views, SharedResources(device, views.scene(), std::move(pipelines))}) {}
Renderer::Renderer(Device& device, const Scene& scene, std::shared_ptr<PipelineSet> pipelines) {
    auto views = std::make_unique<SceneViews>(scene);
    SceneViews& all = *views;
    state_.reset(
        new State{device, std::move(views), all, SharedResources(device, scene, std::move(pipelines))});
}
Renderer::~Renderer() = default;

void Renderer::checkMemory(std::span<const Settings> settings, const RenderOptions& options) {
    const std::uint64_t needed = checkHostMemory(state_->views, settings, options,
                                                 state_->device.profile().software, state_->approved);
    state_->approved = std::max(state_->approved, needed);
}

Frame Renderer::draw(const Settings& settings, const RenderOptions& options) {
    checkSize(state_->device, settings.size);
    checkMemory(std::span(&settings, 1), options);
    if (isReference(settings.path)) return drawReference(settings, options);
    RenderOptions drawing = options;
    drawing.runs = 0;
    const double timing = 1 - framesIn(drawing) / framesIn(options);
    RenderOptions timed = options;
    timed.progress = options.progress.part(0, timing);
    drawing.progress = options.progress.part(timing, 1);
    const std::vector<TimedFrame> times = time(std::span(&settings, 1), timed);
    Frame frame = FrameBuilder(state_->device, state_->shared, state_->views, settings, drawing).make();
    addTimes(times.front(), frame);
    return frame;
}

// Renders the reference; in mode surface, from surfaces that forward+ captures.
Frame Renderer::drawReference(const Settings& settings, const RenderOptions& options) {
    const Scene& scene = state_->views.scene();
    const SceneView& view = state_->views.at(viewRequest(settings));
    if (settings.reference_mode == ReferenceMode::scene)
        return drawReferenceFrame(scene, view, settings, nullptr, options);
    const Frame surfaces = surfacesFor(surfaceSettings(settings), options);
    std::optional<Frame> decoded;
    if (options.decoded) decoded = surfacesFor(*options.decoded, options);
    return drawReferenceFrame(scene, view, settings, &surfaces, options, decoded ? &*decoded : nullptr);
}

// Surfaces that the reference shades in mode surface, rendered under a path's Settings.
Frame Renderer::surfacesFor(const Settings& settings, const RenderOptions& options) {
    RenderOptions capture;
    capture.channels = reference::surfaceChannels(state_->views.at(viewRequest(settings)).needs.layers);
    capture.recheck = options.recheck;
    capture.runs = 0;
    capture.on_step = options.on_step;
    return FrameBuilder(state_->device, state_->shared, state_->views, settings, capture).make();
}

reference::PixelLight Renderer::referencePixel(const Settings& settings, int x, int y) {
    const Scene& scene = state_->views.scene();
    const SceneView& view = state_->views.at(viewRequest(settings));
    if (settings.reference_mode == ReferenceMode::scene)
        return drawReferencePixel(scene, view, settings, nullptr, x, y);
    const Frame surfaces = surfacesFor(surfaceSettings(settings), {});
    return drawReferencePixel(scene, view, settings, &surfaces, x, y);
}

LightTerms Renderer::lightTerms(const Settings& settings, bool environment) {
    checkSize(state_->device, settings.size);
    return {state_->device, state_->shared, state_->views.at(viewRequest(settings)), settings, environment};
}

void Renderer::clearPipelines(Path path) {
    const PathFunctions& functions = functionsOf(path);
    state_->shared.pipelines.erase([&](const PipelineKey& key) { return functions.draws(key.fragment); });
}

std::size_t Renderer::pipelines() const {
    return state_->shared.pipelines.made();
}

PreparedFrames Renderer::prepare(std::span<const Settings> settings) {
    checkMemory(settings, {});
    return PreparedFrames(state_->device, state_->shared, state_->views, settings);
}

ChannelShading Renderer::shadeChannels(const Settings& settings, const SurfaceImages& images) {
    checkSize(state_->device, settings.size);
    return {state_->device, state_->shared, state_->views.at(viewRequest(settings)), settings, images};
}

std::vector<TimedFrame> Renderer::time(std::span<const Settings> settings, const RenderOptions& options) {
    std::vector<TimedFrame> times(settings.size());
    std::vector<Settings> drawn;
    std::vector<std::size_t> places;  // index of each `drawn` in `settings`
    for (std::size_t i = 0; i < settings.size(); ++i) {
        if (isReference(settings[i].path) || options.runs == 0) continue;
        drawn.push_back(settings[i]);
        places.push_back(i);
    }
    const int profiled = profiledOf(options.runs);
    const double steps = static_cast<double>(drawn.size()) * (1 + options.runs + profiled);
    double done = 0;
    const auto step = [&](std::size_t i, const std::string& what) {
        options.progress.at(done++ / steps, fmt::format("{}: {}", nameOf(drawn[i].path), what));
    };
    if (drawn.empty()) return times;
    const auto now = [] { return std::chrono::steady_clock::now(); };
    const auto begun = now();
    PreparedFrames frames = prepare(drawn);
    std::vector<double> firstMs(drawn.size(), msSince(begun) / static_cast<double>(drawn.size()));
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        if (options.on_step) options.on_step(fmt::format("{}: time", nameOf(drawn[i].path)));
        step(i, "first frame");
        const auto start = now();
        frames.draw(i);
        firstMs[i] += msSince(start);
    }
    std::vector<std::size_t> all(drawn.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<TimedFrame> timed = timeInterleaved(frames, all, options.runs, profiled, step);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        timed[i].made_in_ms += firstMs[i];
        times[places[i]] = std::move(timed[i]);
    }
    return times;
}

std::vector<Frame> renderAll(Device& device, SceneViews& views, const std::vector<Settings>& settings,
                             const RenderOptions& options) {
    return renderAll(device, views, settings, options, nullptr);
}

std::vector<Frame> renderAll(Device& device, SceneViews& views, const std::vector<Settings>& settings,
                             const RenderOptions& options, const std::shared_ptr<PipelineSet>& pipelines) {
    for (const Settings& s : settings) checkSize(device, s.size);
    options.progress.at(0, "upload");
    Renderer renderer(device, views, pipelines);
    renderer.checkMemory(settings, options);
    RenderOptions each = options, timed = options;
    each.runs = 0;
    const double timing = 1 - framesIn(each) / framesIn(options);
    timed.progress = options.progress.part(0, timing);
    const std::vector<TimedFrame> times = renderer.time(settings, timed);
    std::vector<Frame> frames;
    const auto count = static_cast<double>(settings.size());
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const auto overall = [&](double done) { return timing + (1 - timing) * done / count; };
        const auto done = static_cast<double>(i);
        each.progress = options.progress.part(overall(done), overall(done + 1));
        each.decoded = options.through_gbuffer ? decodedBeside(settings[i], settings) : std::nullopt;
        frames.push_back(renderer.draw(settings[i], each));
        addTimes(times[i], frames.back());
        if (pipelines) continue;
        // Destroys the pipelines of a path that is not needed again: lavapipe takes some 1.5 MB for each
        // of the gallery's.
        if (!isReference(settings[i].path) &&
            std::none_of(settings.begin() + static_cast<std::ptrdiff_t>(i) + 1, settings.end(),
                         [&](const Settings& later) { return later.path == settings[i].path; }))
            renderer.clearPipelines(settings[i].path);
    }
    return frames;
}

std::vector<Frame> renderAll(Device& device, const Scene& scene, const std::vector<Settings>& settings,
                             const RenderOptions& options) {
    SceneViews views(scene);
    return renderAll(device, views, settings, options);
}

}  // namespace diptych
