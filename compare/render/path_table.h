// SPDX-License-Identifier: MIT
// The functions of the two paths, for everything that draws.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"
#include "shared/frame/settings.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// The functions of one path.
struct PathFunctions {
    Path path;
    // Decides what the Settings leave to the path; notes on it. Called once, before the others.
    std::vector<std::string> (*prepare)(FrameInputs&, const Settings&);
    FrameImages (*add)(PassList&, const FrameInputs&);
    std::vector<CapturedImage> (*capture)(PassList&, const FrameInputs&, const FrameImages&,
                                          const CaptureRequest&);
    bool (*draws)(Shader fragment);  // whether only this path draws with it
};
// What a pixel takes in a frame's images of the picture's size, bytes; each sample of it by itself.
struct PixelBytes {
    std::uint32_t geometry = 0;  // depth, and what deferred keeps of surfaces
    std::uint32_t all = 0;       // light too; as if no two images shared memory
};
PixelBytes pixelBytes(const PassList& passes, const FrameImages& images);

// Throws std::logic_error for the reference, which no device draws.
const PathFunctions& functionsOf(Path path);

}  // namespace diptych
