// SPDX-License-Identifier: MIT
// Selects the G-buffer attachments that a scene's materials need. shared/contract/gbuffer.h defines the
// bits.
#pragma once

#include "shared/contract/gbuffer.h"
#include "shared/frame/settings.h"
#include "shared/scene/requirements.h"
#include "shared/vulkan/pipelines.h"

#include <array>
#include <string>

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

// Bits per octahedral coordinate of stored geometric normals; 0: stored as float32.
gpu::uint geometricNormalBits(GBufferEncoding encoding);

// `sampled`: with MSAA.
GBufferLayout gbufferLayout(GBufferEncoding encoding, const Requirements& needs, bool sampled = false);

extern const std::array<const char*, gpu::GBUFFER_ATTACHMENTS> gbufferAttachmentNames;

}  // namespace diptych
