// SPDX-License-Identifier: MIT
// Deferred lighting of surfaces that are made of channels, whoever drew them.
#pragma once

#include "shared/draw/frame_inputs.h"

#include <array>
#include <memory>

namespace diptych {

// Adds the passes that shade them, with one sample a pixel, and draw background and blended surfaces as every
// frame has them; returns their lit. `depth`: of the frame of the same inputs. `channels`: a SET_GBUFFER with
// images at the bindings of SURFACE_CHANNELS and depth's; it may be written anew between runs, not during
// one. Throws std::runtime_error, one line, where a list of lights is longer than one draw walks.
ImageRef addChannelLighting(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                            std::shared_ptr<const DescriptorSets> channels);

// Adds one pass that shades them into the terms of lit, before anything is blended: lit_diffuse,
// lit_specular, lit_ambient, lit_haze, transmittance, lit_environment. Throws as above.
std::array<ImageRef, 6> addChannelTerms(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                                        std::shared_ptr<const DescriptorSets> channels);

}  // namespace diptych
