// SPDX-License-Identifier: MIT
// Selects the G-buffer attachments that a scene's materials need. shared/contract/gbuffer.h defines the
// bits.
#pragma once

#include "shared/contract/gbuffer.h"
#include "shared/frame/settings.h"
#include "shared/scene/requirements.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <array>
#include <vector>

namespace diptych {

struct GBufferLayout {
    gpu::uint encoding = gpu::GBUFFER_standard;
    // Float32, for radiance beyond the range of 9.9.9.e5.
    bool wide_emission = false;
    bool wide_lightmap = false;  // float32 likewise
    gpu::uint layers = 0;        // LAYER_* that are stored
    // For more materials than the packed bits can store.
    bool wide_material_id = false;
    std::array<VkFormat, gpu::GBUFFER_ATTACHMENTS> formats{};  // VK_FORMAT_UNDEFINED: no attachment

    void specialise(Variant& variant) const;
};

// How two passes divide the attachments, in the order of their locations. The second one draws the layers
// that MAX_COLOR_ATTACHMENTS leaves no room for in the first one, usually none.
struct GBufferPasses {
    std::vector<gpu::uint> first, second;
    gpu::uint second_layers = 0;  // LAYER_* with words in the attachments of the second pass
};
GBufferPasses gbufferPasses(const GBufferLayout& layout);

// Bits per octahedral coordinate of stored geometric normals; 0: stored as float32.
gpu::uint geometricNormalBits(GBufferEncoding encoding);

// Bytes per sample of these layers' words.
gpu::uint layerBytes(gpu::uint layers, GBufferEncoding encoding);

// `sampled`: with MSAA.
GBufferLayout gbufferLayout(GBufferEncoding encoding, const Requirements& needs, bool sampled = false);

extern const std::array<const char*, gpu::GBUFFER_ATTACHMENTS> gbufferAttachmentNames;

}  // namespace diptych
