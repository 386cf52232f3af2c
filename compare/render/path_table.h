// SPDX-License-Identifier: MIT
// The functions of the two paths, for all code that renders.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"
#include "shared/frame/settings.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

struct PathFunctions {
    Path path;
    // Makes the decisions that Settings leave to the path; returns notes. Called once, before the others.
    std::vector<std::string> (*prepare)(FrameInputs&, const Settings&);
    FrameImages (*add)(PassList&, const FrameInputs&);
    std::vector<CapturedImage> (*capture)(PassList&, const FrameInputs&, const FrameImages&,
                                          const CaptureRequest&);
    bool (*draws)(Shader fragment);  // whether only this path uses the shader
};
// Bytes per pixel of a frame's full-size images; each sample counts.
struct PixelBytes {
    std::uint32_t geometry = 0;  // depth, and deferred's G-buffer
    std::uint32_t all = 0;       // also light; as if no two images shared memory
};
PixelBytes pixelBytes(const PassList& passes, const FrameImages& images);

// Throws std::logic_error for the reference, which no device renders.
const PathFunctions& functionsOf(Path path);

}  // namespace diptych
