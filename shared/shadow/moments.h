// SPDX-License-Identifier: MIT
// Moments of the sun's shadow maps: format, and passes that generate and blur them.
#pragma once

#include "shared/contract/shadow.h"
#include "shared/frame/settings.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <string>

namespace diptych {

// Whether the shadow technique filters moments.
bool hasMoments(Shadows shadows);

// Support for moment formats.
struct MomentSupport {
    bool filters32 = false;  // storage without format and linear filtering of RG32F and RGBA32F
    bool shares16 = false;   // storage without format and linear filtering of RGBA16 unorm
};
MomentSupport momentSupport(const Device& device);

// Storage format of moments.
struct MomentFormat {
    VkFormat format = VK_FORMAT_R32G32_SFLOAT;
    bool half = false;    // 16-bit floats
    double bias = 0;      // for msm4: ShadowLight::moment_bias, which compensates the format's rounding
    std::string because;  // reason, if the format differs from the request or was chosen automatically
};
// `shadows`: one of hasMoments(). `asked` applies to warped depth alone.
MomentFormat momentFormat(Shadows shadows, EvsmPrecision asked, const MomentSupport& device);

// Largest exponent whose second moment the format can represent: half the logarithm of its largest number,
// 44.36 or 5.54.
double largestExponent(bool half);

class MomentMaps {
public:
    // Inputs of the moments.
    struct Request {
        MomentFormat format;
        Variant variant{};  // features shadows and shadow_kernel
        float exponent = 40, negative = 5, nearest = 0;
    };

    explicit MomentMaps(Device& device);

    // Adds, for each layer of `depth` (`size` x `size` texels), a pass that computes its moments and, for
    // kernels wider than a texel, two passes that blur them through a scratch layer. Returns the moments.
    ImageRef addPasses(PassList& passes, Pipelines& pipelines, ImageRef depth, std::uint32_t size,
                       std::uint32_t layers, const Request& request);

private:
    void record(Pass& pass, const Pipeline& pipeline, std::uint32_t set,
                const gpu::MomentConstants& constants, VkExtent2D threads);

    OwnedDescriptorSetLayout layout_;
    OwnedPipelineLayout pipeline_layout_;
    OwnedSampler sampler_;
    DescriptorSets sets_;  // per layer: depth to moments, moments to scratch, scratch to moments
};

}  // namespace diptych
