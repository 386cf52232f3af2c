// SPDX-License-Identifier: MIT
// What is drawn and measured when a Frame is made of Settings.
#pragma once

#include "compare/run/progress.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"

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

// The channels that are drawn a second time: a difference is a race (Frame::noise).
enum class Twice : std::uint8_t { none, lit, all };

struct RenderOptions {
    // Debug modes to draw; a forward-only one is left out of a deferred Frame. Empty: the frame is timed and
    // nothing else.
    std::vector<int> channels;
    std::vector<int> requested;  // of these, Frame::requested; empty: all
    int runs = 5;                // timed frames, beside which passes are timed; 0: no times
    // Also shade lit channels from the surfaces that deferred decodes (Frame::through_gbuffer): forward+
    // encodes and decodes its own; renderAll() gives the reference those of the deferred Frame beside it.
    bool through_gbuffer = false;
    std::vector<int> every_sample;    // with MSAA, Frame::further_samples: of these of `channels`
    std::optional<Settings> decoded;  // reference in mode surface: that Frame's Settings
    // reference: also what approximations of an environment cost (Frame::environment_costs), and what of its
    // light and of ambient light geometry hides (Frame::hidden_light).
    bool environment_errors = false;
    // reference: also what is seen of suns, points and spots, and Frame::shadow_edge and local_shadow_edge.
    // That takes about half of the rays of a picture with a sun.
    bool shadow_edges = true;
    Twice twice = Twice::none;
    // Whether what makes other channels than lit draws lit, too, and counts where it is not the timed
    // frame's.
    bool recheck = true;
    std::function<void(const std::string&)> on_step;  // called before each step with its name, for -v
    Stage progress;                                   // of renderAll()
    // Of a reference: called from any thread with each tile once it is drawn: all channels, of which only the
    // tile may be read, its left and top pixel, width and height.
    std::function<void(const std::map<int, Image>& channels, int x, int y, int width, int height)> tile{};
    // Where a reference keeps what is done of it, as reference::Request::keep; asked once for each. Empty:
    // nowhere.
    std::function<reference::Checkpoint&(std::uint64_t key, std::size_t floats)> keep{};
};

// The cost of making one Frame, in multiples of drawing one frame; for progress lines.
double framesIn(const RenderOptions& options);

}  // namespace diptych
