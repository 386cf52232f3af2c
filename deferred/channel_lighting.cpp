// SPDX-License-Identifier: MIT
#include "deferred/channel_lighting.h"

#include "deferred/lighting_variant.h"
#include "shared/draw/background.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"
#include "shared/shadow/shadow_maps.h"
#include "shared/transparent/transparent.h"

#include <fmt/format.h>

#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace diptych {

namespace {

struct ChannelDraw {
    const char* name;
    Shader fragment;
    std::span<const ImageRef> targets;
    VkFormat format;  // of all targets
};

// Shades channels into targets, cleared to 0.
void addShading(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                std::shared_ptr<const DescriptorSets> channels, const ChannelDraw& draw) {
    const gpu::uint max = inputs.entries_per_draw;
    if (inputs.longest_list > max)
        throw std::runtime_error(
            fmt::format("relighting from channels reads up to {} light list entries, but a list has {}; use "
                        "--assign clustered or tiled, or --light-cutoff",
                        max, inputs.longest_list));
    Pass& pass = passes.draw(draw.name);
    for (const ImageRef target : draw.targets) pass.color(target, Load::clear);
    inputs.lists.read(passes, pass);
    inputs.shadow.read(pass);
    pass.samples(depth, inFragment).depthTest(depth);
    const Pipeline pipeline = inputs.pipelines.get(
        inputs.depth.stored({.vertex = Shader::deferred_lighting_vert,
                             .fragment = draw.fragment,
                             .variant = lightingVariant(inputs),
                             .input = NO_VERTICES,
                             .colors = std::vector<VkFormat>(draw.targets.size(), draw.format),
                             .depth = depthFormat,
                             .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL,
                             .depth_write = false}));
    pass.record(recordVertices(inputs, pipeline, std::move(channels), 3, 1));
}

}  // namespace

ImageRef addChannelLighting(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                            std::shared_ptr<const DescriptorSets> channels) {
    const ImageRef lit = passes.image({.name = "lit of channels", .format = inputs.lit_format});
    addShading(passes, inputs, depth, std::move(channels),
               {"shade channels", Shader::deferred_channels_frag, std::span(&lit, 1), inputs.lit_format});
    addBackground(passes, inputs, depth, lit);
    addTransparent(passes, inputs, depth, lit);
    return lit;
}

std::array<ImageRef, 6> addChannelTerms(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                                        std::shared_ptr<const DescriptorSets> channels) {
    std::array<ImageRef, 6> terms;
    for (ImageRef& term : terms) term = passes.image({.name = "term of channels", .format = litFormat});
    addShading(passes, inputs, depth, std::move(channels),
               {"shade terms of channels", Shader::deferred_channel_terms_frag, terms, litFormat});
    return terms;
}

}  // namespace diptych
