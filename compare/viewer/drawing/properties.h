// SPDX-License-Identifier: MIT
// Properties of the scene and of a path's last frame, for the interface.
#pragma once

#include "compare/viewer/drawing/result.h"

#include <string>

namespace diptych::viewer {

// `name`: the scene on the command line.
SceneProperties propertiesOf(const Scene& scene, const std::string& name);

// Updates `properties` from a new Frame. `timed`: also its times.
void takeProperties(const Frame& frame, bool timed, PathProperties& properties);

}  // namespace diptych::viewer
