// SPDX-License-Identifier: MIT
// Renders a Frame with an external renderer.
#pragma once

#include "compare/external/renderer_file.h"
#include "shared/frame/frame.h"
#include "shared/scene/scene_view.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace diptych::external {

// Either a Frame or a problem.
struct Attempt {
    std::optional<Frame> frame;
    std::string problem;  // one line: "exited with 3: last line of output"
    std::string output;   // end of the output, several lines
};

// Writes a job for the view into a temporary folder, runs the renderer and reads its image. The Frame has
// the renderer's name, and its file as origin. Its Settings are `settings` with Path::reference, which has
// no derived tolerance. Its notes are stderr and features that the job cannot express. A failure, a
// timeout, and an image that is missing, old, of another size or not finite are problems. Throws
// std::runtime_error if the job cannot be written.
Attempt drawExternally(const ExternalRenderer& renderer, const Scene& scene, const SceneView& view,
                       const Settings& settings);

// Reads the pixels of `file` and applies `corrections`. Throws std::runtime_error, one line without the
// file's name, if they do not match the request. `after`: a file written before the renderer started.
Frame readImage(const std::filesystem::path& file, const std::filesystem::path& after,
                const InputCorrections& corrections, const Size& size);

}  // namespace diptych::external
