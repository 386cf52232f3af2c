// SPDX-License-Identifier: MIT
// Lists of more lights than one draw can walk are shaded in batches: each draw adds its batch of the lights
// to the float32 sums that the one before it left, so the result has the same bits as one loop's.
#pragma once

#include "shared/contract/light_list.h"
#include "shared/draw/frame_inputs.h"

#include <array>
#include <functional>
#include <memory>

namespace diptych {

// The packets of each light list that one draw walks, and the sums that it continues from.
struct LightBatch {
    gpu::uint kind = gpu::BATCH_WHOLE;
    gpu::uint first = 0, end = 0;         // packets, counted from a list's begin
    std::array<ImageRef, 2> images = {};  // the sums of earlier batches: diffuse, specular
    std::shared_ptr<DescriptorSets> sums =
        {};  // the same as SET_PARTIAL_SUMS, filled once the images have memory; null: none

    // Declares that the pass samples the sums, where there are some.
    void read(Pass& pass, VkPipelineStageFlags2 stages = inFragment) const;
};

// About how long it takes to shade every pixel of the list's size with a batch, ms; each fragment that is
// drawn over takes as long again.
double shadingMs(const PassList& passes, const FrameInputs& inputs, const LightBatch& batch);

// Adds a draw for each batch of the lights but the last, which is returned for the pass that completes the
// sum: lists of up to DeviceProfile::packets_per_draw packets are one batch, BATCH_WHOLE, without an extra
// draw. `add` declares depth, the earlier sums and what else is read, and records the drawing of one batch
// into attachments 0 (diffuse) and 1 (specular), or of SumsBy::storage a dispatch that stores to these
// images, which it declares too.
enum class SumsBy { attachments, storage };
using AddBatch = std::function<void(Pass&, const LightBatch&, const std::array<ImageRef, 2>& sums)>;
LightBatch addEarlierBatches(PassList& passes, const FrameInputs& inputs, const AddBatch& add,
                             SumsBy drawn = SumsBy::attachments);

// A SET_PARTIAL_SUMS of these images, filled when the pass is prepared.
std::shared_ptr<DescriptorSets> partialSumSet(PassList& passes, Pass& pass, const FrameInputs& inputs,
                                              const std::array<ImageRef, 2>& images);

}  // namespace diptych
