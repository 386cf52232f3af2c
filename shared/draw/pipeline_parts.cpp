// SPDX-License-Identifier: MIT
#include "shared/draw/pipeline_parts.h"

#include "shared/contract/debug_mode.h"
#include "shared/contract/geometry.h"
#include "shared/contract/material.h"
#include "shared/contract/object_lights.h"
#include "shared/frame/debug_modes.h"

#include <array>
#include <cstddef>
#include <tuple>

namespace diptych {

namespace {

// The least set of inputs (shaders/lib/inputs.glsl) that has what a variant reads, of the last `sets` ones.
// Of the lights of an object only those that are shaded at vertices need one.
int inputsOf(const Variant& variant, int sets) {
    if ((variant.get(gpu::FEATURE_object_lights) & gpu::OBJECT_LIGHTS_VERTEX) != 0) return 3;
    if (variant.get(gpu::FEATURE_alpha_mask) == gpu::MASK_COVERS ||
        variant.get(gpu::FEATURE_half_shading) != 0)
        return 3;  // no others are compiled
    const int least = 4 - sets;
    for (int inputs = 3; inputs > least; --inputs)
        if (variant.any(featuresNeedingInputs(inputs))) return inputs;
    return least;
}

// Whether it needs the code of lighting: captures of channels that no light changes do not. What is no
// capture has DEBUG_lit in all of them.
bool needsLights(const Variant& variant) {
    for (gpu::uint i = 0; i < gpu::CAPTURE_ATTACHMENTS; ++i)
        if (isShaded(static_cast<int>(variant.get(gpu::FEATURE_capture_0 + i)))) return true;
    return false;
}

// Some shaders exist as several modules, because a device pays for code and inputs that a variant does not
// use: of those that draw to as many attachments the one for such alpha masks and as many samples, with the
// code of lighting and of area lights or without it, as the variant needs (a shader that lights nothing has
// none with it), and with the fewest inputs that suffice.
const ShaderModule* moduleOf(Shader shader, std::size_t attachments, const Variant& variant, int inputs) {
    const ShaderModule* best = &plainModule(shader, static_cast<std::uint32_t>(attachments));
    const bool lights = needsLights(variant), areaLights = variant.get(gpu::FEATURE_area_lights) != 0;
    const bool samples = variant.get(gpu::FEATURE_samples) != 0;
    const bool coverage = variant.get(gpu::FEATURE_alpha_mask) == gpu::MASK_COVERS;
    const bool half = variant.get(gpu::FEATURE_half_shading) != 0;
    const auto unfit = [&](const ShaderModule& module) {
        return std::tuple(module.half != half, module.coverage != coverage, module.samples != samples,
                          module.lights != lights, module.area_lights != areaLights, module.inputs);
    };
    for (const ShaderModule& module : shaderModules(shader))
        if (module.number == best->number && module.inputs >= inputs && unfit(module) < unfit(*best))
            best = &module;
    return best;
}

PipelineParts partsOf(const PipelineKey& key, int inputSets) {
    PipelineParts parts;
    const int variantInputs = inputsOf(key.variant, inputSets);
    parts.vertex = moduleOf(key.vertex, 0, key.variant, variantInputs);
    if (key.fragment != Shader::none)
        parts.fragment = moduleOf(key.fragment, key.colors.size(), key.variant, variantInputs);
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
    // What a module does not declare is not bound: with the least set of inputs that reads it, -1 always.
    struct Attribute {
        int inputs;
        VkVertexInputAttributeDescription description;
    };
    constexpr VkFormat float3 = VK_FORMAT_R32G32B32_SFLOAT, float4 = VK_FORMAT_R32G32B32A32_SFLOAT;
    constexpr std::array all{Attribute{-1, {0, 0, float3, 0}},
                             Attribute{0, {1, 1, float3, offsetof(Attributes, normal)}},
                             Attribute{2, {2, 1, float4, offsetof(Attributes, tangent)}},
                             Attribute{1, {3, 1, float4, offsetof(Attributes, texcoord0)}},
                             Attribute{3, {4, 1, float4, offsetof(Attributes, color)}},
                             Attribute{-1, {5, perDraw, float4, clip}},
                             Attribute{-1, {6, perDraw, float4, clip + column4}},
                             Attribute{-1, {7, perDraw, float4, clip + 2 * column4}},
                             Attribute{-1, {8, perDraw, float4, clip + 3 * column4}},
                             Attribute{0, {9, perDraw, float3, normal}},
                             Attribute{0, {10, perDraw, float3, normal + column3}},
                             Attribute{0, {11, perDraw, float4, normal + 2 * column3}},
                             Attribute{2, {12, perDraw, float3, world}},
                             Attribute{2, {13, perDraw, float3, world + column3}},
                             Attribute{2, {14, perDraw, float3, world + 2 * column3}},
                             Attribute{2, {15, perDraw, float3, world + 3 * column3}}};
    static_assert(all.size() <= 16);  // what every device has
    const int inputs = key.input == VERTEX_POSITIONS ? -1 : variantInputs;
    parts.bindings.assign(bindings.begin(), bindings.end());
    for (const Attribute& attribute : all)
        if (attribute.inputs <= inputs) parts.attributes.push_back(attribute.description);
    return parts;
}

}  // namespace

const ShaderModule& computeModule(Shader shader, const Variant& variant) {
    return *moduleOf(shader, 0, variant, 3);
}

ChooseParts pipelinePartsFor(const DeviceProfile& device) {
    return [sets = device.input_sets](const PipelineKey& key) { return partsOf(key, sets); };
}

}  // namespace diptych
