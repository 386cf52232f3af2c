// SPDX-License-Identifier: MIT
// Exports a view of a scene as glTF 2.0.
#pragma once

#include "compare/external/renderer_file.h"
#include "shared/frame/setting_values.h"
#include "shared/scene/scene_view.h"

#include <string>
#include <vector>

namespace diptych::external {

struct WrittenScene {
    std::string glb;
    std::vector<std::string> notes;  // features that the file cannot express, one line each
};

// The scene at the view's time: deformed geometry, materials, textures as PNG, lights
// (KHR_lights_punctual), and the view's camera as camera 0.
WrittenScene sceneGltf(const Scene& scene, const SceneView& view, SkinNormals normals);

// Lights and camera only. Each light shines along -Z of its own node. `notes` counts lights that
// KHR_lights_punctual does not support.
WrittenScene rigGltf(const SceneView& view);

}  // namespace diptych::external
