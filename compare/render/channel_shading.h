// SPDX-License-Identifier: MIT
// Shades surfaces that are made of channels of two Frames, each channel of either, by the lighting that both
// paths share.
#pragma once

#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/scene_view.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace diptych {

class Device;
struct SharedResources;

// Debug modes of the channels that make a surface (SURFACE_CHANNELS), in the order of the bits below.
std::span<const int> surfaceChannels();

// The channels of two Frames on the device. A channel that both have alike is there once.
class SurfaceImages {
public:
    SurfaceImages(Device& device, const Size& size);
    SurfaceImages(SurfaceImages&&) noexcept;
    ~SurfaceImages();

    // Image `side` (0, 1) of channel number `channel` of surfaceChannels().
    // With it what else lighting reads of the Frame (SURFACE_CHANNELS): lightmapped beside lightmap.
    // Throws std::logic_error where the Frame lacks one.
    void set(std::size_t side, std::size_t channel, const Frame& frame);

private:
    friend class ChannelShading;
    struct State;
    std::unique_ptr<State> state_;
};

// What lit of opaque surfaces is the sum of: ((diffuse + specular + ambient) + emission) transmittance +
// haze. W x H x 3 each, 0 in the background.
struct ChannelTerms {
    Image diffuse, specular, ambient, haze, transmittance;
    Image environment;  // a part of diffuse and specular
};

// Direct light of one light, before any haze: W x H x 3 each.
struct LightChannels {
    Image diffuse, specular;
};

// One view under one Settings. What it is made of must outlive it.
class ChannelShading {
public:
    // Of Settings what lights surfaces, lies behind them and is blended over them matters, with one sample a
    // pixel. Draws the deferred frame once, for depth, light lists and shadows. Throws std::runtime_error,
    // one line.
    ChannelShading(Device& device, SharedResources& shared, const SceneView& view, const Settings& settings,
                   const SurfaceImages& images);
    ChannelShading(ChannelShading&&) noexcept;
    ~ChannelShading();

    // lit, W x H x 3. Bit i of `sides`: of which side channel i is.
    Image shade(std::uint32_t sides);
    // The terms of the same, before anything is blended.
    ChannelTerms terms(std::uint32_t sides);
    // Of these, what one light adds: all others are black, and shadow maps and lists are those of the whole
    // picture. `place`: in lights().
    LightChannels light(std::uint32_t sides, std::size_t place);
    // The lights of the view, those of SceneView::lights.
    const std::vector<Light>& lights() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych
