// SPDX-License-Identifier: MIT
// Draws whose fragments are shaded from their materials.
#pragma once

#include "shared/draw/record.h"

#include <span>

namespace diptych {

// Solids to shade, their pipelines, and whether an earlier pass has stored their depth.
struct ForwardDraws {
    std::span<const DrawItem> items;
    KeyOf keyOf;
    bool depth_is_stored = true;
};

// Records the draws in `pass` and declares what they read, apart from shadows and the pass's attachments.
void addForwardDraws(Pass& pass, PassList& passes, const FrameInputs& inputs, const FrameImages& images,
                     const ForwardDraws& draws, const LightBatch& batch);

}  // namespace diptych
