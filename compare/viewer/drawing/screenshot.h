// SPDX-License-Identifier: MIT
// Writes a view of both paths to files.
#pragma once

#include "compare/viewer/drawing/pair_renderer.h"

#include <filesystem>
#include <string>

namespace diptych::viewer {

// Writes the visible channel of both paths as PNG and all channels as EXR, STEM.deferred.png and so on.
// Returns the stem, a new one in `folder`. Throws std::runtime_error.
std::string writeScreenshot(PairRenderer& pair, const DrawRequest& request,
                            const std::filesystem::path& folder);

}  // namespace diptych::viewer
