// SPDX-License-Identifier: MIT
// Runs the shaders of compare/probe/shaders on rows of inputs.
#pragma once

#include "compare/probe/probe.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <vector>

namespace diptych::probe {

class DeviceRows {
public:
    explicit DeviceRows(Device& device);

    // Returns one row of outputs for each row of `in`. A probe without a shader runs on the host.
    std::vector<float> run(const Probe& probe, const std::vector<float>& in);

private:
    Device& device_;
    OwnedDescriptorSetLayout set_;
    OwnedPipelineLayout layout_;
};

}  // namespace diptych::probe
