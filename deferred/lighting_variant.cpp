// SPDX-License-Identifier: MIT
#include "deferred/lighting_variant.h"

namespace diptych {

Variant lightingVariant(const FrameInputs& inputs) {
    Variant variant = inputs.variant.only(featuresReadBy(gpu::PASS_LIGHTING));
    if (variant.get(gpu::FEATURE_view_source) != gpu::VIEW_UNIFORM)
        variant.set(gpu::FEATURE_view_source, gpu::VIEW_FLAT);
    return variant;
}

}  // namespace diptych
