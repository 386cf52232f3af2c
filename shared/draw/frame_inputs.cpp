// SPDX-License-Identifier: MIT
#include "shared/draw/frame_inputs.h"

namespace diptych {

Variant sceneVariant(const Requirements& needs, const GpuLights& lights, const View& view,
                     const GBufferLayout& gbuffer, AreaLights area_lights) {
    Variant variant;
    gpu::uint area = 0;
    if (lights.rect > 0) area |= gpu::AREA_RECTS;
    if (lights.disc > 0) area |= gpu::AREA_DISCS;
    if (lights.tube > 0) area |= gpu::AREA_TUBES;
    if (area != 0 && area_lights == AreaLights::representative) area |= gpu::AREA_POINTS;
    variant.set(gpu::FEATURE_emission, needs.emission)
        .set(gpu::FEATURE_dielectric_specular, needs.dielectric_specular)
        .set(gpu::FEATURE_directional_lights, lights.directional > 0)
        .set(gpu::FEATURE_point_lights, lights.point > 0)
        .set(gpu::FEATURE_spot_lights, lights.spot > 0)
        .set(gpu::FEATURE_area_lights, area)
        .set(gpu::FEATURE_lightmap, needs.lightmap)
        .set(gpu::FEATURE_ambient, lights.ambient != glm::vec3(0))
        .set(gpu::FEATURE_orthographic, view.camera.orthographic);
    gbuffer.specialise(variant);
    return variant;
}

}  // namespace diptych
