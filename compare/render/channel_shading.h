// SPDX-License-Identifier: MIT
// Shades surfaces made from channels of two Frames, each channel taken from either, with the lighting code
// that both paths share.
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

// The channels of two Frames on the device. A channel that is equal in both is stored once.
class SurfaceImages {
public:
    SurfaceImages(Device& device, const Size& size);
    SurfaceImages(SurfaceImages&&) noexcept;
    ~SurfaceImages();

    // Image `side` (0, 1) of channel index `channel` in surfaceChannels(). Includes the other inputs that
    // lighting reads of the Frame (SURFACE_CHANNELS): lightmapped beside lightmap. Throws std::logic_error
    // if the Frame lacks one.
    void set(std::size_t side, std::size_t channel, const Frame& frame);

private:
    friend class ChannelShading;
    struct State;
    std::unique_ptr<State> state_;
};

// The terms of lit of opaque surfaces: ((diffuse + specular + ambient) + emission) transmittance + haze. W
// x H x 3 each, 0 in the background.
struct ChannelTerms {
    Image diffuse, specular, ambient, haze, transmittance;
    Image environment;                          // included in diffuse and specular
    Image shadow_visibility, local_visibility;  // W x H x 1
};

// Direct light of one light, before haze: W x H x 3 each.
struct LightChannels {
    Image diffuse, specular;
};

// One view under one Settings. The constructor's arguments must outlive it.
class ChannelShading {
public:
    // Uses the Settings of lighting, background and blended surfaces, without MSAA. Renders the deferred
    // frame once, for depth, light lists and shadows. Throws std::runtime_error with a one-line message.
    ChannelShading(Device& device, SharedResources& shared, const SceneView& view, const Settings& settings,
                   const SurfaceImages& images);
    ChannelShading(ChannelShading&&) noexcept;
    ~ChannelShading();

    // lit, W x H x 3. Bit i of `sides` selects the Frame of channel i.
    Image shade(std::uint32_t sides);
    // The terms of the same image, before blending.
    ChannelTerms terms(std::uint32_t sides);
    // The part of these terms that one light adds: all others are black, but shadow maps and light lists
    // are the full image's. `index`: index in lights().
    LightChannels light(std::uint32_t sides, std::size_t index);
    // The lights of the view (SceneView::lights).
    const std::vector<Light>& lights() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych
