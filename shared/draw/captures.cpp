// SPDX-License-Identifier: MIT
#include "shared/draw/captures.h"

#include "shared/contract/debug_mode.h"
#include "shared/contract/features.h"
#include "shared/frame/debug_modes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>
#include <string>

namespace diptych {

namespace {

struct Placed {
    Channel mode;
    CaptureIndex index;
};
constexpr std::array capture_indices{
#define DIPTYCH_CAPTURE(name, image, component, value) Placed{Channel::name, {image, component}},
    CAPTURES(DIPTYCH_CAPTURE)
#undef DIPTYCH_CAPTURE
};
static_assert(capture_indices.back().index.image + 1 == gpu::CAPTURE_IMAGES);

}  // namespace

CaptureIndex captureIndex(Channel mode) {
    const auto found = std::ranges::find(capture_indices, mode, &Placed::mode);
    if (found == capture_indices.end())
        throw std::out_of_range("no capture of debug mode " + std::to_string(channelIndex(mode)));
    return found->index;
}

std::vector<CaptureGroup> captureGroups(std::span<const Channel> modes, VkFormat lit, std::size_t max) {
    gpu::uint images = 0;
    for (const Channel mode : modes) images |= 1u << captureIndex(mode).image;
    const auto lit_images = static_cast<std::size_t>(std::popcount(images >> gpu::FIRST_LIT_IMAGE));
    const bool unlit = std::ranges::none_of(modes, [](Channel mode) {
        return captureIndex(mode).image >= gpu::FIRST_LIT_IMAGE && mode != Channel::shadow_visibility;
    });
    std::vector<CaptureGroup> groups;
    for (const auto& [mode, index] : capture_indices) {
        if (std::ranges::find(modes, mode) == modes.end()) continue;
        const gpu::uint bit = 1u << index.image;
        // Number of images that must go into one pass: one, or all lit images at the first of them.
        const bool first_lit = (images & (bit - 1)) >> gpu::FIRST_LIT_IMAGE == 0;
        const std::size_t together =
            index.image >= gpu::FIRST_LIT_IMAGE && first_lit ? std::min(lit_images, max) : 1;
        if (groups.empty() ||
            ((groups.back().images & bit) == 0 && groups.back().formats.size() + together > max))
            groups.emplace_back();
        CaptureGroup& group = groups.back();
        group.modes.push_back(mode);
        if ((group.images & bit) != 0) continue;
        group.images |= bit;
        group.unlit = unlit && index.image >= gpu::FIRST_LIT_IMAGE;
        group.formats.push_back(mode == Channel::lit ? lit : VK_FORMAT_R32G32B32A32_SFLOAT);
    }
    return groups;
}

std::vector<CapturedImage> addCaptureImages(PassList& passes, Pass& pass, const CaptureGroup& group,
                                            ImageRef lit, VkSampleCountFlagBits samples,
                                            std::span<const Channel> every_sample) {
    std::vector<CapturedImage> images;
    std::size_t next = 0;
    for (gpu::uint i = 0; i < gpu::CAPTURE_IMAGES; ++i) {
        if ((group.images >> i & 1) == 0) continue;
        std::vector<Channel> modes;
        std::string name;
        for (const Channel mode : group.modes) {
            if (captureIndex(mode).image != i) continue;
            name += (modes.empty() ? "" : ", ") + std::string(debugMode(mode).name);
            modes.push_back(mode);
        }
        const VkFormat format = group.formats.at(next++);
        const bool goes_on = lit.valid() && modes.front() == Channel::lit;
        const ImageRef image = goes_on ? lit
                                       : passes.image({.name = name,
                                                       .format = format,
                                                       .samples = samples,
                                                       .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                                       .life = Life::transient});
        if (goes_on) {
            pass.color(image, Load::keep);
        } else {
            const auto [of, component] = captureIndex(Channel::material_id);
            VkClearColorValue background{};
            if (of == i) background.float32[component] = -1;
            pass.color(image, Load::clear, background);
        }
        for (const Channel mode : modes) {
            images.push_back(
                {mode, image, static_cast<int>(captureIndex(mode).component), passes.size() - 1});
            images.back().every_sample = std::ranges::count(every_sample, mode) > 0;
        }
    }
    return images;
}

}  // namespace diptych
