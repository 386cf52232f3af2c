// SPDX-License-Identifier: MIT
#include "shared/material/gbuffer_layout.h"

namespace diptych {

#define DIPTYCH_GBUFFER_NAME(number, name, kind, what) what,
const std::array<const char*, gpu::GBUFFER_ATTACHMENTS> gbufferAttachmentNames{
    GBUFFER_BINDINGS(DIPTYCH_GBUFFER_NAME)};
#undef DIPTYCH_GBUFFER_NAME

void GBufferLayout::specialise(Variant& variant) const {
    variant.set(gpu::FEATURE_gbuffer_encoding, encoding)
        .set(gpu::FEATURE_gbuffer_wide_emission, wide_emission)
        .set(gpu::FEATURE_gbuffer_wide_lightmap, wide_lightmap)
        .set(gpu::FEATURE_gbuffer_wide_material_id, wide_material_id)
        .set(gpu::FEATURE_gbuffer_layers, layers);
}

gpu::uint geometricNormalBits(GBufferEncoding encoding) {
    switch (encoding) {
        case GBufferEncoding::full:
            return 0;
        case GBufferEncoding::standard:
            return gpu::STANDARD_NORMAL_BITS;
        case GBufferEncoding::compact:
            return gpu::COMPACT_GEOMETRIC_NORMAL_BITS;
    }
    return 0;
}

namespace {

// Packed encodings store only words of present layers; `full` stores the coat's normal and weight, then the
// rest.
void addLayers(GBufferLayout& layout, bool full) {
    const bool coat = (layout.layers & gpu::LAYER_CLEARCOAT) != 0;
    const bool anisotropy = (layout.layers & gpu::LAYER_ANISOTROPY) != 0;
    auto& f = layout.formats;
    if (full) {
        if (coat) f[gpu::GBUFFER_LAYERS] = VK_FORMAT_R32G32B32A32_UINT;
        if (layout.layers != 0) f[gpu::GBUFFER_LAYERS_2] = VK_FORMAT_R32G32B32A32_UINT;
    } else if (layout.layers != 0) {
        f[gpu::GBUFFER_LAYERS] = coat && anisotropy ? VK_FORMAT_R32G32B32A32_UINT
                                 : coat             ? VK_FORMAT_R32G32_UINT
                                                    : VK_FORMAT_R32_UINT;
    }
}

}  // namespace

GBufferLayout gbufferLayout(GBufferEncoding encoding, const Requirements& needs, bool sampled) {
    GBufferLayout layout;
    const bool full = encoding == GBufferEncoding::full, compact = encoding == GBufferEncoding::compact;
    layout.encoding = full ? gpu::GBUFFER_full : compact ? gpu::GBUFFER_compact : gpu::GBUFFER_standard;
    layout.wide_emission = !full && needs.emission &&
                           (needs.max_emission > gpu::EMISSION_MAX || needs.min_emission < gpu::EMISSION_MIN);
    layout.wide_lightmap = !full && needs.lightmap &&
                           (needs.max_lightmap > gpu::EMISSION_MAX || needs.max_lightmap < gpu::EMISSION_MIN);
    layout.wide_material_id =
        !full && needs.materials > 1u << (compact ? gpu::COMPACT_ID_BITS : gpu::STANDARD_ID_BITS);

    const VkFormat word = full ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_R32_UINT;
    auto& f = layout.formats;
    f[gpu::GBUFFER_ALBEDO] = word;
    f[gpu::GBUFFER_NORMALS] = full || compact ? word : VK_FORMAT_R32G32_UINT;
    f[gpu::GBUFFER_PARAMS] = word;
    if (full || needs.emission)  // full stores the material id beside the emission
        f[gpu::GBUFFER_EMISSION] = layout.wide_emission ? VK_FORMAT_R32G32B32A32_UINT : word;
    if (needs.dielectric_specular) f[gpu::GBUFFER_SPECULAR] = word;
    if (needs.lightmap) f[gpu::GBUFFER_LIGHTMAP] = layout.wide_lightmap ? VK_FORMAT_R32G32B32A32_UINT : word;
    layout.layers = needs.layers;
    addLayers(layout, full);
    if (layout.wide_material_id) f[gpu::GBUFFER_IDS] = VK_FORMAT_R32_UINT;
    if (sampled) f[gpu::GBUFFER_SHADED] = VK_FORMAT_R32G32_UINT;
    return layout;
}

}  // namespace diptych
