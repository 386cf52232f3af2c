// SPDX-License-Identifier: MIT
#pragma once

#include "shared/frame/settings.h"
#include "shared/scene/requirements.h"

#include <string>
#include <vector>

namespace diptych {

// What of a scene's light the path does not draw yet, a note each; the reference draws all.
std::vector<std::string> leftOutLight(Path path, const Requirements& needs);

// Likewise what of a scene it draws undeformed; the reference poses it in mode scene.
std::vector<std::string> leftOutMotion(Path path, const Requirements& needs);

}  // namespace diptych
