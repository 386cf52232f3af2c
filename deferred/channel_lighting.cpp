// SPDX-License-Identifier: MIT
#include "deferred/channel_lighting.h"

#include "deferred/lighting_variant.h"
#include "shared/draw/background.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"
#include "shared/shadow/shadow_maps.h"
#include "shared/transparent/transparent.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace diptych {

ImageRef addChannelLighting(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                            std::shared_ptr<const DescriptorSets> channels) {
    const gpu::uint most = inputs.device.profile().packets_per_draw;
    if (inputs.longest_list > most)
        throw std::runtime_error(fmt::format(
            "lighting of channels walks {} packets of lights at most, and a list has {}; use --assign "
            "clustered or tiled, or --light-cutoff",
            most, inputs.longest_list));
    const ImageRef lit = passes.image({.name = "lit of channels", .format = litFormat});
    Pass& pass = passes.draw("shade channels").color(lit, Load::clear);
    inputs.lists.read(passes, pass);
    inputs.shadow.read(pass);
    pass.samples(depth, inFragment).depthTest(depth);
    const VkPipeline pipeline = inputs.pipelines.get(PipelineKey{.vertex = Shader::deferred_lighting_vert,
                                                                 .fragment = Shader::deferred_channels_frag,
                                                                 .variant = lightingVariant(inputs),
                                                                 .input = NO_VERTICES,
                                                                 .colors = {litFormat},
                                                                 .depth = depthFormat,
                                                                 .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL,
                                                                 .depth_write = false});
    pass.record(recordVertices(inputs, pipeline, std::move(channels), 3, 1));
    addBackground(passes, inputs, depth, lit);
    addTransparent(passes, inputs, depth, lit);
    return lit;
}

}  // namespace diptych
