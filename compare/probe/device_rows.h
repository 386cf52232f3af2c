// SPDX-License-Identifier: MIT
// Runs the shaders of compare/probe/shaders on rows of inputs.
#pragma once

#include "compare/probe/probe.h"
#include "shared/vulkan/descriptors.h"

#include <vector>

namespace diptych::probe {

class DeviceRows {
public:
    explicit DeviceRows(Device& device);

    // As many rows of outputs as `in` has rows. A probe without a shader is run on the host.
    std::vector<float> run(const Probe& probe, const std::vector<float>& in);

private:
    Device& device_;
    OwnedDescriptorSetLayout set_;
    OwnedPipelineLayout layout_;
};

}  // namespace diptych::probe
