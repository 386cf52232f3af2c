// SPDX-License-Identifier: MIT
// Images of earlier passes that fragment shaders of this folder's passes read.
#pragma once

#include "shared/draw/frame_inputs.h"

#include <memory>
#include <optional>
#include <vector>

namespace diptych {

struct ReadImage {
    gpu::uint binding;  // of SET_GBUFFER
    ImageRef image;
    std::optional<Part> part{};  // empty: all of it
};

// Declares that the pass reads the images; returns its SET_GBUFFER.
std::shared_ptr<const DescriptorSets> readImages(Pass& pass, PassList& passes, const FrameInputs& inputs,
                                                 std::vector<ReadImage> images);

}  // namespace diptych
