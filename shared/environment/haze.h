// SPDX-License-Identifier: MIT
// Haze of one view as shared/contract/haze.h stores it, on the GPU. README.md describes the model.
#pragma once

#include "shared/contract/haze.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/spirv/variant.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace diptych {

// Parameters of --haze, and the feature, a sum of HAZE_*. The feature is 0 if haze is off, has density 0,
// or does not scatter. `sun`: directional light that it scatters, or nullptr; it has no effect unless
// above the horizon. `eye`: the camera, world, m.
struct HazeNumbers {
    gpu::uint feature = 0;
    gpu::Haze haze{};
    gpu::HazeMarch march{};  // for HAZE_MARCHED
};
HazeNumbers hazeNumbers(const Settings& settings, const Light* sun, const glm::dvec3& eye);

class Haze {
public:
    // `frame`: SET_FRAME, in which it writes its binding if there is haze.
    Haze(Device& device, Uploader& uploader, const Settings& settings, const Light* sun,
         const glm::dvec3& eye, DescriptorSets& frame);
    void specialise(Variant& variant) const { variant.set(gpu::FEATURE_haze, feature_); }
    std::uint64_t bytes() const { return texels_.size(); }

private:
    gpu::uint feature_ = 0;
    GpuBuffer texels_;
    OwnedBufferView texels_view_;
};

}  // namespace diptych
