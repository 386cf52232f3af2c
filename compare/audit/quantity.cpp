// SPDX-License-Identifier: MIT
#include "compare/audit/quantity.h"

namespace diptych::audit {

bool isPrecise(const Settings& settings) {
    const bool packs = hasGBuffer(settings.path) && settings.gbuffer != GBufferEncoding::full;
    return !packs && settings.depth_format == DepthFormat::d32f && settings.lit_format == LitFormat::fp32 &&
           settings.shading_precision == ShadingPrecision::fp32;
}

}  // namespace diptych::audit
