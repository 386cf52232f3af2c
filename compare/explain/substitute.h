// SPDX-License-Identifier: MIT
#pragma once

#include "compare/render/renderer.h"
#include "shared/frame/frame.h"

namespace diptych {

// Another renderer's image of the view of `ours`, as input of explain(). Settings and channels that it
// does not declare come from `ours`, so lit differences are attributed to lighting. Tries other skin
// normals (--skin-normals) and widened roughness (--spec-aa), and takes the channels that bring lit
// closer.
Frame substituteChannels(const Frame& external, const Frame& ours, Renderer& renderer,
                         const RenderOptions& options);

}  // namespace diptych
