// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/reference_thread.h"

#include "compare/frames/frame_properties.h"
#include "compare/render/reference_frame.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <sched.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace diptych::viewer {
namespace {

struct Stopped {};

}  // namespace

// A batch thread has its full share of the cores, but does not preempt a thread that has just woken up, as
// the interface does for each event. Threads that it starts, such as a driver's or a pool's, inherit the
// policy.
void yieldToInterface() {
    const sched_param standard{};
    sched_setscheduler(0, SCHED_BATCH,
                       &standard);  // 0: this thread; if it fails, the interface is only less smooth
}

void ReferenceThread::stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    stop_ = false;
    if (done_ < 1) settings_.reset();  // a partial result is useless
}

void ReferenceThread::begin(std::shared_ptr<const Scene> scene, const Settings& settings,
                            std::optional<Frame> surfaces) {
    stop();
    done_ = 0;
    settings_ = settings;
    {
        const std::lock_guard lock(mutex_);
        finished_.reset();
        error_.clear();
        partial_ = {};
        partial_.settings = settings;
        partial_.name = std::string(nameOf(settings.path));
        if (surfaces) {
            partial_.channels = surfaces->channels;
            partial_.background = surfaces->background;
        }
        Image& mine = partial_.channels[Channel::lit] = Image(settings.size.width, settings.size.height, 3);
        drawn_.assign(mine.pixels(), false);
    }
    thread_ = std::thread([this, scene = std::move(scene), settings, surfaces = std::move(surfaces)] {
        run(scene, settings, surfaces);
    });
}

void ReferenceThread::run(const std::shared_ptr<const Scene>& scene, const Settings& settings,
                          const std::optional<Frame>& surfaces) {
    yieldToInterface();
    try {
        Progress progress([this](const std::string&, double fraction, const std::string&) {
            if (stop_) throw Stopped();
            done_ = std::min(fraction, 0.999);  // 1 once the Frame exists
        });
        RenderOptions options;
        options.runs = 0;
        options.environment_errors = true;
        for (const DebugMode& mode : debugModes()) options.channels.push_back(mode.channel);
        options.requested = options.channels;
        options.progress = Stage(progress, "reference");
        options.tile = [this](const std::map<Channel, Image>& channels, int x, int y, int width, int height) {
            const Image& lit = channels.at(Channel::lit);
            const std::lock_guard lock(mutex_);
            Image& mine = partial_.channels.at(Channel::lit);
            for (int row = y; row < y + height; ++row) {
                std::copy_n(lit.data.data() + lit.offset(x, row), 3 * width,
                            mine.data.data() + mine.offset(x, row));
                const auto first = static_cast<std::ptrdiff_t>(row) * mine.width + x;
                std::fill_n(drawn_.begin() + first, width, true);
            }
            wake_();
        };
        const SceneView view = makeSceneView(*scene, viewRequest(settings));
        auto frame = std::make_shared<Frame>(
            drawReferenceFrame(*scene, view, settings, surfaces ? &*surfaces : nullptr, options));
        const std::lock_guard lock(mutex_);
        finished_ = std::move(frame);
        done_ = 1;
    } catch (const Stopped&) {
        return;
    } catch (const std::exception& error) {
        const std::lock_guard lock(mutex_);
        error_ = error.what();
    }
    wake_();
}

std::shared_ptr<const Frame> ReferenceThread::frame(std::initializer_list<Channel> modes,
                                                    const Image* under) const {
    const std::lock_guard lock(mutex_);
    if (finished_) return finished_;
    Frame frame;
    frame.name = partial_.name;
    frame.settings = partial_.settings;
    frame.background = partial_.background;
    for (const Channel mode : modes)
        if (const Image* const image = findChannel(partial_, mode)) frame.channels[mode] = *image;
    Image& lit = frame.channels[Channel::lit];
    if (under && under->width == lit.width && under->height == lit.height)
        for (std::size_t i = 0; i < lit.pixels(); ++i)
            if (!drawn_[i]) std::copy_n(under->pixel(i), 3, lit.pixel(i));
    return std::make_shared<const Frame>(std::move(frame));
}

std::string ReferenceThread::error() const {
    const std::lock_guard lock(mutex_);
    return error_;
}

}  // namespace diptych::viewer
