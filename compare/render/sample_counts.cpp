// SPDX-License-Identifier: MIT
#include "compare/render/sample_counts.h"

#include "shared/draw/frame_inputs.h"

#include <algorithm>
#include <string>

namespace diptych {
std::vector<int> sampleCounts(const Device& device) {
    std::vector<int> counts{1};
    VkSampleCountFlags all = ~VkSampleCountFlags{0};
    // The formats of G-buffer words in every encoding.
    for (const VkFormat format :
         {litFormat, depthFormat, VK_FORMAT_R32_UINT, VK_FORMAT_R32G32_UINT, VK_FORMAT_R32G32B32A32_UINT})
        all &= device.support().sampleCounts(
            format,
            VK_IMAGE_USAGE_SAMPLED_BIT | (format == depthFormat ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                                : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT));
    for (const int samples : {4, 8})
        if ((all & static_cast<VkSampleCountFlags>(samples)) != 0) counts.push_back(samples);
    return counts;
}

Settings withSamples(const Settings& settings, int samples) {
    static const Settings defaults;
    Settings several = settings, result = settings;
    several.msaa = 4;
    result.msaa = samples;
    for (const Field& field : settingFields()) {
        const auto unless = field.default_only.unless;
        if (unless && unless(several) && !unless(result))
            result.set(field.option, defaults.valueOf(field.option));
    }
    return result;
}

}  // namespace diptych
