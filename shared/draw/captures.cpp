// SPDX-License-Identifier: MIT
#include "shared/draw/captures.h"

#include "shared/contract/debug_mode.h"
#include "shared/contract/features.h"
#include "shared/frame/debug_modes.h"

#include <algorithm>
#include <string>

namespace diptych {

namespace {

VkFormat formatFor(const DebugMode& mode) {
    return mode.width == 1   ? VK_FORMAT_R32_SFLOAT
           : mode.width == 2 ? VK_FORMAT_R32G32_SFLOAT
                             : VK_FORMAT_R32G32B32A32_SFLOAT;
}

}  // namespace

void CaptureGroup::specialise(Variant& variant) const {
    for (gpu::uint i = 0; i < gpu::CAPTURE_ATTACHMENTS; ++i)
        variant.set(gpu::FEATURE_capture_0 + i,
                    i < modes.size() ? static_cast<gpu::uint>(modes[i]) : gpu::DEBUG_none);
}

std::vector<CaptureGroup> captureGroups(std::span<const int> modes, VkFormat lit, std::size_t most) {
    std::vector<int> ordered(modes.begin(), modes.end());
    std::stable_partition(ordered.begin(), ordered.end(), [](int mode) { return !isShaded(mode); });
    std::vector<CaptureGroup> groups;
    for (std::size_t i = 0; i < ordered.size(); ++i) {
        if (i % most == 0) groups.emplace_back();
        groups.back().modes.push_back(ordered[i]);
        groups.back().formats.push_back(
            ordered[i] == static_cast<int>(gpu::DEBUG_lit) ? lit : formatFor(debugMode(ordered[i])));
    }
    return groups;
}

std::vector<CapturedImage> addCaptureImages(PassList& passes, Pass& pass, const CaptureGroup& group,
                                            ImageRef lit, VkSampleCountFlagBits samples) {
    std::vector<CapturedImage> images;
    for (std::size_t i = 0; i < group.modes.size(); ++i) {
        if (lit.valid() && group.modes[i] == static_cast<int>(gpu::DEBUG_lit)) {
            pass.color(lit, Load::keep);
            images.push_back({group.modes[i], lit, passes.size() - 1});
            continue;
        }
        const ImageRef image = passes.image({.name = std::string(debugMode(group.modes[i]).name),
                                             .format = group.formats[i],
                                             .samples = samples,
                                             .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                             .life = Life::transient});
        const float background = group.modes[i] == static_cast<int>(gpu::DEBUG_material_id) ? -1.0f : 0.0f;
        pass.color(image, Load::clear, {.float32 = {background, 0, 0, 0}});
        images.push_back({group.modes[i], image, passes.size() - 1});
    }
    return images;
}

}  // namespace diptych
