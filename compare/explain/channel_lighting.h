// SPDX-License-Identifier: MIT
// Our lighting of the surfaces that two Frames' channels make, under any Settings and with each channel of
// either side. A frame is drawn only where Settings light otherwise than the last ones.
#pragma once

#include "compare/explain/lighting_stages.h"
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

// Settings that are no cause of their own: what they change is in the channels, in the rest, or in no pixel.
std::span<const std::string_view> settingsInChannels();

// The bits of ChannelShading::shade() that take every channel from one side: 0, the baseline, or 1, the test.
constexpr std::uint32_t allChannelsOf(std::size_t side) {
    return side == 0 ? 0u : ~0u;
}

// What it is made of must outlive it.
class ChannelLighting {
public:
    // Uploads the channels of both, which are of one size. Throws std::runtime_error, one line, where a
    // Frame lacks one.
    ChannelLighting(Device& device, Renderer& renderer, const Frame& baseline, const Frame& test);

    // Places in surfaceChannels() of those that the Frames differ in, by a bit; ascending.
    const std::vector<std::size_t>& differing() const { return differing_; }

    // Lighting under Settings; until it is asked for under others.
    ChannelShading& under(const Settings& settings);
    // lit of surfaces under Settings, W x H x 3. `sides`: as of ChannelShading::shade().
    Image lit(const Settings& settings, std::uint32_t sides);
    // The same with its terms and what the surfaces emit; without LitSurfaces::unblended.
    LitSurfaces surfaces(const Settings& settings, std::uint32_t sides);

    std::size_t shaded() const { return shaded_; }  // pictures that lit() and surfaces() have made
    std::size_t drawn() const { return drawn_; }    // frames

private:
    Renderer& renderer_;
    const std::array<const Frame*, 2> frames_;  // baseline, test
    SurfaceImages images_;
    std::vector<std::size_t> differing_;
    std::optional<ChannelShading> shading_;
    std::optional<Settings> settings_;  // those of shading_
    std::size_t shaded_ = 0, drawn_ = 0;
};

}  // namespace diptych
