// SPDX-License-Identifier: MIT
// The device that there is, where a kernel chooses what of a view may show (DeviceProfile::culls_by_compute).
#pragma once

#include "tests/image/scenes.h"

#include <memory>

namespace diptych::tests {

inline Device& byCompute() {
    static Device theDevice{{.choice = "", .validate = true, .choices = ProfileChoices::culling_by_compute}};
    return theDevice;
}

inline std::shared_ptr<PipelineSet> computePipelines() {
    static const std::shared_ptr<PipelineSet> set = makePipelineSet(byCompute());
    return set;
}

}  // namespace diptych::tests
