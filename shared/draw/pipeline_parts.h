// SPDX-License-Identifier: MIT
// Vertex input of pipelines.
#pragma once

#include "shared/vulkan/pipelines/pipelines.h"

namespace diptych {

// Values of PipelineKey::input.
enum VertexFormat : std::uint32_t {
    NO_VERTICES = 0,
    VERTEX_ALL = 1,  // every attribute; the variant selects what shaders read
};

// For Pipelines: all vertex and draw attributes of shared/contract/geometry.h.
PipelineParts drawingParts(const PipelineKey& key);

}  // namespace diptych
