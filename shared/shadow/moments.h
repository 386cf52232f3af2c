// SPDX-License-Identifier: MIT
// Moments of the sun's shadow maps: their format, and the passes that make and blur them.
#pragma once

#include "shared/contract/shadow.h"
#include "shared/frame/settings.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/pass_list.h"
#include "shared/vulkan/pipelines.h"

#include <string>

namespace diptych {

// Whether --shadows is one of those that filter moments.
bool hasMoments(Shadows shadows);

// What a device can do with formats of moments.
struct MomentSupport {
    bool filters32 = false;  // stores RG32F and RGBA32F from shaders and filters them linearly
    bool shares16 = false;   // stores RGBA16 unorm from shaders and filters it linearly
};
MomentSupport momentSupport(const Device& device);

// In what moments are stored.
struct MomentFormat {
    VkFormat format = VK_FORMAT_R32G32_SFLOAT;
    bool half = false;    // floats of 16 bits
    double bias = 0;      // of msm4: ShadowLight::moment_bias, which hides what the format rounds
    std::string because;  // in words, where it is not what was asked for or was left to the program
};
// Of `shadows`, one of hasMoments(). `asked` is for warped depth alone.
MomentFormat momentFormat(Shadows shadows, EvsmPrecision asked, const MomentSupport& device);

// The largest exponent whose second moment the format holds: half the logarithm of its largest number, 44.36
// or 5.54.
double largestExponent(bool half);

class MomentMaps {
public:
    // What the moments are made of.
    struct Request {
        MomentFormat format;
        Variant variant{};  // the features shadows and shadow_kernel
        float exponent = 40, negative = 5, nearest = 0;
    };

    explicit MomentMaps(Device& device);

    // Adds, for every layer of `depth` (`size` texels wide and high), a pass of its moments and, where the
    // kernel is wider than a texel, two that blur them through one layer of scratch. Returns the moments.
    ImageRef addPasses(PassList& passes, Pipelines& pipelines, ImageRef depth, std::uint32_t size,
                       std::uint32_t layers, const Request& request);

private:
    OwnedDescriptorSetLayout layout_;
    OwnedPipelineLayout pipeline_layout_;
    OwnedSampler sampler_;
    DescriptorSets sets_;  // of each layer: depth to moments, moments to scratch, scratch to moments
};

}  // namespace diptych
