// SPDX-License-Identifier: MIT
// Which embedded modules a pipeline of ours is made of, and the vertices that it reads.
#pragma once

#include "shared/vulkan/pipelines.h"

namespace diptych {

// Values of PipelineKey::input.
enum VertexFormat : std::uint32_t {
    NO_VERTICES = 0,
    VERTEX_POSITIONS = 1,  // depth alone
    VERTEX_ALL = 2,        // what the variant reads
};

// For Pipelines: modules by the variant's features and what the device pays for, vertices and draws as
// shared/contract/geometry.h has them.
ChooseParts pipelinePartsFor(const DeviceProfile& device);

// The module of a compute shader that serves the variant, as of a fragment shader's.
const ShaderModule& computeModule(Shader shader, const Variant& variant);

}  // namespace diptych
