// SPDX-License-Identifier: MIT
// What the reference is asked to draw.
#pragma once

#include "shared/frame/settings.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/view.h"

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string_view>
#include <vector>

namespace diptych::reference {

struct Request {
    const Scene& scene;
    const Pose& pose;
    const View& view;
    std::span<const Light> lights;  // world; the environment is the scene's
    double environment_factor = 1;
    glm::dvec3 ambient{0};  // radiance from everywhere, W/(sr m^2); occlusion dims it
    bool shadows = false;
    // Skins and morph targets move what mode scene draws; in mode surface shadows fall from meshes as the
    // paths draw them, undeformed.
    ReferenceMode mode = ReferenceMode::surface;
    int samples = 1;                                 // per pixel, mode scene
    const std::map<int, Image>* surfaces = nullptr;  // mode surface: every channel of surfaceChannels()
    // Where what is done is kept, when all is too: the caller removes it. Empty: nowhere. `program`: what of
    // another version is not gone on from.
    std::filesystem::path keep;
    std::string_view program = {};
    // From any thread: the share that is done.
    std::function<void(double fraction)> progress = {};
};

}  // namespace diptych::reference
