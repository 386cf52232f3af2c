// SPDX-License-Identifier: MIT
// The tool on a device with a masked capability: the layer of tests/tool/layer hides it, below the
// validation layer.
#pragma once

#include "tests/tool/layer/hidden.h"
#include "tests/tool/run.h"

#include <string>

namespace diptych {

// `hidden` as layer/hidden.h names it; empty: nothing. Older loaders order layers by manifest search
// order, newer ones as named: the first is nearest to the program.
inline Ran runHiding(const Folder& scratch, const std::string& hidden, const std::string& arguments) {
    return runShell(scratch,
                    "env DIPTYCH_HIDE='" + hidden +
                        "' VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation:VK_LAYER_DIPTYCH_hide "
                        "VK_LAYER_PATH=/usr/share/vulkan/explicit_layer.d:'" DIPTYCH_HIDE_LAYER
                        "' '" DIPTYCH_PROGRAM "' " +
                        arguments,
                    scratch.path());
}

}  // namespace diptych
