// SPDX-License-Identifier: MIT
// Haze of one view: what shaders read of shared/contract/haze.h, on the device. README.md has the model.
#pragma once

#include "shared/contract/haze.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/resources.h"
#include "shared/vulkan/variant.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace diptych {

// The numbers of --haze, and the feature, a sum of HAZE_*: 0 where it is off, its density 0 or nothing is
// scattered. `sun`: the directional light that it scatters, or nullptr; one that is not above the horizon
// gives nothing. `eye`: of the camera, world, m.
struct HazeNumbers {
    gpu::uint feature = 0;
    gpu::Haze haze{};
    gpu::HazeMarch march{};  // of HAZE_MARCHED
};
HazeNumbers hazeNumbers(const Settings& settings, const Light* sun, const glm::dvec3& eye);

class Haze {
public:
    // `frame`: the sets of SET_FRAME, to which it writes its binding where there is any haze.
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
