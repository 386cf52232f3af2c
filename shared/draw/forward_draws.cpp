// SPDX-License-Identifier: MIT
#include "shared/draw/forward_draws.h"

#include "shared/draw/pipeline_parts.h"

#include <memory>

namespace diptych {

namespace {

// Descriptor set for the stored depth. Null if fragments use their own depth: nothing has stored it, or both
// have the same bits.
std::shared_ptr<const DescriptorSets> storedDepth(const PassList& passes, const FrameInputs& inputs,
                                                  const FrameImages& images, bool depth_is_stored) {
    // Under MSAA a fragment is shaded between its samples, where no depth is stored.
    if (inputs.samples > 1 || !depth_is_stored) return nullptr;
    if (!inputs.device.profile().fetches_depth && !inputs.depth.inSteps()) return nullptr;
    return std::make_shared<const DescriptorSets>(gbufferSet(passes, inputs, images));
}

}  // namespace

void addForwardDraws(Pass& pass, PassList& passes, const FrameInputs& inputs, const FrameImages& images,
                     const ForwardDraws& draws, const LightBatch& batch) {
    const auto stored = storedDepth(passes, inputs, images, draws.depth_is_stored);
    if (stored) pass.samples(images.depth, inFragment);
    batch.read(pass);
    inputs.lists.read(passes, pass);
    readGeometry(passes, pass, inputs);
    pass.takes(shadingMs(passes, inputs, batch));
    pass.record(recordDraws(
        inputs, draws.items,
        [&](const DrawItem& item) {
            PipelineKey key = draws.keyOf(item);
            key.variant.set(gpu::FEATURE_stored_depth, stored != nullptr);
            return key;
        },
        batch, stored));
}

}  // namespace diptych
