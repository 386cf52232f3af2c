// SPDX-License-Identifier: MIT
// The truth that paths are held against: direct light in double precision, written from the definitions. No
// Vulkan, no shader, no formula of theirs.
#pragma once

#include "shared/frame/settings.h"
#include "shared/image/image.h"
#include "shared/scene/scene.h"
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

struct Picture {
    std::map<int, Image> channels;  // by debug mode, all of them; the background as a Frame has it
    // Of lit, in its unit: half the 95 % confidence interval of what was sampled and what quadrature left
    // open. Empty where nothing was.
    Image uncertainty;
};

// What mode surface shades, as a path without any encoding captures it at one sample.
std::vector<int> surfaceChannels();

// Multithreaded; the same picture whatever the number of threads and however often it was interrupted. Throws
// std::runtime_error, one line, where `keep` cannot be written.
Picture draw(const Request& request);

}  // namespace diptych::reference
