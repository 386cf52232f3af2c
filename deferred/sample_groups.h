// SPDX-License-Identifier: MIT
// MSAA in the deferred path: grouping samples that share shading, and shading of secondary sample groups.
#pragma once

#include "shared/draw/frame_inputs.h"

namespace diptych {

// List of secondary sample groups: all but the first group of each pixel (shared/contract/samples.h).
struct FurtherGroups {
    ImageRef count, list;
    bool any() const { return list.valid(); }
};

// Adds the pass that computes frame.groups if the frame has MSAA. Secondary groups are listed if that is
// faster than one draw per possible group: on devices that shade samples that failed the depth test, if
// they support stores to samples, and unless every sample is shaded.
FurtherGroups addGroups(PassList& passes, const FrameInputs& inputs, FrameImages& frame);

// Adds the pass that shades listed groups and stores their samples to `lit`; none without a list. `frame`:
// with sample groups in place of depth. `lit`: an image with the frame's samples and storage usage.
void addFurtherGroups(PassList& passes, const FrameInputs& inputs, const FrameImages& frame,
                      const FurtherGroups& further, ImageRef lit);

}  // namespace diptych
