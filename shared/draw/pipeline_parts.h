// SPDX-License-Identifier: MIT
// The vertices that a pipeline reads.
#pragma once

#include "shared/vulkan/pipelines.h"

namespace diptych {

// Values of PipelineKey::input.
enum VertexFormat : std::uint32_t {
    NO_VERTICES = 0,
    VERTEX_ALL = 1,  // what the variant reads
};

// For Pipelines: vertices and draws as shared/contract/geometry.h has them, all that they hold.
PipelineParts drawingParts(const PipelineKey& key);

}  // namespace diptych
