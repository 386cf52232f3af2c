// SPDX-License-Identifier: MIT
// The input of the reference renderer.
#pragma once

#include "compare/reference/haze.h"
#include "compare/reference/punctual.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace diptych::reference {

class Checkpoint;
struct Picture;

struct Request {
    const Scene& scene;
    const Pose& pose;
    const View& view;
    std::span<const Light> lights;  // in world space
    // What lights in the place of the scene's, which stays the background; nullptr: that one.
    const Environment* residual = nullptr;
    double environment_factor = 1;
    double environment_turned = 0;  // about +Y, counter-clockwise seen from above, rad
    glm::dvec3 ambient{0};          // radiance from all directions, W/(sr m^2); attenuated by occlusion
    Multiscatter multiscatter = Multiscatter::off;
    BaseLayer base_layer = BaseLayer::max;
    SkinNormals skin_normals = SkinNormals::joints;
    Falloff falloff = {};
    std::optional<Air> air = {};
    bool blended = true;                    // whether surfaces of alphaMode BLEND are there at all
    std::vector<std::size_t> casters = {};  // into `lights`: those that cast shadows
    bool shadowed_environment = false;      // whether the environment is shadowed too
    bool shadows() const { return !casters.empty() || shadowed_environment; }
    // Whether the picture tells what approximations of the environment cost, and what geometry hides of it
    // and of ambient light.
    bool environment_costs = false, surroundings = false;
    // Whether it tells how much of suns, points and spots is seen, and how far the edges of their shadows
    // are. Most of the rays for that are not needed for light. Without it there are no such channels.
    bool shadow_edges = true;
    const Environment* environment() const {
        return residual ? residual : scene.environment ? &*scene.environment : nullptr;
    }
    // In both modes rays meet what the pose's skins and morph targets deform.
    ReferenceMode mode = ReferenceMode::surface;
    int samples = 1;                                 // per pixel; mode scene only
    Resolve resolve = Resolve::linear;               // of their light; mode scene only
    const std::map<int, Image>* surfaces = nullptr;  // mode surface only: all channels of surfaceChannels()
    // Mode surface only: the same channels as a G-buffer gives them back, for Picture::decoded; or nullptr.
    const std::map<int, Image>* decoded = nullptr;
    // Called once, with the key of the picture and the number of floats in a tile; returns where finished
    // tiles are kept. The caller owns the Checkpoint, and removes it once the picture has been written.
    // Empty: nothing is kept. `program` is this program's version: tiles kept by another version are not
    // used.
    std::function<Checkpoint&(std::uint64_t key, std::size_t floats)> keep = {};
    std::string_view program = {};
    // Called from any thread with the fraction that is done.
    std::function<void(double fraction)> progress = {};
    // Called from any thread with each tile once it is in the picture: its left and top pixel, width and
    // height. Only there may the picture be read; other tiles may be written meanwhile.
    std::function<void(const Picture& picture, int x, int y, int width, int height)> tile = {};
    // Called once, soon, with the seconds that all of the picture is expected to take; not for a short one.
    std::function<void(double seconds)> expected = {};
};

}  // namespace diptych::reference
