// SPDX-License-Identifier: MIT
#include "shared/draw/pipeline_parts.h"

#include "shared/contract/geometry.h"

#include <array>
#include <cstddef>

namespace diptych {

PipelineParts drawingParts(const PipelineKey& key) {
    PipelineParts parts = plainParts(key);
    if (key.input == NO_VERTICES) return parts;
    using Attributes = gpu::VertexAttributes;
    using Draw = gpu::Draw;
    constexpr std::uint32_t perDraw = 2;
    constexpr std::array bindings{
        VkVertexInputBindingDescription{0, sizeof(gpu::vec3), VK_VERTEX_INPUT_RATE_VERTEX},
        VkVertexInputBindingDescription{perDraw, sizeof(Draw), VK_VERTEX_INPUT_RATE_INSTANCE},
        VkVertexInputBindingDescription{1, sizeof(Attributes), VK_VERTEX_INPUT_RATE_VERTEX}};
    constexpr std::uint32_t clip = offsetof(Draw, clip_from_object),
                            world = offsetof(Draw, world_from_object),
                            normal = offsetof(Draw, normal_from_object), column3 = sizeof(gpu::vec3),
                            column4 = sizeof(gpu::vec4);
    static_assert(offsetof(Draw, handedness) == normal + 3 * column3);
    static_assert(offsetof(Attributes, texcoord1) == offsetof(Attributes, texcoord0) + sizeof(gpu::vec2));
    constexpr VkFormat float3 = VK_FORMAT_R32G32B32_SFLOAT, float4 = VK_FORMAT_R32G32B32A32_SFLOAT;
    constexpr std::array all{VkVertexInputAttributeDescription{0, 0, float3, 0},
                             VkVertexInputAttributeDescription{1, 1, float3, offsetof(Attributes, normal)},
                             VkVertexInputAttributeDescription{2, 1, float4, offsetof(Attributes, tangent)},
                             VkVertexInputAttributeDescription{3, 1, float4, offsetof(Attributes, texcoord0)},
                             VkVertexInputAttributeDescription{4, 1, float4, offsetof(Attributes, color)},
                             VkVertexInputAttributeDescription{5, perDraw, float4, clip},
                             VkVertexInputAttributeDescription{6, perDraw, float4, clip + column4},
                             VkVertexInputAttributeDescription{7, perDraw, float4, clip + 2 * column4},
                             VkVertexInputAttributeDescription{8, perDraw, float4, clip + 3 * column4},
                             VkVertexInputAttributeDescription{9, perDraw, float3, normal},
                             VkVertexInputAttributeDescription{10, perDraw, float3, normal + column3},
                             VkVertexInputAttributeDescription{11, perDraw, float4, normal + 2 * column3},
                             VkVertexInputAttributeDescription{12, perDraw, float3, world},
                             VkVertexInputAttributeDescription{13, perDraw, float3, world + column3},
                             VkVertexInputAttributeDescription{14, perDraw, float3, world + 2 * column3},
                             VkVertexInputAttributeDescription{15, perDraw, float3, world + 3 * column3}};
    static_assert(all.size() <= 16);  // maxVertexInputAttributes of every device
    parts.bindings.assign(bindings.begin(), bindings.end());
    parts.attributes.assign(all.begin(), all.end());
    return parts;
}

}  // namespace diptych
