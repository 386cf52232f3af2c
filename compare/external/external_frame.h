// SPDX-License-Identifier: MIT
// A Frame that another renderer draws.
#pragma once

#include "compare/external/renderer_file.h"
#include "shared/frame/frame.h"
#include "shared/scene/scene_view.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace diptych::external {

// A picture, or why there is none: never both.
struct Attempt {
    std::optional<Frame> frame;
    std::string problem;  // one line: "exited with 3: the last line that it said"
    std::string said;     // the end of what it said, many lines
};

// Writes a job of the view in a temporary folder, runs the renderer, and reads its picture. The Frame's name
// is the renderer's, its origin the renderer's file; its Settings are `settings` with Path::reference, whose
// pictures have no tolerance of their own. What it said while all went well, and what the job could not say,
// are its notes. A picture that cannot be had (the renderer fails, or takes too long, or writes none, or one
// of another size, or one that it has not written now, or pixels that are not finite) is a problem. Throws
// std::runtime_error where this machine is at fault: a job cannot be written.
Attempt drawExternally(const Renderer& renderer, const Scene& scene, const SceneView& view,
                       const Settings& settings);

// The pixels of `file` as the renderer is granted to mean them, held to what was asked for; throws
// std::runtime_error, one line without the file's name. `after`: a file that was written before the renderer
// began.
Frame readPicture(const std::filesystem::path& file, const std::filesystem::path& after,
                  const Granted& granted, const Size& size);

}  // namespace diptych::external
