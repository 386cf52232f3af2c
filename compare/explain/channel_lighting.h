// SPDX-License-Identifier: MIT
// Relights the surfaces of two Frames' channels under any Settings, with each channel from either side.
// Renders a frame only if the lighting Settings differ from the last ones.
#pragma once

#include "compare/explain/lighting_components.h"
#include "compare/render/channel_shading.h"
#include "compare/render/renderer.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace diptych {

// Settings that are not causes: they affect only channels, the residual, or no pixel.
std::span<const std::string_view> settingsInChannels();

// Bits for ChannelShading::shade() that take every channel from one side: 0, the baseline, or 1, the test.
constexpr std::uint32_t allChannelsOf(std::size_t side) {
    return side == 0 ? 0u : ~0u;
}

// All constructor arguments must outlive it.
class ChannelLighting {
public:
    // Uploads the channels of both Frames, which must have one size. A missing channel of a layer is 0.
    // Throws std::runtime_error, one line, if another is missing.
    ChannelLighting(Device& device, Renderer& renderer, const Frame& baseline, const Frame& test);

    // Indices into surfaceChannels() of the channels that differ in any bit; ascending.
    const std::vector<std::size_t>& differing() const { return differing_; }

    // Lighting under Settings; valid until the next call with others.
    ChannelShading& under(const Settings& settings);
    // lit of the surfaces under Settings, W x H x 3. `sides`: as for ChannelShading::shade().
    Image lit(const Settings& settings, std::uint32_t sides);
    // The same with its terms and the surfaces' emission; without LitSurfaces::unblended.
    LitSurfaces surfaces(const Settings& settings, std::uint32_t sides);

    std::size_t shaded() const { return shaded_; }  // images made by lit() and surfaces()
    std::size_t drawn() const { return drawn_; }    // rendered frames

private:
    Renderer& renderer_;
    const std::array<const Frame*, 2> frames_;  // baseline, test
    SurfaceImages images_;
    std::vector<std::size_t> differing_;
    std::optional<ChannelShading> shading_;
    std::optional<Settings> settings_;  // of shading_
    std::size_t shaded_ = 0, drawn_ = 0;
};

}  // namespace diptych
