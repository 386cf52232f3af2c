// SPDX-License-Identifier: MIT
#include "compare/render/path_table.h"

#include "deferred/deferred.h"
#include "forward_plus/forward_plus.h"

#include <fmt/format.h>

#include <stdexcept>

namespace diptych {
namespace {

// The paths, one row each.
const PathFunctions paths[] = {
    {Path::deferred, [](FrameInputs&, const Settings&) { return std::vector<std::string>{}; }, addDeferred,
     addDeferredCapture, [](const FrameInputs& inputs) { return inputs.gbuffer.bytesPerSample() + 4; },
     [](Shader fragment) {
         return fragment == Shader::gbuffer_frag || fragment == Shader::deferred_shade_frag ||
                fragment == Shader::deferred_light_batch_frag || fragment == Shader::deferred_capture_frag;
     }},
    {Path::forward_plus, prepareForwardPlus, addForwardPlus, addForwardPlusCapture,
     [](const FrameInputs&) { return std::uint32_t{4}; },
     [](Shader fragment) {
         return fragment == Shader::forward_shade_frag || fragment == Shader::forward_light_batch_frag ||
                fragment == Shader::forward_capture_frag;
     }},
};

}  // namespace

const PathFunctions& functionsOf(Path path) {
    for (const PathFunctions& functions : paths)
        if (functions.path == path) return functions;
    throw std::logic_error(fmt::format("--path {} is drawn by no device", nameOf(path)));
}

}  // namespace diptych
