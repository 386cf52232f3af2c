// SPDX-License-Identifier: MIT
// Options for rendering and measuring a Frame.
#pragma once

#include "compare/run/progress.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych {
namespace reference {
class Checkpoint;
}

// Channels to render a second time; a difference indicates a race (Frame::noise).
enum class Twice : std::uint8_t { none, lit, all };

struct RenderOptions {
    // Debug modes to render; forward-only ones are omitted from a deferred Frame, those of layers that the
    // scene lacks unless they are `requested` and named. Empty: only time the frame.
    std::vector<Channel> channels;
    bool named = true;  // whether somebody named the requested channels; false: all that there are
    std::vector<Channel> requested;  // subset of `channels` for Frame::requested; empty: all
    int runs = 5;                    // timed frames, apart from those with timed passes; 0: no times
    // Also shade lit channels from the surfaces that deferred decodes (Frame::through_gbuffer). Forward+
    // encodes and decodes its own; renderAll() passes the deferred Frame's surfaces to the reference.
    bool through_gbuffer = false;
    std::vector<Channel> every_sample;  // with MSAA: subset of `channels` for Frame::further_samples
    std::optional<Settings> decoded;    // reference in mode surface: the deferred Frame's Settings
    // reference: also the errors of environment approximations (Frame::environment_costs), and the
    // environment and ambient light that geometry occludes (Frame::hidden_light).
    bool environment_errors = false;
    // reference: also visibility of directional, point and spot lights, and Frame::shadow_edge and
    // local_shadow_edge. Takes about half of the rays of an image with a directional light.
    bool shadow_edges = true;
    Twice twice = Twice::none;
    // Whether the capture of other channels also renders lit, and counts pixels where it differs from the
    // timed frame's.
    bool recheck = true;
    std::function<void(const std::string&)> on_step;  // called before each step with its name, for -v
    Stage progress;                                   // of renderAll()
    // For a reference: called from any thread with each finished tile: all channels, of which only the
    // tile may be read, and its left and top pixel, width and height.
    std::function<void(const std::map<Channel, Image>& channels, int x, int y, int width, int height)> tile{};
    // Opens a reference's checkpoint, for reference::Request::keep; called once for each. Empty: no
    // checkpoints.
    std::function<reference::Checkpoint&(std::uint64_t key, std::size_t floats)> keep{};
};

// Whether a channel of `channels` is omitted: it is 0 in scenes without its layer. `layers`: of the scene.
inline bool isOmitted(const RenderOptions& options, gpu::uint layers, Channel channel) {
    const bool asked = options.named && std::ranges::count(options.requested, channel) > 0;
    return !mayShow(channel, layers) && !asked;
}
inline RenderOptions withoutAbsentLayers(RenderOptions options, gpu::uint layers) {
    std::erase_if(options.channels, [requested = options, layers](Channel channel) {
        return isOmitted(requested, layers, channel);
    });
    return options;
}

}  // namespace diptych
