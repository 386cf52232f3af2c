// SPDX-License-Identifier: MIT
// What the reference is asked to draw.
#pragma once

#include "shared/frame/settings.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string_view>
#include <vector>

namespace diptych::reference {

class Checkpoint;

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
    // Called once, for where tiles of `floats` numbers are kept as they are done, of the picture that `key`
    // stands for: the caller owns it, and removes it when the picture is safe. Empty: nowhere. `program`:
    // what another version has kept is not gone on from.
    std::function<Checkpoint&(std::uint64_t key, std::size_t floats)> keep = {};
    std::string_view program = {};
    // From any thread: the share that is done.
    std::function<void(double fraction)> progress = {};
};

}  // namespace diptych::reference
