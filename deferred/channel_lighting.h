// SPDX-License-Identifier: MIT
// Deferred lighting of surfaces from channels of any renderer.
#pragma once

#include "shared/draw/frame_inputs.h"

#include <array>
#include <memory>

namespace diptych {

// Adds the passes that shade the channels, with one sample per pixel, and draw background and blended
// surfaces as in every frame; returns their lit. `depth`: of the frame of these inputs. `channels`:
// SET_GBUFFER with images at the bindings of SURFACE_CHANNELS and depth's. It may be rewritten between
// runs. Throws std::runtime_error, one line, if a light list is too long for one draw.
ImageRef addChannelLighting(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                            std::shared_ptr<const DescriptorSets> channels);

// Adds one pass that computes the terms of lit before blending: lit_diffuse, lit_specular, lit_ambient,
// lit_haze, transmittance, lit_environment. The alpha of the first two is shadow_visibility and
// local_visibility. Throws as above.
std::array<ImageRef, 6> addChannelTerms(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                                        std::shared_ptr<const DescriptorSets> channels);

}  // namespace diptych
