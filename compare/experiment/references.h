// SPDX-License-Identifier: MIT
// Draws a scene by the reference, and Settings from the same cameras.
#pragma once

#include "compare/experiment/errors.h"
#include "compare/image/channel_image.h"
#include "compare/render/renderer.h"
#include "shared/scene/requirements.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace diptych::experiment {

// The reference frames of an experiment.
struct ReferenceFrames {
    std::vector<Frame> frames;                                 // one per camera
    std::vector<std::shared_ptr<const ErrorsAgainst>> errors;  // one per camera
    Exposure exposure;                                         // for all images
};

// `shadows`: also renders channels that evaluate shadows, if shadows are on.
ReferenceFrames drawReferenceFrames(Renderer& renderer, const Settings& requested,
                                    const std::vector<std::string>& cameras, const ImageChoice& choice,
                                    const RenderOptions& options, bool shadows = true);

// Renders lit, and material_id to detect the background. `shadows`: also channels that evaluate shadows.
RenderOptions litOptions(const RenderOptions& options, bool shadows);

// Settings with the camera of a reference frame.
Settings seenFrom(const Frame& reference, Settings settings);

// Adds the reference frames' notes, and light that the rows' paths do not support. The latter is part of
// their errors. Skips lines that `notes` has already.
void addNotes(std::vector<std::string>& notes, const ReferenceFrames& references,
              std::span<const Settings> rows, const Requirements& needs);

}  // namespace diptych::experiment
