// SPDX-License-Identifier: MIT
#include "compare/explain/device_contributions.h"

#include "compare/explain/lighting_components.h"
#include "compare/frames/frame_properties.h"
#include "compare/metrics/channel.h"
#include "compare/render/channel_shading.h"
#include "compare/verdict/surface_grid.h"
#include "compare/verdict/surface_pixels.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace diptych {
namespace {

enum Part { edges, textures, vertices, shadows, lists, rounding, partCount };

Part partOf(const DebugMode* cause, bool textured) {
    if (!cause) return rounding;
    switch (cause->channel) {
        case Channel::position:
        case Channel::geometric_normal:
            return vertices;
        case Channel::shadow_visibility:
        case Channel::local_visibility:
            return shadows;
        case Channel::light_count:
            return lists;
        default:
            if (std::ranges::count(surfaceChannels(), cause->channel) == 0) return rounding;
            return textured ? textures : vertices;
    }
}

// The measured precision of both devices' textures, as text; empty: not measured.
std::string measured(const AcrossDevices& across) {
    const auto &a = across.devices[0].texels, &b = across.devices[1].texels;
    if (!a || !b) return {};
    double decoding = 0;
    for (std::size_t code = 1; code < 256; ++code)
        decoding =
            std::max(decoding, std::abs(double{a->srgb[code]} - double{b->srgb[code]}) / exactSrgb(code));
    return fmt::format(
        "; measured: sRGB decoding differs by up to {:.2g} %, filters round by up to {:.2g} and {:.2g} of an "
        "8-bit step",
        100 * decoding, 255 * a->linear_filter.rounding, 255 * b->linear_filter.rounding);
}

}  // namespace

std::vector<Channel> deviceContributionChannels() {
    std::vector<Channel> modes = surfacePixelChannels();
    std::ranges::copy(termChannels(), std::back_inserter(modes));
    modes.insert(modes.end(), {Channel::shadow_visibility, Channel::local_visibility, Channel::light_count});
    return modes;
}

std::vector<DeviceContribution> deviceContributions(const Explanation& explanation, const Frame& baseline,
                                                    const Frame& test, const AcrossDevices& across) {
    const Coverage covered = coverage(baseline, test);
    const Requirements needs;
    FramePair pair{baseline, test, needs, covered, true, nullptr, nullptr, &across};
    const SurfaceGrid grid(pair);
    pair.grid = &grid;
    const SurfacePixels surfaces = surfacePixels(pair);
    std::vector<double> sums(partCount);
    const auto add = [&](const std::string& cause, const Image& map) {
        const DebugMode* const mode = findDebugMode(cause);
        const auto texels = mode ? across.texels.find(mode->channel) : across.texels.end();
        for (std::size_t i = 0; i < map.pixels(); ++i) {
            const bool textured = texels != across.texels.end() && *texels->second.pixel(i) > 0;
            sums[surfaces.others[i] != 0 ? edges : partOf(mode, textured)] +=
                double{*map.pixel(i)} / static_cast<double>(map.pixels());
        }
    };
    for (const Cause& cause : explanation.causes) add(cause.name, cause.map);
    add("", explanation.unexplained_map);
    std::vector<DeviceContribution> contributions{
        {"edges",
         fmt::format("another triangle at {}, another shadow beside its boundary at {}",
                     counted(surfaces.triangles.count + surfaces.tied, "pixel"),
                     counted(surfaces.shadows.count, "pixel")),
         sums[edges]},
        {"textures", "decoding and filtering" + measured(across), sums[textures]},
        {"vertices",
         fmt::format("snapped to 1/{} and 1/{} of a pixel", 1u << across.devices[0].sub_pixel_bits,
                     1u << across.devices[1].sub_pixel_bits),
         sums[vertices]},
        {"shadow maps", "visibility of shadow-casting lights", sums[shadows]},
        {"light lists", "different lights are evaluated", sums[lists]},
        {"rounding", "shading of the same surfaces, blending and everything else", sums[rounding]}};
    std::ranges::stable_sort(contributions, std::ranges::greater(), &DeviceContribution::contribution);
    return contributions;
}

}  // namespace diptych
