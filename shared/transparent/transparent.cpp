// SPDX-License-Identifier: MIT
#include "shared/transparent/transparent.h"

#include "shared/contract/debug_mode.h"
#include "shared/draw/pipeline_keys.h"
#include "shared/draw/record.h"
#include "shared/shadow/shadow_maps.h"

#include <algorithm>
#include <cstddef>

namespace diptych {

void addTransparent(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit) {
    if (inputs.draws.blended().empty()) return;
    Pass& pass = passes.draw("transparent").color(lit, Load::keep).depthTest(depth);
    inputs.lists.read(passes, pass);
    inputs.shadow.read(pass);
    pass.takes(shadingMs(passes, inputs, {}));
    pass.record(recordBlended(inputs, [&](const DrawItem& item) { return blendedKey(inputs, item); }));
}

void addTransparentCapture(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                           std::vector<CapturedImage>& images) {
    const std::size_t capture = passes.size() - 1;
    const auto lit = std::ranges::find_if(images, [&](const CapturedImage& image) {
        return image.pass == capture && image.mode == static_cast<int>(gpu::DEBUG_lit);
    });
    if (lit == images.end() || inputs.draws.blended().empty()) return;
    addTransparent(passes, inputs, depth, lit->image);
    lit->pass = passes.size() - 1;
    std::rotate(lit, lit + 1, images.end());
}

}  // namespace diptych
