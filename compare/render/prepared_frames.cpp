// SPDX-License-Identifier: MIT
#include "compare/render/prepared_frames.h"

#include "compare/frames/frame_properties.h"
#include "compare/frames/nonfinite.h"
#include "compare/render/prepared_view.h"

#include <chrono>

namespace diptych {

struct PreparedFrames::State {
    Device& device;
    std::vector<std::unique_ptr<PreparedFrame>> frames;
    std::vector<Frame> described;
};

PreparedFrames::PreparedFrames(Device& device, SharedResources& shared, SceneViews& views,
                               std::span<const Settings> settings)
    : state_(new State{device, {}, {}}) {
    for (const Settings& s : settings) {
        checkSize(device, s.size);
        state_->frames.push_back(
            std::make_unique<PreparedFrame>(device, shared, views.at(viewRequest(s)), s));
        const PreparedFrame& prepared = *state_->frames.back();
        state_->described.push_back(describedFrame(prepared, views.scene(), s));
        state_->described.back().bytes = diptych::bytesOf(prepared, shared);
    }
}

PreparedFrames::PreparedFrames(PreparedFrames&&) noexcept = default;
PreparedFrames::~PreparedFrames() = default;

std::size_t PreparedFrames::size() const {
    return state_->frames.size();
}

double PreparedFrames::draw(std::size_t i) {
    PreparedFrame& frame = *state_->frames.at(i);
    const double culling = frame.view.culling.run();
    return culling + frame.passes.run();
}

double PreparedFrames::recordMs(std::size_t i) const {
    return state_->frames.at(i)->passes.recordMs();
}

double PreparedFrames::objectListsMs(std::size_t i) const {
    return state_->frames.at(i)->view.buffers.objects().selectionMs();
}

void PreparedFrames::warmUp(std::span<const std::size_t> which) {
    const auto start = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> enough(state_->device.profile().warm_up_ms);
    while (!which.empty() && std::chrono::steady_clock::now() - start < enough)
        for (const std::size_t i : which) draw(i);
}

std::vector<PassTime> PreparedFrames::profile(std::size_t i) {
    PreparedFrame& frame = *state_->frames.at(i);
    PassList& passes = frame.passes;
    std::vector<PassTime> times;
    if (frame.view.culling.any()) times.push_back({Culling::name, frame.view.culling.run()});
    for (const PassMs& pass : passes.profile(0, passes.size()))
        if (!times.empty() && times.back().name == pass.name)
            times.back().ms += pass.ms;  // culling runs on host and device
        else
            times.push_back({pass.name, pass.ms});
    return times;
}

Image PreparedFrames::lit(std::size_t i) {
    return readLit(*state_->frames.at(i));
}

void PreparedFrames::readCounters(std::size_t i, FrameCounters& counters) const {
    diptych::readCounters(state_->frames.at(i)->view, counters);
}

Frame PreparedFrames::frame(std::size_t i) {
    Frame frame = described(i);
    readCounters(i, frame.counters);
    Image image = lit(i);
    if (auto repaired = replaceNonfinite(image); !repaired.empty()) {
        frame.counters.nonfinite_pixels = repaired.size();
        frame.repaired[Channel::lit] = std::move(repaired);
    }
    frame.channels[Channel::lit] = std::move(image);
    return frame;
}

const Frame& PreparedFrames::described(std::size_t i) const {
    return state_->described.at(i);
}

}  // namespace diptych
