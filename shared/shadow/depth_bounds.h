// SPDX-License-Identifier: MIT
// --shadow-fit depth: the view depths that a picture shows, found on the device (Lauritzen, Salvi and Lefohn
// 2010, "Sample Distribution Shadow Maps").
#pragma once

#include "shared/draw/frame_inputs.h"
#include "shared/scene/view.h"
#include "shared/shadow/cascades.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/pass_list.h"

#include <optional>

namespace diptych {

// A draw of depth and its reduction.
class DepthBounds {
public:
    explicit DepthBounds(Device& device);

    // Passes named "shadow depth bounds": what `inputs` draws that is not blended, depth alone, in the list's
    // size.
    void addPasses(PassList& passes, const FrameInputs& inputs);
    // Of the last run that has ended; nothing where the picture shows nothing. `view`: of the run's inputs.
    std::optional<DepthRange> range(const View& view) const;

    std::uint64_t bytes() const { return bounds_.size() + seen_.size(); }

private:
    OwnedDescriptorSetLayout layout_;
    OwnedPipelineLayout pipeline_layout_;
    OwnedSampler sampler_;
    DescriptorSets sets_;
    GpuBuffer bounds_, seen_;
};

// Draws now, and waits; with those of what is blended. `inputs` of `pose` and `view`.
std::optional<DepthRange> shownDepths(const FrameInputs& inputs, const Pose& pose, const View& view);

// How much the shown depths vary while the camera moves to the right in `steps` steps of `step` m: standard
// deviations, shares of the means. 0 where fewer than two of the pictures show anything.
struct DepthVariation {
    double near = 0, far = 0;
};
// `inputs` of `view`.
DepthVariation depthVariation(const FrameInputs& inputs, Uploader& uploader, const Pose& pose,
                              const View& view, double step, int steps);

}  // namespace diptych
