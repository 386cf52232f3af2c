// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/pair_renderer.h"

#include "compare/frames/frame_properties.h"
#include "compare/frames/nonfinite.h"
#include "compare/render/load_scene.h"
#include "shared/frame/debug_modes.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace diptych::viewer {
namespace {

constexpr int minShadowSize = 256;  // texels, while moving

// While moving, unlit pixels count as background, because timed pipelines write only light. The depth
// becomes 1 or 0, for coverage().
void guessBackground(Frame& frame) {
    const Image& light = frame.channels.at(Channel::lit);
    Image near(light.width, light.height, 1);
    for (std::size_t i = 0; i < light.pixels(); ++i)
        near.pixel(i)[0] =
            std::any_of(light.pixel(i), light.pixel(i) + light.components, [](float v) { return v != 0; })
                ? 1.0f
                : 0.0f;
    frame.channels[Channel::depth] = std::move(near);
}

}  // namespace

std::vector<Channel> everyChannel() {
    std::vector<Channel> modes;
    for (const DebugMode& mode : debugModes()) modes.push_back(mode.channel);
    return modes;
}

RenderOptions channelOptions(std::vector<Channel> channels) {
    RenderOptions render;
    render.channels = std::move(channels);
    for (const Channel helper : {Channel::lit, Channel::material_id, Channel::depth})
        if (std::ranges::count(render.channels, helper) == 0) render.channels.push_back(helper);
    render.runs = 0;
    return render;
}

Settings settingsOf(const Subject& subject, Path path, const Size& size) {
    const Size& full = subject.settings.size;
    Settings settings = subject.sides.of(withoutReference(subject.settings), path);
    settings.size = size;
    // The cost of shadow maps does not depend on the image size, so they shrink with it.
    settings.shadow_size = std::max(std::min(settings.shadow_size, minShadowSize),
                                    settings.shadow_size * size.width / std::max(1, full.width));
    if (const auto problem = settings.problem()) throw std::runtime_error(*problem);
    return settings;
}

PairRenderer::PairRenderer(DeviceOptions options, Progress& progress, Progress& finishing)
    : options_(std::move(options)), progress_(progress), finishing_(finishing) {}

bool PairRenderer::isLoaded(const Subject& subject) const {
    return loaded_ && loaded_->scene == subject.scene && loaded_->reading == subject.reading &&
           loaded_->settings.env == subject.settings.env &&
           loaded_->settings.variant == subject.settings.variant;
}

bool PairRenderer::load(const Subject& subject) {
    if (isLoaded(subject)) {
        if (!scene_) throw std::runtime_error(scene_error_);
        return false;
    }
    std::shared_ptr<const Scene> read;
    try {
        read = std::make_shared<const Scene>(
            loadSceneWithSettings(subject.scene, subject.settings, Stage(finishing_, "load")));
    } catch (const std::runtime_error& error) {
        loaded_ = subject;
        scene_error_ = error.what();
        throw;
    }
    scene_error_.clear();
    dropRenderer();
    scene_ = std::move(read);
    loaded_ = subject;
    return true;
}

bool PairRenderer::startDevice() {
    if (device_) return false;
    progress_.at("", 0, "starting the device");
    device_.emplace(options_);
    return true;
}

bool PairRenderer::upload() {
    if (renderer_) return false;
    progress_.at("", 0, "upload");
    pipelines_ = makePipelineSet(*device_);
    views_ = std::make_unique<SceneViews>(*scene_);
    renderer_ = std::make_unique<Renderer>(*device_, *views_, pipelines_);
    return true;
}

void PairRenderer::dropRenderer() {
    renderer_.reset();
    views_.reset();
    pipelines_.reset();
}

void PairRenderer::dropDevice() {
    dropRenderer();
    device_.reset();
}

std::array<Frame, 2> PairRenderer::drawLit(const Subject& subject, const Size& size) {
    const std::array settings{settingsOf(subject, drawn_paths[0], size),
                              settingsOf(subject, drawn_paths[1], size)};
    PreparedFrames prepared = renderer_->prepare(settings);
    std::array<Frame, 2> result;
    for (std::size_t i = 0; i < 2; ++i) {
        Frame& frame = result.at(i);
        frame = prepared.described(i);
        frame.passes = prepared.profile(i);
        frame.time.median = std::accumulate(frame.passes.begin(), frame.passes.end(), 0.0,
                                            [](double sum, const PassTime& pass) { return sum + pass.ms; });
        frame.channels[Channel::lit] = prepared.lit(i);
        if (auto repaired = replaceNonfinite(frame.channels[Channel::lit]); !repaired.empty()) {
            frame.counters.nonfinite_pixels = repaired.size();
            frame.repaired[Channel::lit] = std::move(repaired);
        }
        prepared.readCounters(i, frame.counters);
        guessBackground(frame);
    }
    return result;
}

std::array<Frame, 2> PairRenderer::drawChannels(const Subject& subject, const Size& size,
                                                const std::vector<Channel>& channels, bool passing) {
    RenderOptions render = channelOptions(channels);
    std::array<Frame, 2> result;
    for (std::size_t i = 0; i < 2; ++i) {
        render.progress = Stage(passing ? finishing_ : progress_, "draw")
                              .part(0.5 * static_cast<double>(i), 0.5 * static_cast<double>(i + 1));
        result.at(i) = renderer_->draw(settingsOf(subject, drawn_paths.at(i), size), render);
    }
    return result;
}

}  // namespace diptych::viewer
