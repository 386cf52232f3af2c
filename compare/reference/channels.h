// SPDX-License-Identifier: MIT
// Channels of a pixel, and surfaces from captured channels.
#pragma once

#include "compare/reference/pixel.h"
#include "compare/reference/pixel_rays.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/channel.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <cstddef>
#include <map>
#include <vector>

namespace diptych::reference {

// The part of ReferenceImage::rounding that belongs to a channel, from the four components of a pixel, W/(sr
// m^2); 0 if the channel is no light.
double roundingOf(Channel channel, const float* rounding);

// The components of a channel (shared/contract/debug_mode.h).
glm::dvec3 channelValue(Channel channel, const Pixel& pixel);

// Decodes surfaces from a path's captured channels. Without the channels of a layer (layerOf() of
// shared/frame/debug_modes.h) no surface has it.
class Captured {
public:
    Captured(const std::map<Channel, Image>& channels, const std::vector<Material>& materials)
        : channels_(channels), materials_(materials) {}

    bool isSurface(std::size_t pixel) const { return value(Channel::material_id, pixel).x >= 0; }
    double depth(std::size_t pixel) const { return value(Channel::depth, pixel).x; }
    int material(std::size_t pixel) const { return static_cast<int>(value(Channel::material_id, pixel).x); }
    Surface surface(std::size_t pixel, const PixelRays& rays, int material) const;

private:
    bool isCaptured(Channel channel) const { return channels_.contains(channel); }
    glm::dvec3 value(Channel channel, std::size_t pixel) const;

    const std::map<Channel, Image>& channels_;
    const std::vector<Material>& materials_;
};

}  // namespace diptych::reference
