// SPDX-License-Identifier: MIT
// A view of a scene as glTF 2.0, for renderers that read nothing else.
#pragma once

#include "compare/external/renderer_file.h"
#include "shared/frame/setting_values.h"
#include "shared/scene/scene_view.h"

#include <string>
#include <vector>

namespace diptych::external {

struct WrittenScene {
    std::string glb;
    std::vector<std::string> notes;  // what glTF or this writer cannot hold of it, one line each
};

// Everything that the view shows, where it is at its time: geometry with every vertex posed, materials,
// textures as PNG, its lights of KHR_lights_punctual and its camera, which is camera 0.
WrittenScene sceneGltf(const Scene& scene, const SceneView& view, SkinNormals normals);

// The lights and the camera alone. Each light shines along -Z of its own node, as glTF has it. Lights that
// KHR_lights_punctual does not know are left out, and `notes` says how many of which kind.
WrittenScene rigGltf(const SceneView& view);

}  // namespace diptych::external
