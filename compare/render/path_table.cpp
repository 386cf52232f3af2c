// SPDX-License-Identifier: MIT
#include "compare/render/path_table.h"

#include "deferred/deferred.h"
#include "forward_plus/forward_plus.h"

#include <fmt/format.h>

#include <stdexcept>

namespace diptych {
namespace {

const PathFunctions paths[] = {
    {Path::deferred, prepareDeferred, addDeferred, addDeferredCapture,
     [](Shader fragment) {
         return fragment == Shader::gbuffer_frag || fragment == Shader::gbuffer_layers_frag ||
                fragment == Shader::deferred_shade_frag || fragment == Shader::deferred_light_batch_frag ||
                fragment == Shader::deferred_capture_frag;
     }},
    {Path::forward_plus, prepareForwardPlus, addForwardPlus, addForwardPlusCapture,
     [](Shader fragment) {
         return fragment == Shader::forward_shade_frag || fragment == Shader::forward_light_batch_frag ||
                fragment == Shader::forward_capture_frag;
     }},
};

}  // namespace

PixelBytes pixelBytes(const PassList& passes, const FrameImages& images) {
    std::uint64_t geometry = passes.pixelBytes(images.depth);
    for (const ImageRef image : images.gbuffer)
        if (image.valid()) geometry += passes.pixelBytes(image);
    if (images.groups.valid()) geometry += passes.pixelBytes(images.groups);
    return {static_cast<std::uint32_t>(geometry), static_cast<std::uint32_t>(passes.pixelBytes())};
}

const PathFunctions& functionsOf(Path path) {
    for (const PathFunctions& functions : paths)
        if (functions.path == path) return functions;
    throw std::logic_error(fmt::format("--path {} is drawn by no device", nameOf(path)));
}

}  // namespace diptych
