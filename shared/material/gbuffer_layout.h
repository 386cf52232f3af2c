// SPDX-License-Identifier: MIT
// Which attachments a scene's materials need in the G-buffer; the bits are in shared/contract/gbuffer.h.
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
    bool wide_emission = false;                                // float32: radiance beyond what 9.9.9.e5 holds
    bool wide_lightmap = false;                                // likewise
    bool wide_material_id = false;                             // more materials than the packed bits can name
    std::array<VkFormat, gpu::GBUFFER_ATTACHMENTS> formats{};  // undefined: not there

    void specialise(Variant& variant) const;
};

// `sampled`: pixels have several samples.
GBufferLayout gbufferLayout(GBufferEncoding encoding, const Requirements& needs, bool sampled = false);

extern const std::array<const char*, gpu::GBUFFER_ATTACHMENTS> gbufferAttachmentNames;

}  // namespace diptych
