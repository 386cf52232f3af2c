// SPDX-License-Identifier: MIT
#include "compare/explain/channel_lighting.h"

#include "compare/explain/frame_images.h"
#include "compare/frames/frame_properties.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <algorithm>

namespace diptych {

namespace {

// clang-format off
constexpr std::string_view carried[] = {
    "path", "gbuffer", "prepass", "assign", "light-kernel", "pixel-lights", "skinning", "skin-normals",
    "spec-aa", "spec-aa-variance", "spec-aa-limit", "spec-aa-normals",
    "spec-aa-kernel", "msaa", "msaa-shading", "msaa-edges", "resolve",
    "alpha-to-coverage", "spp", "reference-mode"};
// clang-format on

// A channel of a layer that neither Frame has is 0 in both.
bool isSame(const Frame& baseline, const Frame& test, Channel mode) {
    if (layerOf(mode) != 0) {
        const bool known = baseline.channels.contains(mode);
        if (known != test.channels.contains(mode)) return false;
        if (!known) return true;
    }
    return sameBits(channelOf(baseline, mode), channelOf(test, mode));
}

}  // namespace

std::span<const std::string_view> settingsInChannels() {
    return carried;
}

ChannelLighting::ChannelLighting(Device& device, Renderer& renderer, const Frame& baseline, const Frame& test)
    : renderer_(renderer), frames_{&baseline, &test}, images_(device, baseline.settings.size) {
    for (std::size_t c = 0; c < surfaceChannels().size(); ++c) {
        const Channel mode = surfaceChannels()[c];
        const auto same = [&](Channel of) { return isSame(baseline, test, of); };
        const bool alike = same(mode) && (mode != Channel::lightmap || same(Channel::lightmapped));
        for (std::size_t side = 0; side < (alike ? 1u : 2u); ++side) images_.set(side, c, *frames_.at(side));
        if (!alike) differing_.push_back(c);
    }
}

ChannelShading& ChannelLighting::under(const Settings& requested) {
    // Uses the baseline's values for Settings that are already in the channels, so that images which
    // differ only in these share a frame.
    Settings settings = requested;
    for (const std::string_view option : carried) settings.set(option, frames_[0]->settings.valueOf(option));
    if (!shading_ || !(*settings_ == settings)) {
        shading_.reset();
        shading_.emplace(renderer_.shadeChannels(settings, images_));
        settings_ = settings;
        ++drawn_;
    }
    return *shading_;
}

Image ChannelLighting::lit(const Settings& settings, std::uint32_t sides) {
    ChannelShading& shading = under(settings);
    ++shaded_;
    return shading.shade(sides);
}

LitSurfaces ChannelLighting::surfaces(const Settings& settings, std::uint32_t sides) {
    LitSurfaces made{lit(settings, sides), shading_->terms(sides), nullptr, {}};
    const auto channel = static_cast<std::size_t>(std::ranges::find(surfaceChannels(), Channel::emission) -
                                                  surfaceChannels().begin());
    made.emission = &channelOf(*frames_.at(sides >> channel & 1u), Channel::emission);
    return made;
}

}  // namespace diptych
