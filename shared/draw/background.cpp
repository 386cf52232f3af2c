// SPDX-License-Identifier: MIT
#include "shared/draw/background.h"

#include "shared/contract/debug_mode.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"

#include <algorithm>

namespace diptych {

namespace {

// Whether the background has any radiance.
bool isSeen(const FrameInputs& inputs) {
    return inputs.variant.get(gpu::FEATURE_environment) != 0 || inputs.variant.get(gpu::FEATURE_haze) != 0;
}

}  // namespace

// The full-screen triangle lies just in front of the far end, so only cleared depth passes the test.
void addBackground(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit, Load load) {
    if (!isSeen(inputs)) return;
    Variant variant = inputs.variant.only(featuresReadBy(gpu::PASS_BACKGROUND));
    if (variant.get(gpu::FEATURE_view_source) != gpu::VIEW_UNIFORM)
        variant.set(gpu::FEATURE_view_source, gpu::VIEW_FLAT);
    Pass& pass = passes.draw("background").color(lit, load).depthTest(depth);
    const Pipeline pipeline =
        inputs.pipelines.get(inputs.depth.stored({.vertex = Shader::deferred_lighting_vert,
                                                  .fragment = Shader::background_frag,
                                                  .variant = variant,
                                                  .input = NO_VERTICES,
                                                  .colors = {inputs.lit_format},
                                                  .depth = depthFormat,
                                                  .depth_compare = VK_COMPARE_OP_GREATER,
                                                  .depth_write = false,
                                                  .samples = inputs.samples}));
    pass.record(recordFullScreen(inputs, pipeline));
}

ImageRef addCaptureBackground(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                              const CaptureGroup& group) {
    const bool shown = std::ranges::count(group.modes, Channel::lit) > 0;
    if (!shown || !isSeen(inputs)) return {};
    const ImageRef lit = passes.image({.name = "lit",
                                       .format = inputs.lit_format,
                                       .samples = inputs.samples,
                                       .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                       .life = Life::transient});
    addBackground(passes, inputs, depth, lit, Load::clear);
    return lit;
}

}  // namespace diptych
