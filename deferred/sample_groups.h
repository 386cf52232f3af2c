// SPDX-License-Identifier: MIT
// With several samples a pixel: which of them are shaded as one, and how those after a pixel's first are
// shaded.
#pragma once

#include "shared/draw/frame_inputs.h"

namespace diptych {

// A list of the groups of samples that are not their pixel's first (shared/contract/samples.h).
struct FurtherGroups {
    ImageRef count, list;
    bool any() const { return list.valid(); }
};

// Adds the pass that makes frame.groups, where the frame has several samples a pixel. Lists the further
// groups where that takes less time than to draw for each group that a pixel may have: on devices that shade
// what the depth test leaves nothing of, if they can store to samples, and not where every sample is shaded.
FurtherGroups addGroups(PassList& passes, const FrameInputs& inputs, FrameImages& frame);

// Adds the pass that shades them and stores their samples to `lit`; none where there is no list. `frame`:
// with the groups in depth's place. `lit`: an image with the frame's samples and storage.
void addFurtherGroups(PassList& passes, const FrameInputs& inputs, const FrameImages& frame,
                      const FurtherGroups& further, ImageRef lit);

}  // namespace diptych
