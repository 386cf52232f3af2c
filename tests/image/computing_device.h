// SPDX-License-Identifier: MIT
// The device, with culling by compute shader (DeviceProfile::culls_by_compute).
#pragma once

#include "tests/image/scenes.h"

#include <memory>

namespace diptych::tests {

inline Device& byCompute() {
    static Device& theDevice =
        *new Device({.choice = "", .validate = true, .choices = ProfileChoices::culling_by_compute});
    return theDevice;
}

inline std::shared_ptr<PipelineSet> computePipelines() {
    static const auto& set = *new std::shared_ptr<PipelineSet>(makePipelineSet(byCompute()));
    return set;
}

}  // namespace diptych::tests
