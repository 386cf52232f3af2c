// SPDX-License-Identifier: MIT
// Loads a scene with the material variant and the environment that its Settings request.
#pragma once

#include "compare/frames/render_options.h"
#include "compare/run/progress.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"

#include <cstddef>
#include <string>

namespace diptych {

// Loads the scene (shared/scene/load.h), the variant and the environment of the Settings; reports to
// `progress`. Throws std::runtime_error, one line, naming the file.
Scene loadSceneWithSettings(const std::string& where, const Settings& settings, const Stage& progress);

// Throws std::runtime_error, one line, if nothing in the scene has triangles: two such images always agree.
void requireTriangles(const Scene& scene, const std::string& where);

// For a scene and Settings that a file names, not the user: throws std::runtime_error if building the scene,
// the rig of lights or the sun's shadow maps takes more than 1 GiB. `where` may be empty.
void checkAsked(const std::string& file, const std::string& where, const Settings& settings);

// Fraction of a scene's time that loading takes if `frames` Frames are rendered, 0 to 1.
double loadingFraction(const std::string& scene, const RenderOptions& render, std::size_t frames);

}  // namespace diptych
