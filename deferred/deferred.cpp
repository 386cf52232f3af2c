// SPDX-License-Identifier: MIT
#include "deferred/deferred.h"

#include "shared/contract/bindings.h"
#include "shared/vulkan/check.h"

#include <fmt/format.h>

#include <array>
#include <memory>

namespace diptych {

namespace {

struct GBuffer {
    std::array<ImageRef, gpu::GBUFFER_ATTACHMENTS> attachments;  // invalid: the layout has none
    ImageRef depth;
    // Owned by the passes that read it.
    std::shared_ptr<OwnedSampler> sampler;
    std::shared_ptr<DescriptorSets> sets;
};

OwnedSampler nearestSampler(Device& device) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    VkSampler sampler = VK_NULL_HANDLE;
    check(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    return {device.handle(), sampler};
}

PipelineKey gbufferKey(const FrameInputs& inputs, const DrawItem& item) {
    std::vector<VkFormat> formats;
    for (const VkFormat format : inputs.gbuffer.formats)
        if (format != VK_FORMAT_UNDEFINED) formats.push_back(format);
    PipelineKey key{.vertex = "surface.vert",
                    .fragment = fmt::format("gbuffer.frag.{}", formats.size()),
                    .variant = item.variant,
                    .input = VertexInput::all,
                    .colors = formats,
                    .depth = depthFormat,
                    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
                    .depth_write = true};
    for (const gpu::uint feature :
         {gpu::FEATURE_emission, gpu::FEATURE_dielectric_specular, gpu::FEATURE_orthographic})
        key.variant.set(feature, inputs.variant.get(feature));
    inputs.gbuffer.specialise(key.variant);
    return key;
}

GBuffer addGBuffer(PassList& passes, const FrameInputs& inputs) {
    GBuffer g;
    g.depth = passes.image("depth", depthFormat);
    Pass& pass = passes.draw("G-buffer").depth(g.depth, Load::clear);
    for (std::size_t i = 0; i < g.attachments.size(); ++i) {
        const VkFormat format = inputs.gbuffer.formats[i];
        if (format == VK_FORMAT_UNDEFINED) continue;
        g.attachments[i] = passes.image(gbufferAttachmentNames[i], format);
        pass.color(g.attachments[i], Load::clear);
    }
    pass.record(recordDraws(
        inputs, [&](const DrawItem& item) { return inputs.pipelines.get(gbufferKey(inputs, item)); }));

    std::array<VkDescriptorType, gpu::GBUFFER_ATTACHMENTS + 1> types;
    types.fill(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    g.sampler = std::make_shared<OwnedSampler>(nearestSampler(inputs.device));
    g.sets = std::make_shared<DescriptorSets>(inputs.device, inputs.layouts.gbuffer, types, 1);
    for (std::uint32_t i = 0; i < g.attachments.size(); ++i) {
        // An attachment that is not there is never read; albedo, of the same kind, keeps its binding valid.
        const ImageRef image =
            g.attachments[i].valid() ? g.attachments[i] : g.attachments[gpu::GBUFFER_ALBEDO];
        g.sets->image(0, i, passes.view(image), *g.sampler, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    g.sets->image(0, gpu::BINDING_DEPTH, passes.view(g.depth), *g.sampler,
                  VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    return g;
}

// A full-screen pass over what the G-buffer holds: the triangle lies at the far end of depth, and LESS
// skips every pixel that nothing was drawn to before it is shaded.
void addResolve(Pass& pass, const FrameInputs& inputs, const GBuffer& g, const std::string& fragment,
                const Variant& variant, const std::vector<VkFormat>& colors) {
    for (const ImageRef image : g.attachments)
        if (image.valid()) pass.samples(image);
    pass.samples(g.depth).depthTest(g.depth);
    const VkPipeline pipeline = inputs.pipelines.get({.vertex = "full_screen.vert",
                                                      .fragment = fragment,
                                                      .variant = variant,
                                                      .input = VertexInput::none,
                                                      .colors = colors,
                                                      .depth = depthFormat,
                                                      .depth_compare = VK_COMPARE_OP_LESS,
                                                      .depth_write = false});
    pass.record([&inputs, pipeline, sampler = g.sampler, sets = g.sets](VkCommandBuffer commands) {
        recordFullScreen(commands, inputs, pipeline, (*sets)[0]);
    });
}

}  // namespace

FrameImages addDeferred(PassList& passes, const FrameInputs& inputs) {
    const GBuffer g = addGBuffer(passes, inputs);
    const ImageRef lit = passes.image("lit", litFormat);
    Pass& shade = passes.draw("shade").color(lit, Load::clear);
    addResolve(shade, inputs, g, "deferred_shade.frag", inputs.variant, {litFormat});
    return {lit, g.depth};
}

std::vector<CapturedImage> addDeferredCapture(PassList& passes, const FrameInputs& inputs,
                                              std::span<const int> modes) {
    std::vector<CapturedImage> images;
    const GBuffer g = addGBuffer(passes, inputs);
    for (const CaptureGroup& group : captureGroups(modes)) {
        Pass& pass = passes.draw("capture");
        for (const CapturedImage& image : addCaptureImages(passes, pass, group)) images.push_back(image);
        Variant variant = inputs.variant;
        group.specialise(variant);
        addResolve(pass, inputs, g, fmt::format("deferred_capture.frag.{}", group.modes.size()), variant,
                   group.formats);
    }
    return images;
}

}  // namespace diptych
