// SPDX-License-Identifier: MIT
// Prepared frames of an experiment's rows, which are evaluated once and timed several times.
#pragma once

#include "compare/render/renderer.h"

#include <cstddef>
#include <cstdint>
#include <list>
#include <span>
#include <vector>

namespace diptych::experiment {

// lit of a frame, and its bytes.
struct Shot {
    Settings settings;
    Image lit;
    FrameBytes bytes;
};

// Keeps the latest frames, up to `maxBytes` of their images and buffers: about four at 640x360. Others are
// prepared again. Keeps more shots than frames.
class PreparedPool {
public:
    static constexpr std::uint64_t maxBytes = std::uint64_t{352} << 20;
    static constexpr std::size_t maxShots = 16;

    // The renderer must outlive the object.
    explicit PreparedPool(Renderer& renderer) : renderer_(renderer) {}

    // One frame of these Settings, camera included, drawn at least once: the first may take longer than the
    // next. Valid until the next call.
    PreparedFrames& frame(const Settings& settings);
    // Its first frame. Valid until the next call.
    const Shot& shot(const Settings& settings);
    // Draws frames[order[i]] for each i; returns the times, ms.
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order);
    void clear() {
        latest_.clear();
        shots_.clear();
    }

private:
    struct Prepared {
        Settings settings;
        PreparedFrames frames;
        std::uint64_t bytes;
    };
    void keep(std::uint64_t max);  // the latest, up to `max` bytes; at least one

    Renderer& renderer_;
    std::list<Prepared> latest_;  // the latest last
    std::list<Shot> shots_;       // the latest last
};

}  // namespace diptych::experiment
