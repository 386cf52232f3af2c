// SPDX-License-Identifier: MIT
// Light lists that are too long for one draw are shaded in batches. Each draw adds its lights to the
// float32 sums of the previous one, so the result is bit for bit that of one loop.
#pragma once

#include "shared/contract/light_list.h"
#include "shared/draw/frame_inputs.h"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace diptych {

// Diffuse, specular, the parts of the specular sum of clear coats and of sheens, and the part of the diffuse
// sum of diffuse transmission, if the scene has them.
using PartialSumImages = std::array<ImageRef, 5>;

// Range of list entries that one draw evaluates, and the sums that it continues from.
struct LightBatch {
    gpu::uint kind = gpu::BATCH_WHOLE;
    gpu::uint first = 0, end = 0;  // entries, counted from a list's begin
    PartialSumImages images = {};  // sums of earlier batches
    std::shared_ptr<DescriptorSets> sums =
        {};  // the same as SET_PARTIAL_SUMS, filled once the images have memory; null: none

    // Declares that the pass samples the sums, if there are any.
    void read(Pass& pass, VkPipelineStageFlags2 stages = inFragment) const;
};

// Estimated time to shade every pixel of the pass list's size with a batch, ms. Each level of overdraw
// costs as much again.
double shadingMs(const PassList& passes, const FrameInputs& inputs, const LightBatch& batch);

// FrameInputs::entries_per_draw, so that the loops over a pixel's lights take at most
// DeviceProfile::light_iterations. `layers`: LAYER_* of all surfaces. `list_width`: lights of an entry.
gpu::uint entriesPerDraw(const DeviceProfile& profile, const GpuLights& lights, gpu::uint layers,
                         gpu::uint list_width);

// Adds a draw for every light batch but the last, and returns the last for the pass that completes the
// sum. Lists of up to FrameInputs::entries_per_draw entries are one batch, BATCH_WHOLE, without an
// extra draw. `add` declares what the pass reads, including depth and the earlier sums, and records the draw
// of one batch, which writes attachments of partialSumFormats(). With SumsBy::storage it is a dispatch, which
// stores to the first two images and declares them. `layers`: LAYER_* of the surfaces that are drawn.
enum class SumsBy { attachments, storage };
using AddBatch = std::function<void(Pass&, const LightBatch&, const PartialSumImages& sums)>;
LightBatch addEarlierBatches(PassList& passes, const FrameInputs& inputs, const AddBatch& add, SumsBy drawn,
                             gpu::uint layers);

// SET_PARTIAL_SUMS of these images, written when the pass is prepared.
std::shared_ptr<DescriptorSets> partialSumSet(PassList& passes, Pass& pass, const FrameInputs& inputs,
                                              const PartialSumImages& images);
std::vector<VkFormat> partialSumFormats(gpu::uint layers);

}  // namespace diptych
