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
            return gpu::STANDARD_GEOMETRIC_NORMAL_BITS;
        case GBufferEncoding::compact:
            return gpu::COMPACT_GEOMETRIC_NORMAL_BITS;
    }
    return 0;
}

namespace {

// Words of each layer in the attachments LAYERS to LAYERS_5, in their order.
struct Words {
    gpu::uint layer, packed, full;
};
#define DIPTYCH_WORDS(layer, packed, values) Words{gpu::LAYER_##layer, packed, gpu::layer##_FULL_WORDS},
constexpr std::array layer_words{STORED_LAYERS(DIPTYCH_WORDS)};
#undef DIPTYCH_WORDS

constexpr gpu::uint layerWords(gpu::uint layers, bool full) {
    gpu::uint sum = 0;
    for (const Words& words : layer_words)
        if ((layers & words.layer) != 0) sum += full ? words.full : words.packed;
    return sum;
}
static_assert(layerWords(~0u, true) <= gpu::LAYER_WORDS);

bool isOfLayers(gpu::uint attachment) {
    return attachment >= gpu::GBUFFER_LAYERS && attachment < gpu::GBUFFER_SHADED;
}

void addLayers(GBufferLayout& layout, bool full) {
    const gpu::uint words = layerWords(layout.layers, full);
    for (gpu::uint i = 0; 4 * i < words; ++i) {
        const gpu::uint left = words - 4 * i;
        layout.formats[gpu::GBUFFER_LAYERS + i] = left == 1   ? VK_FORMAT_R32_UINT
                                                  : left == 2 ? VK_FORMAT_R32G32_UINT
                                                              : VK_FORMAT_R32G32B32A32_UINT;
    }
}

}  // namespace

gpu::uint layerBytes(gpu::uint layers, GBufferEncoding encoding) {
    return layerWords(layers, encoding == GBufferEncoding::full) * static_cast<gpu::uint>(sizeof(gpu::uint));
}

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
    layout.layers = needs.surface_layers;
    addLayers(layout, full);
    if (layout.wide_material_id) f[gpu::GBUFFER_IDS] = VK_FORMAT_R32_UINT;
    if (sampled) f[gpu::GBUFFER_SHADED] = VK_FORMAT_R32G32_UINT;
    return layout;
}

GBufferPasses gbufferPasses(const GBufferLayout& layout) {
    gpu::uint room = gpu::MAX_COLOR_ATTACHMENTS;  // for layers
    for (gpu::uint i = 0; i < gpu::GBUFFER_ATTACHMENTS; ++i)
        if (layout.formats[i] != VK_FORMAT_UNDEFINED && !isOfLayers(i)) --room;
    GBufferPasses passes;
    for (gpu::uint i = 0; i < gpu::GBUFFER_ATTACHMENTS; ++i) {
        if (layout.formats[i] == VK_FORMAT_UNDEFINED) continue;
        const bool fits = !isOfLayers(i) || i - gpu::GBUFFER_LAYERS < room;
        (fits ? passes.first : passes.second).push_back(i);
    }
    if (passes.second.empty()) return passes;
    const gpu::uint begin = 4 * (passes.second.front() - gpu::GBUFFER_LAYERS);
    for (const Words& words : layer_words) {
        const gpu::uint up_to = layout.layers & (2 * words.layer - 1);
        if ((layout.layers & words.layer) != 0 &&
            layerWords(up_to, layout.encoding == gpu::GBUFFER_full) > begin)
            passes.second_layers |= words.layer;
    }
    return passes;
}

}  // namespace diptych
